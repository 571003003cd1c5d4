// SPDX-License-Identifier: GPL-3.0-or-later
// Text matrices: one line of numbers per y, j = 0 first; top first under Gwyddion's head. Known headers: our
// own (`# asperity surface`, `# asperity profile`), `h= w= pixel size= height conversion factor=`, and
// comments `Width:`, `Height:`, `Value units:`. Two columns are position and height in our own profiles and
// under a line such as "x [mm],z [um]"; else heights.
#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/surface/io/column_head.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/own_head.hpp"

namespace asperity {

namespace {

struct Header {
  bool own_profile = false, own_matrix = false;
  std::optional<double> columns, rows;
  std::optional<double> width, height, unit, pixel, closed_radius;  // m
  std::optional<std::vector<HeadColumn>> pair;                      // position and height
  bool pair_named = false;                                          // not by a comment
};

// A number or a length, such as "3.7e-007 m", above zero.
double needed(std::string_view text, const SourceFile& file, std::string_view key) {
  text = trimmed(text);
  double value = 0;
  if (const TextCell cell = read_cell(text, Separator::blank); cell.kind == CellKind::number)
    value = cell.value;
  else if (const auto own = quantity_in_cell(text);
           own && own->dimension == dimension::length && text.find(',') == std::string_view::npos)
    value = own->value;
  if (!(value > 0))
    refuse_file(file, "has a header whose `" + std::string(key) + "` is " + shown(text),
                "it must be a number above zero, with or without a unit of length");
  return value;
}

// Skips keys unrelated to the grid.
void take_in(Header& header, const SourceFile& file, std::string_view key_text, std::string_view value) {
  using Member = std::optional<double> Header::*;
  // Gwyddion's head is localised.
  static constexpr std::array<std::pair<std::string_view, Member>, 11> members{
      {{"h", &Header::rows},
       {"w", &Header::columns},
       {"samples", &Header::rows},
       {"pixel size", &Header::pixel},
       {"spacing [m]", &Header::pixel},
       {"unit [m]", &Header::unit},
       {"closed radius [m]", &Header::closed_radius},
       {"width", &Header::width},
       {"breite", &Header::width},
       {"height", &Header::height},
       {"h\u00F6he", &Header::height}}};
  const std::string key = lower_case(trimmed(key_text));
  for (const auto& [name, member] : members)
    if (key == name) header.*member = needed(value, file, key);
  if (key.starts_with("height conversion factor"))
    header.unit = needed(value, file, "height conversion factor");
  if (key == "cells" || key == "size [m]") {
    const std::string_view both = trimmed(value);
    const std::size_t gap = std::min(both.find(' '), both.size());
    (key == "cells" ? header.columns : header.width) = needed(both.substr(0, gap), file, key);
    (key == "cells" ? header.rows : header.height) = needed(both.substr(gap), file, key);
    header.own_matrix = true;
  }
  if (key == "value units")
    if (const auto unit = unit_in_cell(value); unit && unit->dimension == dimension::length)
      header.unit = unit->value;  // otherwise the call must state it
}

// "h=305 w=75" holds two settings, "height conversion factor (-> m)=3e-8" one.
void take_in_line(Header& header, const SourceFile& file, std::string_view line) {
  const std::vector<std::string_view> words = cells_of(line, Separator::blank);
  if (words.size() > 1 && std::ranges::count(line, '=') > 1) {
    for (const std::string_view word : words)
      if (word.find('=') != std::string_view::npos) take_in_line(header, file, word);
    return;
  }
  std::size_t sign = line.find('=');
  if (sign == std::string_view::npos) sign = line.find(':');
  if (sign != std::string_view::npos) take_in(header, file, line.substr(0, sign), line.substr(sign + 1));
}

// A comment with fewer than two units may be unrelated.
std::optional<std::vector<HeadColumn>> units_of_pair(std::string_view line) {
  auto pair = profile_head(line);
  if (pair && (*pair)[0].unit && (*pair)[1].unit) return pair;
  return {};
}

Header read_header(LineReader& lines, const SourceFile& file) {
  Header header;
  std::string_view line;
  for (LineReader ahead = lines; ahead.next(line); lines = ahead) {
    line = trimmed(line);
    if (line.empty()) continue;
    if (line.front() == '#' || line.front() == '%') {
      line = without_mark(line);
      if (line == "asperity profile") header.own_profile = true;
      take_in_line(header, file, line);
      if (!header.own_profile && !header.pair) header.pair = units_of_pair(line);
      continue;
    }
    if (is_row_of_numbers(line)) return header;
    if (auto pair = profile_head(line)) {
      header.pair = std::move(pair);
      header.pair_named = true;
      lines = ahead;
      return header;
    }
    if (line.find('=') == std::string_view::npos)
      refuse_file(
          file,
          "holds no table of numbers: line " + std::to_string(ahead.number()) + " starts with " + shown(line),
          "a text matrix has one line of numbers for each y, comments start with #");
    take_in_line(header, file, line);
  }
  return header;
}

bool recognises_text_matrix(const SourceFile& file) {
  if (!file.looks_like_text()) return false;
  LineReader lines(file.text());
  std::string_view line;
  while (lines.next(line)) {
    const std::string_view text = trimmed(line);
    if (is_skipped(text)) continue;
    return is_row_of_numbers(text) || (text.starts_with("h=") && text.find("w=") != std::string_view::npos) ||
           profile_head(text) || own_head(file);
  }
  return false;
}

void check_count(const SourceFile& file, const std::optional<double>& said, int found,
                 std::string_view what) {
  if (said && *said != found)
    refuse_file(file,
                "says in its header that it has " +
                    std::to_string(static_cast<long long>(std::min(*said, 1e15))) + " " + std::string(what) +
                    " but holds " + std::to_string(found),
                "the file is cut short or its header is wrong");
}

HeightMap map_of(const TextTable& table) {
  HeightMap map;
  map.heights = Field(table.columns, table.rows);
  std::copy(table.values.begin(), table.values.end(), map.heights.values().begin());
  return map;
}

HeightMap pair_of(HeightMap map, const std::vector<HeadColumn>& head, const SourceFile& file,
                  Monitor& monitor) {
  map.pairs = map.named_columns = true;
  map.position_unit = head_unit(head[0], file, monitor);
  map.unit = head_unit(head[1], file, monitor);
  return map;
}

std::optional<double> size_along(const SourceFile& file, const std::optional<double>& size,
                                 const std::optional<double>& spacing, int nodes, const std::string& axis) {
  if (!spacing) return size;
  const double found = *spacing * nodes;
  if (size && !(*size > 0.99 * (found - *spacing) && *size < 1.01 * found))
    refuse_file(file,
                "states a length of " + format_quantity(*size, dimension::length) + " along " + axis +
                    " and " + std::to_string(nodes) + " points " +
                    format_quantity(*spacing, dimension::length) + " apart",
                "correct the wrong value");
  return found;
}

HeightMap read_under_own_head(const SourceFile& file, const OwnHead& head, Monitor& monitor) {
  LineReader lines(file.text());
  std::string_view line;
  while (lines.number() < head.lines && lines.next(line)) continue;
  const TextTable table = read_table(lines, file, monitor);
  warn_if_cut(file, monitor);
  if (head.stated_columns && head.stated_rows && *head.stated_columns == table.rows &&
      *head.stated_rows == table.columns && table.rows != table.columns)
    refuse_file(file,
                "states " + std::to_string(table.rows) + " columns and " + std::to_string(table.columns) +
                    " rows, and holds " + std::to_string(table.columns) + " numbers on each of " +
                    std::to_string(table.rows) + " lines",
                "a line holds one y: transpose the numbers, or correct the head");
  check_count(file, head.stated_columns, table.columns, "columns");
  check_count(file, head.stated_rows, table.rows, "rows");
  for (const std::string& what : head.twice)
    monitor.warn(file_name(file.path()) + " has two values for " + what + " in its head; neither is used");
  HeightMap map = map_of(table);
  map.unit = head.unit;
  if (head.names && table.columns == 2 && are_of_profile(*head.names))
    return pair_of(std::move(map), *head.names, file, monitor);
  if (head.names && table.columns == 1 && head.names->front().unit) map.unit = head.names->front().unit;
  if (table.columns == 1) {  // one sample per line
    map.size_y = head.spacing_x ? *head.spacing_x * table.rows : head.size ? head.size : head.size_x;
    return map;
  }
  map.size_x = size_along(file, head.size_x, head.spacing_x, table.columns, "x");
  map.size_y = size_along(file, head.size_y, head.spacing_y, table.rows, "y");
  if (!map.size_x) map.size_x = head.size;
  if (!map.size_y && table.columns == table.rows) map.size_y = head.size;
  return map;
}

HeightMap read_text_matrix(const SourceFile& file, Monitor& monitor) {
  if (!file.looks_like_text()) refuse_file(file, "is not text: it holds zero bytes");
  if (const auto head = own_head(file)) return read_under_own_head(file, *head, monitor);
  LineReader lines(file.text());
  const Header header = read_header(lines, file);
  TextTable table = read_table(lines, file, monitor);
  warn_if_cut(file, monitor);
  HeightMap map = map_of(table);
  if (header.own_profile) {
    check_count(file, header.rows, table.rows, "samples");
    if (table.columns != 2)
      refuse_file(file, "has " + std::to_string(table.columns) + " columns",
                  "a profile has two, position and height");
    map.heights = Field(table.rows, 1);
    std::ranges::copy(table.column(1), map.heights.values().begin());
    if (header.pixel) map.size_x = *header.pixel * table.rows;
    map.spacing = header.pixel;
    map.unit = 1.0;
    map.trace = true;
    map.closed_radius = header.closed_radius;
    return map;
  }
  check_count(file, header.columns, table.columns, "columns");
  check_count(file, header.rows, table.rows, "rows");
  map.unit = header.unit;
  if (header.width && header.height && !header.own_matrix) map.first_line = FirstLine::top;  // Gwyddion
  if (header.pair_named && table.columns != 2)
    refuse_file(file, "has " + std::to_string(table.columns) + " columns under a head that names two");
  if (header.pair && table.columns == 2) return pair_of(std::move(map), *header.pair, file, monitor);
  map.size_x = header.width;
  map.size_y = header.height;
  if (header.pixel) {
    map.size_x = *header.pixel * table.columns;
    map.size_y = *header.pixel * table.rows;
  }
  return map;
}

}  // namespace

extern constexpr Format text_format{
    "text",
    "a line of numbers first",
    {"A matrix of numbers, one line a row, or a trace, bare or under a head: of this program, of Gwyddion, "
     "of common exports, or of words, of which lengths with a unit and counts are taken; in UTF-16 too.",
     "Lines of different lengths; tables under words that may be points, a log or a "
     "wrapped matrix, unless the head or the call says.",
     "Files of the public test set of SurfaceTopography."},
    {FirstLine::bottom, "A matrix: its first line is j = 0; under Gwyddion's head it is the top."},
    {"txt", "csv", "asc", "dat", "tsv"},
    recognises_text_matrix,
    read_text_matrix,
    nullptr,
    true};

}  // namespace asperity
