// SPDX-License-Identifier: GPL-3.0-or-later
// SDF of ISO 25178-71 and its predecessor (EUR 15178, "aBCR-1.0"): a text or 81-byte header, then the
// heights by profile, in units of Zscale metres. Missing points: BAD in text; in binary NaN, the least
// signed or the greatest unsigned number. Layout: ISO 25178-71 and NIST's page.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

namespace {

struct SdfHeader {
  std::uint64_t points = 0, profiles = 0;
  double x_scale = 0, y_scale = 0, z_scale = 0;
  int compression = 0, type = -1;
};

constexpr int types = 8;  // u8, u16, u32, float, i8, i16, i32, double
constexpr std::array<std::uint64_t, types> widths{1, 2, 4, 4, 1, 2, 4, 8};

// "aISO-1.0", "bBCR-1.0": a (text) or b (binary), capitals, a version.
bool is_version(std::string_view mark, char form) {
  return mark.size() >= 8 && mark[0] == form && (mark.substr(1, 4) == "ISO-" || mark.substr(1, 4) == "BCR-");
}

// Some texts begin differently, with a header name a few lines below.
bool is_text_form(const SourceFile& file) {
  if (!file.looks_like_text()) return false;
  LineReader lines(file.text());
  std::string_view line;
  constexpr int near_start = 8;
  for (int k = 0; k < near_start && lines.next(line); ++k) {
    const std::string_view plain = trimmed(line);
    if (k == 0 && is_version(plain, 'a')) return true;
    if (k == 0 && !plain.starts_with('a')) return false;
    if (lower_case(plain.substr(0, 9)) == "manufacid") return true;
  }
  return false;
}

bool recognises_sdf(const SourceFile& file) { return is_version(file.bytes(), 'b') || is_text_form(file); }

void check_header(const SourceFile& file, const SdfHeader& header) {
  if (header.compression != 0)
    refuse_file(file, "is a compressed SDF file", "save it again without compression");
  if (header.type < 0 || header.type >= types)
    refuse_file(file, "has the DataType " + std::to_string(header.type), "types 0 to 7 are read");
  if (!(header.z_scale > 0) || !std::isfinite(header.z_scale))
    refuse_file(file, "gives " + format_short(header.z_scale) + " as its Zscale");
  for (const double scale : {header.x_scale, header.y_scale})
    if (!(scale >= 0) || !std::isfinite(scale))
      refuse_file(file, "gives " + format_short(scale) + " as the distance of its points");
}

// A scale of 0 is unknown: a single profile has no distance to the next.
HeightMap described(const SdfHeader& header, Field heights) {
  HeightMap map;
  map.heights = std::move(heights);
  map.unit = header.z_scale;
  map.trace = header.profiles == 1;
  if (header.x_scale > 0) map.size_x = header.x_scale * static_cast<double>(header.points);
  if (header.y_scale > 0 && !map.trace) map.size_y = header.y_scale * static_cast<double>(header.profiles);
  return map;
}

template <class T>
Field numbers(std::string_view data, const SdfHeader& header, Monitor& monitor) {
  const int nx = static_cast<int>(header.points), ny = static_cast<int>(header.profiles);
  return field_of_numbers<T>(data, nx, ny, monitor, [](T value) {
    if constexpr (std::is_floating_point_v<T>) return std::isnan(value);
    if constexpr (sizeof(T) == 1) return false;
    return value == (std::is_signed_v<T> ? std::numeric_limits<T>::min() : std::numeric_limits<T>::max());
  });
}

HeightMap read_binary(const SourceFile& file, Monitor& monitor) {
  BinaryCursor cursor(file, file.bytes(), "its header of 81 bytes");
  cursor.skip(8 + 10 + 12 + 12);
  SdfHeader header;
  header.points = cursor.number<std::uint16_t>();
  header.profiles = cursor.number<std::uint16_t>();
  header.x_scale = cursor.number<double>();
  header.y_scale = cursor.number<double>();
  header.z_scale = cursor.number<double>();
  cursor.skip(8);
  header.compression = cursor.number<std::uint8_t>();
  header.type = cursor.number<std::uint8_t>();
  cursor.skip(1);
  check_header(file, header);
  const std::string_view data = file.bytes().substr(cursor.position());
  const std::uint64_t width = widths[static_cast<std::size_t>(header.type)];
  require_numbers(file, header.points, header.profiles, width, data.size());
  // A text trailer may follow the heights.
  const std::string_view rest = data.substr(header.points * header.profiles * width);
  const auto is_text = [](char c) {
    return static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\x1A' ||
           c == '\0';
  };
  const bool trailer = std::all_of(rest.begin(), rest.end(), is_text) &&
                       std::any_of(rest.begin(), rest.end(), [](char c) { return c >= ' '; });
  if (!trailer) require_exactly(file, header.points, header.profiles, width, data.size());
  constexpr std::array readers{numbers<std::uint8_t>, numbers<std::uint16_t>, numbers<std::uint32_t>,
                               numbers<float>,        numbers<std::int8_t>,   numbers<std::int16_t>,
                               numbers<std::int32_t>, numbers<double>};
  return described(header, readers[static_cast<std::size_t>(header.type)](data, header, monitor));
}

double header_number(const SourceFile& file, std::string_view key, std::string_view text) {
  const TextCell cell = read_cell(text, Separator::blank);
  if (cell.kind != CellKind::number)
    refuse_file(file, "has no number for " + shown(key) + " in its header: " + shown(text));
  return cell.value;
}

std::uint64_t header_count(const SourceFile& file, std::string_view key, std::string_view text) {
  if (const auto count = count_in(text)) return *count;
  refuse_file(file, "has no count for " + shown(key) + " in its header: " + shown(text));
}

SdfHeader read_text_header(const SourceFile& file, LineReader& lines) {
  SdfHeader header;
  bool ended = false;
  unsigned found = 0;  // one bit per required entry
  std::string_view line;
  lines.next(line);
  while (!ended && lines.next(line)) {
    const std::string_view plain = trimmed(line);
    if (plain.starts_with('*')) {
      ended = true;
      continue;
    }
    // Comments begin with a semicolon, also after a value.
    const std::string_view statement = plain.substr(0, plain.find(';'));
    const std::size_t sign = std::min(statement.find('='), statement.size());
    const std::string key = lower_case(trimmed(statement.substr(0, sign)));
    const std::string_view value = trimmed(statement.substr(std::min(sign + 1, statement.size())));
    if (key == "numpoints") header.points = header_count(file, key, value), found |= 1;
    if (key == "numprofiles") header.profiles = header_count(file, key, value), found |= 2;
    if (key == "xscale") header.x_scale = header_number(file, key, value), found |= 4;
    if (key == "yscale") header.y_scale = header_number(file, key, value), found |= 8;
    if (key == "zscale") header.z_scale = header_number(file, key, value), found |= 16;
    if (key == "datatype")
      header.type = static_cast<int>(std::min<std::uint64_t>(header_count(file, key, value), 99)),
      found |= 32;
    if (key == "compression") header.compression = header_count(file, key, value) == 0 ? 0 : 1;
  }
  if (!ended) refuse_file(file, "has no line * after its header", "the file is cut short");
  constexpr std::array<const char*, 6> names{"NumPoints", "NumProfiles", "Xscale",
                                             "Yscale",    "Zscale",      "DataType"};
  for (std::size_t k = 0; k < names.size(); ++k)
    if ((found & (1U << k)) == 0) refuse_file(file, "has no " + std::string(names[k]) + " in its header");
  return header;
}

HeightMap read_text(const SourceFile& file, Monitor& monitor) {
  LineReader lines(file.text());
  const SdfHeader header = read_text_header(file, lines);
  check_header(file, header);
  // A number and its blank need at least two bytes.
  const std::size_t room = file.text().size() - lines.position();
  require_numbers(file, header.points, header.profiles, 1, room / 2 + 1);
  Field heights(static_cast<int>(header.points), static_cast<int>(header.profiles));
  std::size_t count = 0;
  Task task(monitor, "reading", static_cast<std::int64_t>(heights.size()));
  std::string_view line;
  bool ended = false;
  while (!ended && lines.next(line)) {
    if (const std::size_t star = line.find('*'); star != std::string_view::npos) {
      line = line.substr(0, star);
      ended = true;
    }
    const std::size_t before = count;
    for (const std::string_view text : cells_of(trimmed(line), Separator::blank)) {
      if (text.empty()) continue;
      const TextCell cell = read_cell(text, Separator::blank);
      if (cell.kind != CellKind::number && cell.kind != CellKind::hole)
        refuse_file(file, "has no height in line " + std::to_string(lines.number()) + ": " + shown(text));
      if (count == heights.size())
        refuse_file(file, "has more heights than the " + std::to_string(heights.size()) + " of its header",
                    "the header is wrong");
      heights[count++] = cell.value;
    }
    task.advance(static_cast<std::int64_t>(count - before));
  }
  if (count < heights.size())
    refuse_file(file,
                "has " + std::to_string(count) + " of the " + std::to_string(heights.size()) +
                    " heights of its header",
                "the file is cut short or its header is wrong");
  return described(header, std::move(heights));
}

HeightMap read_sdf(const SourceFile& file, Monitor& monitor) {
  if (is_version(file.bytes(), 'b')) return read_binary(file, monitor);
  if (is_text_form(file)) return read_text(file, monitor);
  refuse_file(file, "is not an SDF file: it starts with neither aISO, aBCR, bISO nor bBCR",
              "if it is another format, name it with `format`");
}

}  // namespace

const Format& sdf_format() {
  static const Format format{
      "sdf",
      "aISO-1.0, bISO-1.0 or BCR at the start",
      {"SDF of ISO 25178-71 and its forerunner, in text or binary, all eight types of number.",
       "Compressed files.",
       "A text file of the public test set of SurfaceTopography; binary files of this program are read alike "
       "by surfalize."},
      {FirstLine::bottom, "ISO 25178-71 gives coordinates: y is the profile times Yscale."},
      {"sdf"},
      recognises_sdf,
      read_sdf};
  return format;
}

}  // namespace asperity
