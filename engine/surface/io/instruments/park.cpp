// SPDX-License-Identifier: GPL-3.0-or-later
// TIFF of Park Systems' microscopes (PSIA): a picture plus private tags. Height = (n · scale + offset) · gain
// in the header's unit; sizes are in micrometres. Non-finite numbers are missing points. Layout: Gwyddion's
// and SurfaceTopography's readers. Little-endian only.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view tiff_mark("II*\0", 4);
constexpr std::uint16_t park_mark_tag = 50432, park_version_tag = 50433, park_data_tag = 50434,
                        park_header_tag = 50435;
constexpr std::uint32_t park_mark = 0x0E031301;

struct TiffTag {
  std::uint32_t value = 0;  // first number
  std::uint64_t bytes = 0;  // of all numbers
};

std::uint64_t tiff_width(std::uint16_t type) {
  constexpr std::array<std::uint8_t, 13> widths{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
  return type < widths.size() ? widths[type] : 0;
}

// From the first directory. Never throws.
std::optional<TiffTag> tiff_tag(std::string_view bytes, std::uint16_t wanted) {
  if (bytes.size() < 8 || !bytes.starts_with(tiff_mark)) return {};
  const std::size_t directory = little_endian<std::uint32_t>(bytes.data() + 4);
  if (directory > bytes.size() || bytes.size() - directory < 2) return {};
  const std::size_t count = little_endian<std::uint16_t>(bytes.data() + directory);
  constexpr std::size_t entry_bytes = 12;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = directory + 2 + k * entry_bytes;
    if (at + entry_bytes > bytes.size()) return {};
    const char* const entry = bytes.data() + at;
    if (little_endian<std::uint16_t>(entry) != wanted) continue;
    const std::uint64_t width = tiff_width(little_endian<std::uint16_t>(entry + 2));
    return TiffTag{little_endian<std::uint32_t>(entry + 8), width * little_endian<std::uint32_t>(entry + 4)};
  }
  return {};
}

bool recognises_park(const SourceFile& file) {
  const auto tag = tiff_tag(file.bytes(), park_mark_tag);
  return tag && tag->bytes == 4 && tag->value == park_mark;
}

std::string_view park_tag_bytes(const SourceFile& file, std::uint16_t wanted, const std::string& what) {
  const auto tag = tiff_tag(file.bytes(), wanted);
  if (!tag) refuse_file(file, "is a TIFF of Park without its tag of " + what);
  return bytes_at(file, tag->value, tag->bytes, what);
}

// UTF-16; of non-ASCII characters only micro and angstrom.
std::string park_text(BinaryCursor& cursor, std::size_t characters) {
  std::string text;
  const std::string_view field = cursor.take(2 * characters);
  for (std::size_t k = 0; k < characters; ++k) {
    const auto letter = little_endian<std::uint16_t>(field.data() + 2 * k);
    if (letter == 0) break;
    constexpr std::uint16_t micro = 0xB5, mu = 0x3BC, angstrom = 0xC5;
    text += letter == micro || letter == mu ? '\xB5'
            : letter == angstrom            ? '\xC5'
            : letter < 0x80                 ? static_cast<char>(letter)
                                            : '?';
  }
  return text;
}

struct ParkHeader {
  std::uint32_t image_type = 0, nx = 0, ny = 0, swapped = 0, number_type = 0;
  double size_x = 0, size_y = 0, gain = 0, scale = 0, offset = 0;
  std::string source, unit;
};

ParkHeader park_header(const SourceFile& file) {
  constexpr std::uint32_t first_version = 0x01000001, second_version = 0x01000002;
  const auto version = tiff_tag(file.bytes(), park_version_tag);
  if (!version || (version->value != first_version && version->value != second_version))
    refuse_file(file, "is a TIFF of Park of an unknown version", "versions 1.0.1 and 1.0.2 are read");
  BinaryCursor cursor(file, park_tag_bytes(file, park_header_tag, "its header"), "its header");
  ParkHeader header;
  header.image_type = cursor.number<std::uint32_t>();
  header.source = park_text(cursor, 32);
  cursor.skip(2 * 8 + 8 + 4 + 4);  // mode, filter, flattening, tracking
  header.nx = cursor.number<std::uint32_t>();
  header.ny = cursor.number<std::uint32_t>();
  cursor.skip(8 + 4 + 8 + 4 + 4);  // angle, sine scan, overscan, forward, upward
  header.swapped = cursor.number<std::uint32_t>();
  header.size_x = cursor.number<double>();
  header.size_y = cursor.number<double>();
  cursor.skip(4 * 8 + 2 * 8 + 2 * 8);  // offsets, rate, set point, its unit, biases
  header.gain = cursor.number<double>();
  header.scale = cursor.number<double>();
  header.offset = cursor.number<double>();
  header.unit = park_text(cursor, 8);
  if (version->value == second_version) {
    cursor.skip(3 * 4 + 3 * 4 + 2 * 8 + 3 * 16);  // extremes, display modes, servo
    header.number_type = cursor.number<std::uint32_t>();
  }
  return header;
}

HeightMap read_park(const SourceFile& file, Monitor& monitor) {
  const ParkHeader header = park_header(file);
  if (header.image_type != 0)
    refuse_file(file, "is a line profile or spectroscopy of Park's microscopes, not a map",
                "maps are read; export the others as text");
  if (header.swapped != 0)
    refuse_file(file, "was scanned with x and y swapped, so its orientation is unknown",
                "save it as .gwy in Gwyddion");
  const std::optional<double> unit = instrument_length_unit(header.unit);
  if (!unit)
    refuse_file(file, "holds a map of " + quoted(plain_text(header.source)) + " in " + shown(header.unit) +
                          ", which is no unit of length");
  for (const double size : {header.size_x, header.size_y}) above_zero(file, size, "as its size");
  const double scale = header.scale == 0 ? 1 : header.scale;
  for (const double factor : {header.gain, scale})
    if (!std::isfinite(factor) || factor == 0)
      refuse_file(file, "gives " + format_short(factor) + " as a factor of its heights");
  if (!std::isfinite(header.offset))
    refuse_file(file, "gives " + format_short(header.offset) + " as the offset of its heights");
  const std::string_view data = park_tag_bytes(file, park_data_tag, "its numbers");
  if (header.number_type > 2)
    refuse_file(file, "holds numbers of type " + std::to_string(header.number_type),
                "types 0 to 2 are read: integers of 16 and 32 bits, floating-point numbers of 32");
  constexpr std::array types{number_type<std::int16_t>, number_type<std::int32_t>, number_type<float>};
  HeightMap map;
  map.heights = exact_field(file, types[header.number_type], data, header.nx, header.ny, monitor, not_finite);
  for (double& height : map.heights.values()) height = (height * scale + header.offset) * header.gain;
  constexpr double micrometre = 1e-6;
  map.unit = unit;
  map.size_x = header.size_x * micrometre;
  map.size_y = header.size_y * micrometre;
  map.trace = header.ny == 1;
  return map;
}

}  // namespace

extern constexpr Format park_format{
    "park",
    "a TIFF with Park's mark in its tag 50432",
    {"TIFF of Park Systems' microscopes (PSIA): the map of heights.",
     "Line profiles, spectroscopy, other quantities, scans with x and y swapped, pictures without heights.",
     "A file of the public test set of SurfaceTopography: heights, size and the roughness that its tests "
     "state."},
    {FirstLine::bottom, "Gwyddion's reader shows the first line at the bottom."},
    {"tiff", "tif"},
    recognises_park,
    read_park};

}  // namespace asperity
