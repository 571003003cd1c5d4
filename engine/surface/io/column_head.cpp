// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/column_head.hpp"

#include <algorithm>
#include <cctype>

#include "engine/core/files/text_table.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/statistics/table_lines.hpp"

namespace asperity {

namespace {

constexpr std::size_t longest_head = 200;
constexpr std::string_view unit_begins = "[(/", unit_ends = "])";

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

HeadColumn head_column(std::string_view cell) {
  HeadColumn column;
  std::string_view name = cell;
  if (const std::size_t begins = cell.find_first_of(unit_begins); begins != std::string_view::npos) {
    name = trimmed(cell.substr(0, begins));
    std::string_view word = cell.substr(begins + 1);
    if (cell[begins] != '/') word = word.substr(0, word.find_last_of(unit_ends));
    column.word = std::string(trimmed(word));
    column.unit = length_unit(column.word);
  } else if (const std::size_t gap = cell.find_last_of(" _"); gap != std::string_view::npos) {
    const std::string_view word = cell.substr(gap + 1);
    column.unit = cell[gap] == '_' ? exact_unit(word) : length_unit(word);
    if (column.unit) {
      column.word = std::string(word);
      name = trimmed(cell.substr(0, gap));
    }
  }
  column.name = lower_case(name);
  return column;
}

}  // namespace

std::optional<double> exact_unit(std::string_view text) {
  const std::optional<Quantity> unit = known_unit(text);
  return unit && unit->dimension == dimension::length ? std::optional(unit->value) : std::nullopt;
}

std::string_view without_mark(std::string_view line) {
  line = trimmed(line);
  line.remove_prefix(std::min(line.find_first_not_of("#%"), line.size()));
  return trimmed(line);
}

std::optional<double> length_unit(std::string_view text) {
  std::string plain = lower_case(trimmed(text));
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '(' || c == ')' || c == '[' || c == ']'; }, ' ');
  const std::vector<std::string_view> words = cells_of(plain, Separator::blank);
  if (words.empty()) return {};
  std::string_view last = words.back();
  if (last.size() > 2 && last.ends_with('s')) last.remove_suffix(1);
  if (last == "micrometer" || last == "micrometre" || last == "micron" || last == "\xB5m") return 1e-6;
  if (last == "nanometer" || last == "nanometre") return 1e-9;
  if (last == "millimeter" || last == "millimetre") return 1e-3;
  if (last == "meter" || last == "metre") return 1.0;
  if (last == "angstrom" || last == "\xC5" || last == "a") return 1e-10;
  return exact_unit(last);
}

std::optional<std::vector<HeadColumn>> column_head(std::string_view line) {
  line = without_mark(line);
  if (line.empty() || line.size() > longest_head || line.find('=') != std::string_view::npos) return {};
  std::vector<TableCell> cells = head_cells(line);
  if (cells.size() > 1 && cells.back().text.empty()) cells.pop_back();
  std::vector<HeadColumn> columns;
  for (const TableCell& cell : cells) {
    columns.push_back(head_column(trimmed(cell.text)));
    if (columns.back().name.empty() || !is_letter(columns.back().name.front())) return {};
  }
  return columns;
}

bool are_points(const std::vector<HeadColumn>& columns) {
  return columns.size() == 3 && columns[0].name.front() == 'x' && columns[1].name.front() == 'y' &&
         columns[2].name.front() == 'z';
}

std::optional<std::vector<HeadColumn>> xyz_head(std::string_view line) {
  auto columns = column_head(line);
  if (columns && are_points(*columns)) return columns;
  // "xyz", "x,y,z;"
  constexpr std::size_t short_line = 64;
  const std::string text = lower_case(without_mark(line));
  const std::size_t x = text.find('x'), y = text.find('y'), z = text.find('z');
  const bool named = x != std::string::npos && y != std::string::npos && z != std::string::npos && x < 2 &&
                     x < y && y < z && text.size() < short_line;
  if (!named) return {};
  return std::vector<HeadColumn>{{"x", {}, {}}, {"y", {}, {}}, {"z", {}, {}}};
}

bool are_of_profile(const std::vector<HeadColumn>& columns) {
  if (columns.size() != 2) return false;
  const HeadColumn &position = columns[0], &height = columns[1];
  const bool plain = position.name == "x" && (height.name == "z" || height.name == "y");
  return plain || position.unit || height.unit;
}

std::optional<std::vector<HeadColumn>> profile_head(std::string_view line) {
  auto columns = column_head(line);
  if (!columns || !are_of_profile(*columns)) return {};
  return columns;
}

std::optional<double> head_unit(const HeadColumn& column, const SourceFile& file, Monitor& monitor) {
  if (!column.unit && !column.word.empty() && column.word != "-")
    monitor.warn(file_name(file.path()) + " gives its " + shown(column.name) + " in " + shown(column.word) +
                 ", which is no unit of length");
  return column.unit;
}

}  // namespace asperity
