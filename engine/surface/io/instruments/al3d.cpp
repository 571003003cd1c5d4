// SPDX-License-Identifier: GPL-3.0-or-later
// AL3D of Alicona's instruments: 52-byte tags, then the heights in metres, single precision. Missing points
// are NaN or `InvalidPixelValue`. Layout: SurfaceTopography's reader.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view al3d_mark("AliconaImaging\0\r\n", 17);

void take_tag(BinaryCursor& cursor, const SourceFile& file, HeaderEntries& tags) {
  constexpr std::size_t name_bytes = 20, value_bytes = 30;
  const std::string_view name = cursor.text(name_bytes), value = cursor.text(value_bytes);
  if (cursor.take(2) != "\r\n")
    refuse_file(file, "is an AL3D file of Alicona with a tag " + shown(name) + " without an end of line",
                "its header is wrong or the file is damaged");
  tags.add(name, value);
}

HeaderEntries read_tags(const SourceFile& file) {
  BinaryCursor cursor(file, file.bytes(), "its tags");
  cursor.skip(al3d_mark.size());
  HeaderEntries tags(file);
  for (int k = 0; k < 2; ++k) take_tag(cursor, file, tags);
  const std::uint64_t count = tags.count("TagCount");
  for (std::uint64_t k = 0; k < count; ++k) take_tag(cursor, file, tags);
  return tags;
}

// A line is padded to 8 bytes. Some writers do not pad; the start of the next block decides.
std::uint64_t padding_of_line(const HeaderEntries& tags, const SourceFile& file, std::uint64_t nx,
                              std::uint64_t ny, std::uint64_t offset) {
  const std::uint64_t plain = nx * sizeof(float), padded = (plain + 7) / 8 * 8;
  if (plain == padded) return 0;
  std::uint64_t end = file.bytes().size();
  if (tags.find("TextureImageOffset"))
    if (const std::uint64_t texture = tags.count("TextureImageOffset"); texture > offset)
      end = std::min(end, texture);
  return end - offset < padded * ny ? 0 : padded - plain;
}

HeightMap read_al3d(const SourceFile& file, Monitor& monitor) {
  const HeaderEntries tags = read_tags(file);
  const std::uint64_t nx = tags.count("Cols"), ny = tags.count("Rows");
  const std::uint64_t offset = tags.count("DepthImageOffset");
  if (offset == 0) refuse_file(file, "holds no heights: its DepthImageOffset is 0");
  if (offset > file.bytes().size())
    refuse_file(file, "has its heights at byte " + std::to_string(offset) + ", past its end",
                "the file is cut short");
  const std::string_view data = file.bytes().substr(static_cast<std::size_t>(offset));
  require_numbers(file, nx, ny, sizeof(float), data.size());
  const std::uint64_t padding = padding_of_line(tags, file, nx, ny, offset);
  constexpr const char* distance = "m as the distance of its points";
  const double dx = above_zero(file, tags.decimal("PixelSizeXMeter"), distance);
  const double dy = above_zero(file, tags.decimal("PixelSizeYMeter"), distance);
  double missing = std::numeric_limits<double>::quiet_NaN();
  if (tags.find("InvalidPixelValue")) missing = tags.decimal("InvalidPixelValue");
  // The text rounds this single-precision value.
  const double near_missing = 1e-6 * std::abs(missing);
  return {.heights = field_of_numbers(
              number_type<float>, data, nx, ny, monitor,
              [&](double value) { return std::abs(value - missing) <= near_missing; }, padding),
          .unit = 1.0,
          .size_x = dx * static_cast<double>(nx),
          .size_y = dy * static_cast<double>(ny)};
}

}  // namespace

extern constexpr Format al3d_format{
    "al3d",
    "AliconaImaging at the start",
    {"AL3D of Alicona (InfiniteFocus): the depth image.",
     "Files of pictures alone; texture and quality are passed over.",
     "A file of the public test set of SurfaceTopography, every height and size; it "
     "has no missing points."},
    {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
    {"al3d"},
    begins_with<al3d_mark>,
    read_al3d};

}  // namespace asperity
