// SPDX-License-Identifier: GPL-3.0-or-later
// AL3D of Alicona's instruments: 52-byte tags, then the heights in metres, single precision. Missing points
// are NaN or `InvalidPixelValue`. Layout: Alicona's description, restated by SurfaceTopography's reader.
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

namespace {

constexpr std::string_view al3d_mark("AliconaImaging\0\r\n", 17);

using Al3dTags = std::map<std::string, std::string, std::less<>>;

bool recognises_al3d(const SourceFile& file) { return file.bytes().starts_with(al3d_mark); }

std::pair<std::string, std::string> take_tag(BinaryCursor& cursor, const SourceFile& file) {
  constexpr std::size_t name_bytes = 20, value_bytes = 30;
  const std::string name(cursor.text(name_bytes)), value(cursor.text(value_bytes));
  if (cursor.take(2) != "\r\n")
    refuse_file(file, "is an AL3D file of Alicona with a tag " + shown(name) + " that does not end as a line",
                "its header is wrong or the file is damaged");
  return {name, value};
}

std::uint64_t tag_count(const SourceFile& file, const Al3dTags& tags, std::string_view name) {
  const auto found = tags.find(name);
  if (found == tags.end()) refuse_file(file, "has no tag " + std::string(name));
  if (const auto count = count_in(trimmed(found->second))) return *count;
  refuse_file(file, "has no count as its " + std::string(name) + ": " + shown(found->second));
}

double tag_number(const SourceFile& file, const Al3dTags& tags, std::string_view name) {
  const auto found = tags.find(name);
  if (found == tags.end()) refuse_file(file, "has no tag " + std::string(name));
  const TextCell cell = read_cell(trimmed(found->second), Separator::blank);
  if (cell.kind != CellKind::number && cell.kind != CellKind::hole)
    refuse_file(file, "has no number as its " + std::string(name) + ": " + shown(found->second));
  return cell.value;
}

Al3dTags read_tags(const SourceFile& file) {
  require_format(file, recognises_al3d(file), "is not an AL3D file: it does not start with AliconaImaging");
  BinaryCursor cursor(file, file.bytes(), "its tags");
  cursor.skip(al3d_mark.size());
  Al3dTags tags;
  tags.insert(take_tag(cursor, file));
  tags.insert(take_tag(cursor, file));
  const std::uint64_t count = tag_count(file, tags, "TagCount");
  for (std::uint64_t k = 0; k < count; ++k) tags.insert(take_tag(cursor, file));
  return tags;
}

// Bytes per line, padded to 8. Some writers do not pad an odd number of columns; the start of the next
// block decides.
std::uint64_t bytes_a_line(const Al3dTags& tags, const SourceFile& file, std::uint64_t nx, std::uint64_t ny,
                           std::uint64_t offset) {
  const std::uint64_t plain = nx * sizeof(float), padded = (plain + 7) / 8 * 8;
  if (plain == padded) return plain;
  std::uint64_t end = file.bytes().size();
  if (tags.find("TextureImageOffset") != tags.end())
    if (const std::uint64_t texture = tag_count(file, tags, "TextureImageOffset"); texture > offset)
      end = std::min(end, texture);
  return end - offset < padded * ny ? plain : padded;
}

HeightMap read_al3d(const SourceFile& file, Monitor& monitor) {
  const Al3dTags tags = read_tags(file);
  const std::uint64_t nx = tag_count(file, tags, "Cols"), ny = tag_count(file, tags, "Rows");
  const std::uint64_t offset = tag_count(file, tags, "DepthImageOffset");
  if (offset == 0) refuse_file(file, "holds no heights: its DepthImageOffset is 0");
  if (offset > file.bytes().size())
    refuse_file(file, "has its heights at byte " + std::to_string(offset) + ", past its end",
                "the file is cut short");
  const std::string_view data = file.bytes().substr(static_cast<std::size_t>(offset));
  require_numbers(file, nx, ny, sizeof(float), data.size());
  const std::uint64_t line = bytes_a_line(tags, file, nx, ny, offset);
  const double dx = tag_number(file, tags, "PixelSizeXMeter");
  const double dy = tag_number(file, tags, "PixelSizeYMeter");
  for (const double spacing : {dx, dy})
    if (!(spacing > 0) || !std::isfinite(spacing))
      refuse_file(file, "gives " + format_short(spacing) + " m as the distance of its points");
  double missing = std::numeric_limits<double>::quiet_NaN();
  if (tags.find("InvalidPixelValue") != tags.end()) missing = tag_number(file, tags, "InvalidPixelValue");
  // The text rounds this single-precision value.
  const double near_missing = 1e-6 * std::abs(missing);
  HeightMap map;
  map.heights = Field(static_cast<int>(nx), static_cast<int>(ny));
  Task task(monitor, "reading", static_cast<std::int64_t>(ny));
  for (std::uint64_t j = 0; j < ny; ++j) {
    const char* at = data.data() + line * j;
    for (double& height : map.heights.row(static_cast<int>(j))) {
      const auto value = static_cast<double>(little_endian<float>(at));
      at += sizeof(float);
      height = std::abs(value - missing) <= near_missing ? std::numeric_limits<double>::quiet_NaN() : value;
    }
    task.advance();
  }
  map.unit = 1.0;
  map.size_x = dx * static_cast<double>(nx);
  map.size_y = dy * static_cast<double>(ny);
  return map;
}

}  // namespace

const Format& al3d_format() {
  static const Format format{"al3d",
                             "AliconaImaging at the start",
                             {"AL3D of Alicona (InfiniteFocus): the depth image.",
                              "Files of pictures alone; texture and quality are passed over.",
                              "A file of the public test set of SurfaceTopography, every height and size; it "
                              "has no missing points."},
                             {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
                             {"al3d"},
                             recognises_al3d,
                             read_al3d};
  return format;
}

}  // namespace asperity
