// SPDX-License-Identifier: GPL-3.0-or-later
// FRT of MicroProf profilometers: numbered blocks of shape, size (m), scale (m per step), heights and their
// valid range (16 bits only). A missing point is 1 or out of range. Layout: SurfaceTopography's and
// Gwyddion's readers.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view frt_mark = "FRTM_GLIDERV";

// The first of equal kinds counts.
using FrtBlocks = std::map<int, std::string_view>;
constexpr int frt_heights = 0x0B, frt_shape = 0x66, frt_size = 0x67, frt_scale = 0x6C, frt_valid = 0x70;

FrtBlocks read_frt_blocks(const SourceFile& file) {
  BinaryCursor cursor(file, file.bytes(), "its blocks");
  cursor.skip(frt_mark.size());
  const std::string_view version = cursor.take(4);
  if (version != "1.00" && version != "1.01")
    refuse_file(file, "is of version " + shown(version), "versions 1.00 and 1.01 are read");
  const bool wide = version == "1.01";
  cursor.skip(2);
  FrtBlocks blocks;
  const std::size_t head = wide ? 10 : 6;
  while (cursor.left() >= head) {
    const int kind = cursor.number<std::uint16_t>();
    const std::uint64_t length =
        wide ? cursor.number<std::uint64_t>() : std::uint64_t{cursor.number<std::uint32_t>()};
    if (length > cursor.left())
      refuse_file(file,
                  "has a block of " + std::to_string(length) + " bytes where " +
                      std::to_string(cursor.left()) + " are left",
                  "the file is cut short");
    blocks.emplace(kind, cursor.take(static_cast<std::size_t>(length)));
  }
  return blocks;
}

Range valid_range(const SourceFile& file, const FrtBlocks& blocks) {
  const auto found = blocks.find(frt_valid);
  if (found == blocks.end()) return {-INFINITY, INFINITY};
  BinaryCursor cursor(file, found->second, "its range of valid heights");
  const std::uint32_t least = cursor.number<std::uint32_t>(), greatest = cursor.number<std::uint32_t>();
  if (!(least < greatest))
    refuse_file(file, "says that valid heights run from " + std::to_string(least) + " to " +
                          std::to_string(greatest));
  return {static_cast<double>(least), static_cast<double>(greatest)};
}

HeightMap read_frt(const SourceFile& file, Monitor& monitor) {
  const FrtBlocks blocks = read_frt_blocks(file);
  const auto heights = blocks.find(frt_heights), dimensions = blocks.find(frt_shape);
  if (heights == blocks.end())
    refuse_file(file, "holds no map of heights", "the block 0x0B, topography, is read");
  if (dimensions == blocks.end()) refuse_file(file, "does not say how many points it has");
  BinaryCursor shape(file, dimensions->second, "its numbers of points");
  const std::uint64_t nx = shape.number<std::uint32_t>(), ny = shape.number<std::uint32_t>();
  const std::uint64_t bits = shape.number<std::uint32_t>();
  if (bits != 16 && bits != 32)
    refuse_file(file, "holds heights of " + std::to_string(bits) + " bits",
                "heights of 16 and 32 bits are read");
  constexpr double missing = 1;
  const Range valid = bits == 16 ? valid_range(file, blocks) : Range{-INFINITY, INFINITY};
  HeightMap map;
  map.heights =
      exact_field(file, bits == 16 ? number_type<std::uint16_t> : number_type<std::int32_t>, heights->second,
                  nx, ny, monitor, [&](double v) { return v == missing || v < valid.min || v > valid.max; });
  if (const auto found = blocks.find(frt_scale); found != blocks.end()) {
    BinaryCursor scale(file, found->second, "its scale of heights");
    scale.skip(4);
    map.unit = above_zero(file, scale.number<double>(), "m as the height of one step");
  }
  if (const auto found = blocks.find(frt_size); found != blocks.end()) {
    BinaryCursor size(file, found->second, "its size");
    map.size_x = above_zero(file, size.number<double>(), "m as its size");
    map.size_y = above_zero(file, size.number<double>(), "m as its size");
  }
  return map;
}

}  // namespace

extern constexpr Format frt_format{
    "frt",
    "FRTM_GLIDERV at the start",
    {"FRT of MicroProf profilometers, versions 1.00 and 1.01: the topography, of 16 or 32 bits.",
     "Files without a topography; other maps in a file are passed over.",
     "Two files of 16 bits of the public test set of SurfaceTopography, every height, missing points, "
     "size; 32 bits by the layout alone."},
    {FirstLine::bottom, "Gwyddion's reader shows the first line at the bottom."},
    {"frt"},
    begins_with<frt_mark>,
    read_frt};

}  // namespace asperity
