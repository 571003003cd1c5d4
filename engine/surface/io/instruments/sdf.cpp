// SPDX-License-Identifier: GPL-3.0-or-later
// SDF of ISO 25178-71 and its predecessor (EUR 15178, "aBCR-1.0"): a text or 81-byte header, then the
// heights by profile, in units of Zscale metres. Missing points: BAD in text; in binary NaN, the least
// signed or the greatest unsigned number. Layout: ISO 25178-71 and NIST's page.
#include "engine/core/require.hpp"
#include "engine/surface/io/instruments/instrument_header.hpp"
#include "engine/surface/io/write.hpp"

namespace asperity {

namespace {

struct SdfHeader {
  std::uint64_t points = 0, profiles = 0;
  double x_scale = 0, y_scale = 0, z_scale = 0;
  std::uint64_t compression = 0, type = 0;
};

struct SdfNumber {
  NumberType type;
  double missing = std::numeric_limits<double>::quiet_NaN();
};
constexpr std::array<SdfNumber, 8> sdf_numbers{{{number_type<std::uint8_t>},
                                                {number_type<std::uint16_t>, 65535},
                                                {number_type<std::uint32_t>, 4294967295},
                                                {number_type<float>},
                                                {number_type<std::int8_t>},
                                                {number_type<std::int16_t>, -32768},
                                                {number_type<std::int32_t>, -2147483648},
                                                {number_type<double>}}};

// "aISO-1.0", "bBCR-1.0": a (text) or b (binary), capitals, a version.
bool is_version(std::string_view mark, char form) {
  return mark.size() >= 8 && mark[0] == form && (mark.substr(1, 4) == "ISO-" || mark.substr(1, 4) == "BCR-");
}

// Some texts have the header name a few lines below.
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
  if (header.type >= sdf_numbers.size())
    refuse_file(file, "has the DataType " + std::to_string(header.type), "types 0 to 7 are read");
  above_zero(file, header.z_scale, "as its Zscale");
  for (const double scale : {header.x_scale, header.y_scale})
    if (!(scale >= 0) || !std::isfinite(scale))
      refuse_file(file, "gives " + format_short(scale) + " as the distance of its points");
}

// 0 is unknown, as in a single profile.
HeightMap described(const SdfHeader& header, Field heights) {
  HeightMap map;
  map.heights = std::move(heights);
  map.unit = header.z_scale;
  map.trace = header.profiles == 1;
  if (header.x_scale > 0) map.size_x = header.x_scale * static_cast<double>(header.points);
  if (header.y_scale > 0 && !map.trace) map.size_y = header.y_scale * static_cast<double>(header.profiles);
  return map;
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
  const NumberType type = sdf_numbers[header.type].type;
  const double missing = sdf_numbers[header.type].missing;
  require_numbers(file, header.points, header.profiles, type.width, data.size());
  // A text trailer may follow the heights.
  const std::string_view rest = data.substr(header.points * header.profiles * type.width);
  const auto is_text = [](char c) {
    return static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\x1A' ||
           c == '\0';
  };
  const bool trailer = std::all_of(rest.begin(), rest.end(), is_text) &&
                       std::any_of(rest.begin(), rest.end(), [](char c) { return c >= ' '; });
  if (!trailer) require_exactly(file, header.points, header.profiles, type.width, data.size());
  return described(header, field_of_numbers(type, data, header.points, header.profiles, monitor,
                                            [&](double value) { return value == missing; }));
}

SdfHeader read_text_header(const SourceFile& file, LineReader& lines) {
  HeaderEntries entries(file);
  std::string_view line;
  lines.next(line);
  while (lines.next(line)) {
    const std::string_view plain = trimmed(line);
    if (plain.starts_with('*'))
      return {entries.count("numpoints"), entries.count("numprofiles"),
              entries.decimal("xscale"),  entries.decimal("yscale"),
              entries.decimal("zscale"),  entries.find("compression") ? entries.count("compression") : 0,
              entries.count("datatype")};
    // Comments begin with a semicolon, also after a value.
    const std::string_view statement = plain.substr(0, plain.find(';'));
    const std::size_t sign = std::min(statement.find('='), statement.size());
    entries.replace(lower_case(trimmed(statement.substr(0, sign))),
                    trimmed(statement.substr(std::min(sign + 1, statement.size()))));
  }
  refuse_file(file, "has no line * after its header", "the file is cut short");
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
  return is_version(file.bytes(), 'b') ? read_binary(file, monitor) : read_text(file, monitor);
}

std::string sdf_header(const Grid& grid) {
  std::string bytes = "bISO-1.0Asperity  ";
  // Fixed dates: equal bytes.
  for (int k = 0; k < 2; ++k) bytes += "010119700000";
  for (const int number : {grid.nx, grid.ny}) bytes += raw_bytes(static_cast<std::uint16_t>(number));
  // hx, hy and unit of height in m; a negative resolution means unknown.
  for (const double number : {grid.hx(), grid.hy(), 1.0, -1.0}) bytes += raw_bytes(number);
  for (const int number : {0, 7, 0}) bytes += raw_bytes(static_cast<std::uint8_t>(number));
  return bytes;
}

}  // namespace

extern constexpr Format sdf_format{
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

// Writes binary SDF (bISO-1.0): heights in metres as doubles, missing points NaN. A size, stored as spacing,
// may differ in the last digit, and a map of one line reads back as a trace.
// Throws Error{bad_value} above 65535 points a side, Error{bad_file}.
void write_sdf(const Surface& surface, const std::string& path, Monitor& monitor) {
  const Grid& grid = surface.grid();
  constexpr int most = std::numeric_limits<std::uint16_t>::max();
  if (grid.nx > most || grid.ny > most)
    refuse(file_name(path) + " cannot be written: SDF counts " + std::to_string(most) +
               " points a side, and the surface has " + std::to_string(grid.nx) + " x " +
               std::to_string(grid.ny),
           "write .x3p, .h5 or .npy");
  const Field& heights = surface.measured_heights();
  const auto append = [&](std::int64_t j, std::string& bytes) {
    const auto row = heights.row(static_cast<int>(j));
    bytes.append(reinterpret_cast<const char*>(row.data()), row.size_bytes());
  };
  write_rows(path, sdf_header(grid), grid.ny, append, monitor);
}

}  // namespace asperity
