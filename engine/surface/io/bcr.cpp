// SPDX-License-Identifier: GPL-3.0-or-later
// BCR and BCRF of Image Metrology (SPIP) and of microscopes that write them: a header in text of 2048 bytes,
// lines of `key = value`, then integers of 16 bits (`fileformat = bcrstm`, heights `bit2nm` nanometres each)
// or floating-point numbers of 32 (`bcrf`, heights in nanometres), line by line. Numbers past 1.7e38 and,
// unless `voidpixels` is 0, 32767 are missing points. Layout as restated by Gwyddion's reader. `zmin` is
// passed over.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "engine/core/text.hpp"
#include "engine/surface/io/binary_cursor.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/length_unit.hpp"
#include "engine/surface/io/text_table.hpp"

namespace asperity {

namespace {

constexpr std::size_t header_bytes = 2048;
constexpr double nanometre = 1e-9;

using Lines = std::map<std::string, std::string>;

// The key and the value of a line; both empty for a comment or a line without `=`.
std::pair<std::string, std::string_view> statement(std::string_view line) {
  const std::size_t sign = line.find('=');
  if (line.starts_with('%') || line.starts_with('#') || sign == std::string_view::npos) return {};
  return {lower_case(trimmed(line.substr(0, sign))), trimmed(line.substr(sign + 1))};
}

bool recognises_bcr(const SourceFile& file) {
  LineReader reader(file.bytes().substr(0, 64));
  std::string_view line;
  if (!reader.next(line)) return false;
  const auto [key, value] = statement(line);
  return key == "fileformat" && lower_case(value).starts_with("bcr");
}

Lines read_lines(const SourceFile& file) {
  if (!recognises_bcr(file))
    refuse_file(file,
                "is not a BCR file: it starts with neither `fileformat = bcrstm` nor `fileformat = bcrf`",
                "if it is another format, name it with `format`");
  if (file.bytes().size() < header_bytes) refuse_file(file, "is cut short in its header of 2048 bytes");
  std::string_view text = file.bytes().substr(0, header_bytes);
  text = text.substr(0, text.find('\0'));
  Lines lines;
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line))
    if (const auto [key, value] = statement(line); !key.empty()) lines.emplace(key, value);
  return lines;
}

std::uint64_t count_of(const SourceFile& file, const Lines& lines, const std::string& key) {
  const auto found = lines.find(key);
  if (found == lines.end()) refuse_file(file, "has no " + key + " in its header");
  const std::string& text = found->second;
  std::uint64_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size())
    refuse_file(file, "has no count for " + key + " in its header: " + shown(text));
  return value;
}

// A length in the unit of another line, in metres; nanometres where there is no such line.
std::optional<double> length_of(const SourceFile& file, const Lines& lines, const std::string& key,
                                const std::string& unit_key) {
  const auto found = lines.find(key);
  if (found == lines.end()) return {};
  const TextCell cell = read_cell(found->second, Separator::blank);
  if (cell.kind != CellKind::number || !(cell.value > 0))
    refuse_file(file, "has no length for " + key + " in its header: " + shown(found->second));
  const auto unit = lines.find(unit_key);
  const std::optional<double> metres = unit == lines.end() ? nanometre : length_unit(unit->second);
  if (!metres) refuse_file(file, "gives no known unit of length as " + unit_key + ": " + shown(unit->second));
  return cell.value * *metres;
}

template <class T, class IsHole>
Field heights_of(std::string_view data, int nx, int ny, bool big_endian, Monitor& monitor, IsHole&& is_hole) {
  if (!big_endian) return field_of_numbers<T>(data, nx, ny, monitor, is_hole);
  Array<char> swapped(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(sizeof(T)) * nx * ny);
  for (std::size_t k = 0; k < swapped.size(); k += sizeof(T))
    std::reverse(swapped.data() + k, swapped.data() + k + sizeof(T));
  return field_of_numbers<T>({swapped.data(), swapped.size()}, nx, ny, monitor, is_hole);
}

HeightMap read_bcr(const SourceFile& file, Monitor& monitor) {
  const Lines lines = read_lines(file);
  const std::string& kind = lines.at("fileformat");
  const bool integers = lower_case(kind) == "bcrstm";
  if (!integers && lower_case(kind) != "bcrf")
    refuse_file(file, "is a BCR file of the kind " + shown(kind), "bcrstm and bcrf are read");
  const std::uint64_t columns = count_of(file, lines, "xpixels"), rows = count_of(file, lines, "ypixels");
  const std::string_view data = file.bytes().substr(header_bytes);
  require_numbers(file, columns, rows, integers ? 2 : 4, data.size());
  const bool big_endian = lines.count("intelmode") != 0 && count_of(file, lines, "intelmode") == 0;
  const bool voids = lines.count("voidpixels") == 0 || count_of(file, lines, "voidpixels") != 0;
  const int nx = static_cast<int>(columns), ny = static_cast<int>(rows);
  HeightMap map;
  if (integers) {
    constexpr std::int16_t missing = 32767;
    map.heights = heights_of<std::int16_t>(data, nx, ny, big_endian, monitor,
                                           [&](std::int16_t value) { return voids && value == missing; });
    map.unit = length_of(file, lines, "bit2nm", "zunit");
  } else {
    constexpr float least_missing = 1.7e38F;
    map.heights = heights_of<float>(data, nx, ny, big_endian, monitor,
                                    [](float value) { return !(std::abs(value) <= least_missing); });
    map.unit = nanometre;
  }
  map.size_x = length_of(file, lines, "xlength", "xunit");
  map.size_y = length_of(file, lines, "ylength", "yunit");
  return map;
}

}  // namespace

const Format& bcr_format() {
  static constexpr std::array<std::string_view, 2> endings{"bcr", "bcrf"};
  static const Format format{"bcr", "`fileformat = bcrstm` or bcrf at the start", endings, recognises_bcr,
                             read_bcr};
  return format;
}

}  // namespace asperity
