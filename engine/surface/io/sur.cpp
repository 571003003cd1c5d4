// SPDX-License-Identifier: GPL-3.0-or-later
// SUR of Digital Surf (MountainsMap and the instruments that come with it): a header of 512 bytes, a comment,
// a private zone, then integers of 16 or 32 bits, line by line; height = number times spacing plus offset, in
// the unit of the z axis. A point that was not measured is the least height less 2. Layout: the description
// in the software's reference, as restated by Gwyddion's and RosettaSciIO's readers. Of a file of several
// objects the first is read; compressed ones ("DSCOMPRESSED") are refused.
#include <array>
#include <cmath>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/binary_cursor.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/length_unit.hpp"

namespace asperity {

namespace {

constexpr std::string_view plain_mark = "DIGITAL SURF", compressed_mark = "DSCOMPRESSED";
constexpr std::size_t sur_header_bytes = 512;

struct SurAxis {
  double spacing;
  std::optional<double> unit;
  std::string word;  // of the unit, as written
};

struct SurHeader {
  int objects = 0, type = 0, bits = 0;
  bool special = false;
  std::int32_t least = 0;
  std::int64_t nx = 0, ny = 0;
  std::array<SurAxis, 3> axes;
  double offset = 0;
  std::size_t data_at = 0;
};

SurHeader read_header(const SourceFile& file) {
  if (file.bytes().starts_with(compressed_mark))
    refuse_file(file, "is a compressed SUR file", "save it again without compression, or as X3P or SDF");
  BinaryCursor cursor(file, file.bytes(), "its header of 512 bytes");
  if (file.bytes().size() < plain_mark.size() || cursor.take(plain_mark.size()) != plain_mark)
    refuse_file(file, "is not a SUR file: it does not start with DIGITAL SURF",
                "if it is another format, name it with `format`");
  SurHeader header;
  const int order = cursor.number<std::int16_t>();
  if (order != 0)
    refuse_file(file, "is a SUR file of an Apple computer (format " + std::to_string(order) + ")",
                "save it again on another");
  header.objects = cursor.number<std::uint16_t>();
  cursor.skip(2);
  header.type = cursor.number<std::int16_t>();
  cursor.skip(30 + 30 + 2 + 2 + 2);
  header.special = cursor.number<std::int16_t>() != 0;
  cursor.skip(2 + 8);
  header.bits = cursor.number<std::int16_t>();
  header.least = cursor.number<std::int32_t>();
  cursor.skip(4);
  header.nx = cursor.number<std::int32_t>();
  header.ny = cursor.number<std::int32_t>();
  cursor.skip(4);
  for (SurAxis& axis : header.axes) axis.spacing = std::abs(static_cast<double>(cursor.number<float>()));
  cursor.skip(3 * 16);
  for (SurAxis& axis : header.axes) {
    axis.word = std::string(cursor.text(16));
    axis.unit = length_unit(axis.word);
  }
  cursor.skip(3 * 16 + 3 * 4 + 3 * 2 + 12 + 7 * 2 + 4 + 10);
  const std::size_t comment = cursor.number<std::uint16_t>(), own = cursor.number<std::uint16_t>();
  cursor.skip(128 + 2 * 4);
  header.offset = static_cast<double>(cursor.number<float>());
  cursor.skip(sur_header_bytes - cursor.position());
  cursor.skip(comment);
  cursor.skip(own);
  header.data_at = cursor.position();
  return header;
}

bool recognises_sur(const SourceFile& file) {
  return file.bytes().starts_with(plain_mark) || file.bytes().starts_with(compressed_mark);
}

HeightMap read_sur(const SourceFile& file, Monitor& monitor) {
  const SurHeader header = read_header(file);
  // 1 a profile, 2 a surface, 4 and 5 series of them.
  if (header.type == 3 || header.type < 1 || header.type > 5)
    refuse_file(file, "holds an object of type " + std::to_string(header.type) + ", which is no surface",
                "surfaces and profiles are read: types 1, 2, 4 and 5");
  if (header.bits != 16 && header.bits != 32)
    refuse_file(file, "holds points of " + std::to_string(header.bits) + " bits",
                "points of 16 and 32 bits are read");
  const auto side = [](std::int64_t count) { return count < 0 ? 0 : static_cast<std::uint64_t>(count); };
  const std::string_view data = file.bytes().substr(header.data_at);
  const std::uint64_t width = static_cast<std::uint64_t>(header.bits) / 8;
  // Of several objects the next begins, with its own header, where this one ends.
  if (header.objects > 1) {
    require_numbers(file, side(header.nx), side(header.ny), width, data.size());
    const std::string_view next = data.substr(side(header.nx) * side(header.ny) * width);
    if (!next.empty() && !next.starts_with(plain_mark) && !next.starts_with(compressed_mark))
      refuse_file(file,
                  "holds " + std::to_string(header.objects) + " objects, and no second one after the " +
                      std::to_string(header.nx) + " x " + std::to_string(header.ny) + " heights of the first",
                  "its header is wrong or the file is damaged");
  } else {
    require_exactly(file, side(header.nx), side(header.ny), width, data.size());
  }
  const int nx = static_cast<int>(header.nx), ny = static_cast<int>(header.ny);
  const std::int64_t missing = std::int64_t{header.least} - 2;
  const auto is_hole = [&](auto value) { return header.special && std::int64_t{value} == missing; };

  const auto& [x, y, z] = header.axes;
  if (!(z.spacing > 0) || !std::isfinite(z.spacing) || !std::isfinite(header.offset))
    refuse_file(file, "gives " + format_short(z.spacing) + " as the height of one step");
  HeightMap map;
  map.heights = width == 2 ? field_of_numbers<std::int16_t>(data, nx, ny, monitor, is_hole)
                           : field_of_numbers<std::int32_t>(data, nx, ny, monitor, is_hole);
  for (double& height : map.heights.values()) height = height * z.spacing + header.offset;
  if (!z.unit && !z.word.empty())
    monitor.warn(file_name(file.path()) + " gives its heights in " + shown(z.word) +
                 ", which is no unit of length");
  if (header.objects > 1)
    monitor.warn(file_name(file.path()) + " holds " + std::to_string(header.objects) +
                 " objects; the first is read");
  map.unit = z.unit;
  map.trace = ny == 1;
  if (x.unit && x.spacing > 0 && std::isfinite(x.spacing)) map.size_x = x.spacing * *x.unit * nx;
  if (!map.trace && y.unit && y.spacing > 0 && std::isfinite(y.spacing))
    map.size_y = y.spacing * *y.unit * ny;
  return map;
}

}  // namespace

const Format& sur_format() {
  static constexpr std::array<std::string_view, 2> endings{"sur", "pro"};
  static const Format format{
      "sur",
      "DIGITAL SURF at the start",
      {"SUR of Digital Surf (MountainsMap): the first surface or profile, of 16 or 32 bits.",
       "Compressed files, files of Apple computers, binary images and other studiables.",
       "Three files of the public test sets of SurfaceTopography and surfalize, heights, sizes and missing "
       "points."},
      endings,
      recognises_sur,
      read_sur};
  return format;
}

}  // namespace asperity
