// SPDX-License-Identifier: GPL-3.0-or-later
// BCR and BCRF of Image Metrology (SPIP): a text header, then 16-bit integers (`bcrstm`, unit `bit2nm`) or
// 32-bit floating-point numbers (`bcrf`, unit `zunit`, default nm). Missing points: above 1.7e38; 32767 in
// 16 bits unless `voidpixels` is 0; a negative or fractional `voidpixels`. Layout: Gwyddion's and
// SurfaceTopography's readers.
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/io/length_unit.hpp"

namespace asperity {

namespace {

constexpr std::size_t header_characters = 2048;
constexpr std::string_view unicode_ending = "_unicode";
constexpr double nanometre = 1e-9;

using Lines = std::map<std::string, std::string>;

std::pair<std::string, std::string_view> statement(std::string_view line) {
  const std::size_t sign = line.find('=');
  if (line.starts_with('%') || line.starts_with('#') || sign == std::string_view::npos) return {};
  return {lower_case(trimmed(line.substr(0, sign))), trimmed(line.substr(sign + 1))};
}

// In single bytes; non-ASCII characters, irrelevant here, become question marks.
struct BcrHeader {
  std::string text;
  std::size_t data_at = 0;
};

bool is_utf16_head(std::string_view bytes) {
  constexpr std::string_view mark("\xFF\xFE", 2), first("f\0i\0l\0e\0", 8);
  if (bytes.starts_with(mark)) bytes.remove_prefix(mark.size());
  if (bytes.size() < first.size()) return false;
  for (std::size_t k = 0; k < first.size(); ++k)
    if (std::tolower(static_cast<unsigned char>(bytes[k])) != first[k]) return false;
  return true;
}

BcrHeader header_of(const SourceFile& file, std::size_t characters) {
  const std::string_view bytes = file.bytes();
  if (!is_utf16_head(bytes)) return {std::string(bytes.substr(0, characters)), characters};
  BcrHeader header;
  for (std::size_t k = 0; k + 1 < bytes.size() && header.text.size() < characters; k += 2)
    header.text += bytes[k + 1] == '\0' ? bytes[k] : '?';
  if (header.text.starts_with('?')) header.text.erase(0, 1);  // the byte order mark
  header.data_at = 2 * characters;
  return header;
}

bool recognises_bcr(const SourceFile& file) {
  const BcrHeader header = header_of(file, 64);
  LineReader reader(header.text);
  std::string_view line;
  if (!reader.next(line)) return false;
  const auto [key, value] = statement(line);
  return key == "fileformat" && lower_case(value).starts_with("bcr");
}

std::uint64_t count_of(const SourceFile& file, const Lines& lines, const std::string& key) {
  const auto found = lines.find(key);
  if (found == lines.end()) refuse_file(file, "has no " + key + " in its header");
  if (const auto count = count_in(found->second)) return *count;
  refuse_file(file, "has no count for " + key + " in its header: " + shown(found->second));
}

// Returns the numbers in `data`.
Lines lines_of(const SourceFile& file, std::size_t characters, std::string_view& data) {
  const BcrHeader header = header_of(file, characters);
  if (file.bytes().size() < header.data_at)
    refuse_file(file, "is cut short in its header of " + std::to_string(header.data_at) + " bytes");
  data = file.bytes().substr(header.data_at);
  std::string_view text = header.text;
  text = text.substr(0, text.find('\0'));
  Lines lines;
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line))
    if (const auto [key, value] = statement(line); !key.empty()) lines.emplace(key, value);
  return lines;
}

Lines read_lines(const SourceFile& file, std::string_view& data) {
  require_format(file, recognises_bcr(file),
                 "is not a BCR file: it starts with neither `fileformat = bcrstm` nor `fileformat = bcrf`");
  Lines lines = lines_of(file, header_characters, data);
  if (lines.count("headersize") == 0) return lines;
  const std::uint64_t said = count_of(file, lines, "headersize");
  if (said == header_characters) return lines;
  if (said < header_characters || said > file.bytes().size())
    refuse_file(file, "says that its header has " + std::to_string(said) + " characters",
                "they are 2048 or more, and no more than the file has");
  return lines_of(file, static_cast<std::size_t>(said), data);
}

