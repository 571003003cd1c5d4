// SPDX-License-Identifier: GPL-3.0-or-later
// NMS of NanoFocus' confocal microscopes (usurf): header, 16-bit integers, camera picture. The header maps
// its integer range to its height range in micrometres; distances are in nanometres. Source: surfalize's and
// SurfaceTopography's readers; they disagree on units and range, and the objective's field (160 um) decides.
// No mark of missing points is known.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view nms_mark = "OM_MS_";
constexpr std::size_t nms_mark_at = 32, nms_least_header = 1392;

bool recognises_nms(const SourceFile& file) {
  return file.bytes().size() > nms_least_header && file.bytes().substr(nms_mark_at).starts_with(nms_mark);
}

HeightMap read_nms(const SourceFile& file, Monitor& monitor) {
  const std::string_view bytes = file.bytes();
  const auto count = [&](std::size_t at) { return std::uint64_t{little_endian<std::uint32_t>(&bytes[at])}; };
  const auto number = [&](std::size_t at) { return little_endian<double>(&bytes[at]); };
  const std::uint64_t first = count(8), last = count(12);
  const double low = number(16), high = number(24), dx = number(1376), dy = number(1384);
  const std::uint64_t start = count(1352), width = count(1356), nx = count(1368), ny = count(1372);
  if (start < nms_least_header || start > bytes.size())
    refuse_file(file, "says that its header has " + std::to_string(start) + " bytes",
                "its header is wrong or the file is cut short");
  if (width != sizeof(std::uint16_t))
    refuse_file(file, "holds heights of " + std::to_string(width) + (width == 1 ? " byte" : " bytes"),
                "integers of 2 bytes are read");
  if (!(first < last) || last > std::numeric_limits<std::uint16_t>::max())
    refuse_file(file,
                "says that its integers run from " + std::to_string(first) + " to " + std::to_string(last));
  if (!(high > low) || !std::isfinite(high - low))
    refuse_file(
        file, "says that its heights run from " + format_short(low) + " um to " + format_short(high) + " um");
  const std::string_view data = bytes.substr(static_cast<std::size_t>(start));
  require_numbers(file, nx, ny, width, data.size());
  const std::uint64_t points = nx * ny;
  if (data.size() != width * points && data.size() != (width + 1) * points)
    refuse_file(file,
                "has " + std::to_string(data.size()) + " bytes after its header, where " +
                    std::to_string(nx) + " x " + std::to_string(ny) + " heights take " +
                    std::to_string(width * points) + " and a picture " + std::to_string(points) + " more",
                "its header is wrong or the file is damaged");
  constexpr double micrometre = 1e-6, nanometre = 1e-9;
  HeightMap map;
  map.heights = field_of_numbers(number_type<std::uint16_t>, data, nx, ny, monitor);
  const double step = (high - low) / static_cast<double>(last - first);
  for (double& height : map.heights.values()) height = low + (height - static_cast<double>(first)) * step;
  map.unit = micrometre;
  constexpr const char* distance = "nm as the distance of its points";
  map.size_x = above_zero(file, dx, distance) * nanometre * static_cast<double>(nx);
  map.size_y = above_zero(file, dy, distance) * nanometre * static_cast<double>(ny);
  return map;
}

}  // namespace

extern constexpr Format nms_format{
    "nms",
    "OM_MS_ at byte 32",
    {"NMS of NanoFocus confocal microscopes: the height image, in 16 bits.",
     "Other widths of number; no mark of missing points is known.",
     "Two files of the public test set of SurfaceTopography, every height and size; "
     "its public readers differ on units, and 160 um is the objective's field."},
    {FirstLine::top,
     "An image, shown by SurfaceTopography's reader from the top; no specification is public."},
    {"nms"},
    recognises_nms,
    read_nms};

}  // namespace asperity