// The number of a missing point; some files state a count of missing points instead.
double void_number(const SourceFile& file, const Lines& lines) {
  const auto found = lines.find("voidpixels");
  if (found == lines.end()) return 1;
  const TextCell cell = read_cell(found->second, Separator::blank);
  if (cell.kind != CellKind::number)
    refuse_file(file, "has no number for voidpixels in its header: " + shown(found->second));
  return cell.value;
}

// In metres; unit from the line `unit_key`, default nanometres.
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
  return big_endian ? field_of_numbers<T, asperity::big_endian<T>>(data, nx, ny, monitor, is_hole)
                    : field_of_numbers<T>(data, nx, ny, monitor, is_hole);
}

HeightMap read_bcr(const SourceFile& file, Monitor& monitor) {
  std::string_view data;
  const Lines lines = read_lines(file, data);
  std::string kind = lower_case(lines.at("fileformat"));
  if (is_utf16_head(file.bytes()) && kind.ends_with(unicode_ending))
    kind.resize(kind.size() - unicode_ending.size());
  const bool integers = kind == "bcrstm";
  if (!integers && kind != "bcrf")
    refuse_file(file, "is a BCR file of the kind " + shown(lines.at("fileformat")),
                "bcrstm and bcrf are read");
  const std::uint64_t columns = count_of(file, lines, "xpixels"), rows = count_of(file, lines, "ypixels");
  require_exactly(file, columns, rows, integers ? 2 : 4, data.size());
  const bool big_endian = lines.count("intelmode") != 0 && count_of(file, lines, "intelmode") == 0;
  const double void_value = void_number(file, lines);
  const bool value = void_value < 0 || void_value != std::floor(void_value);
  const int nx = static_cast<int>(columns), ny = static_cast<int>(rows);
  HeightMap map;
  if (integers) {
    constexpr std::int16_t missing = 32767;
    map.heights = heights_of<std::int16_t>(data, nx, ny, big_endian, monitor, [&](std::int16_t number) {
      return (void_value != 0 && number == missing) || (value && number == void_value);
    });
    map.unit = length_of(file, lines, "bit2nm", "zunit");
  } else {
    constexpr float least_missing = 1.7e38F;
    map.heights = heights_of<float>(data, nx, ny, big_endian, monitor, [&](float number) {
      return !(std::abs(number) <= least_missing) || (value && number == static_cast<float>(void_value));
    });
    const auto zunit = lines.find("zunit");
    map.unit = zunit == lines.end() ? nanometre : length_unit(zunit->second);
    if (!map.unit) refuse_file(file, "gives no known unit of length as zunit: " + shown(zunit->second));
    // The format defines bit2nm only for integers, although one reader applies it here.
    if (const auto scale = lines.find("bit2nm"); scale != lines.end()) {
      const TextCell cell = read_cell(scale->second, Separator::blank);
      if (cell.kind != CellKind::number || cell.value != 1)
        monitor.warn(file_name(file.path()) + " holds floating-point heights and a bit2nm of " +
                     shown(scale->second) + ", which is of integers: it is passed over");
    }
  }
  map.size_x = length_of(file, lines, "xlength", "xunit");
  map.size_y = length_of(file, lines, "ylength", "yunit");
  return map;
}

}  // namespace

const Format& bcr_format() {
  static const Format format{"bcr",
                             "`fileformat = bcrstm` or bcrf at the start",
                             {"BCR and BCRF of SPIP (Image Metrology): integers or single precision, in text "
                              "of one or two bytes a character.",
                              "Other kinds of number, heights that are no length.",
                              "A file in UTF-16 of the public test set of SurfaceTopography (bcrf): every "
                              "height, size; integers by the layout alone."},
                             {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
                             {"bcr", "bcrf"},
                             recognises_bcr,
                             read_bcr};
  return format;
}

}  // namespace asperity
