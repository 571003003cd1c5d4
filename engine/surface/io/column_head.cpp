// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/column_head.hpp"

#include <cctype>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"
#include "engine/surface/io/length_unit.hpp"

namespace asperity {

namespace {

constexpr std::size_t longest_head = 200;
constexpr std::string_view unit_begins = "[(/", unit_ends = "])";

std::string_view without_mark(std::string_view line) {
  line = trimmed(line);
  while (!line.empty() && (line.front() == '#' || line.front() == '%')) line.remove_prefix(1);
  return trimmed(line);
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// A unit in brackets or after a slash belongs to the preceding name.
std::vector<std::string> blank_cells(std::string_view line) {
  std::vector<std::string> cells;
  bool open = false;
  for (const std::string_view word : cells_of(line, Separator::blank)) {
    const bool goes_on = !cells.empty() && (open || cells.back().back() == '/' ||
                                            unit_begins.find(word.front()) != std::string_view::npos);
    if (goes_on)
      cells.back() += " " + std::string(word);
    else
      cells.emplace_back(word);
    const std::size_t begins = cells.back().find_last_of("[("), ends = cells.back().find_last_of(unit_ends);
    open = begins != std::string::npos && (ends == std::string::npos || ends < begins);
  }
  return cells;
}

std::vector<std::string> head_cells(std::string_view line) {
  for (const auto& [mark, separator] : {std::pair{';', Separator::semicolon}, std::pair{'\t', Separator::tab},
                                        std::pair{',', Separator::comma}}) {
    if (line.find(mark) == std::string_view::npos) continue;
    std::vector<std::string> cells;
    for (const std::string_view cell : cells_of(line, separator)) cells.emplace_back(cell);
    if (cells.back().empty()) cells.pop_back();
    return cells;
  }
  return blank_cells(line);
}

// Case matters: "m" of "x_m" is a unit, "a" of "x_a" is not.
std::optional<double> exact_unit(std::string_view text) {
  try {
    const Quantity unit = parse_unit(text);
    if (unit.dimension == dimension::length) return unit.value;
  } catch (const Error&) {  // part of the name
  }
  return {};
}

HeadColumn head_column(std::string_view cell) {
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2));
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

std::optional<std::vector<HeadColumn>> column_head(std::string_view line) {
  line = without_mark(line);
  // "h=3 w=4" is a setting.
  if (line.empty() || line.size() > longest_head || line.find('=') != std::string_view::npos) return {};
  std::vector<HeadColumn> columns;
  for (const std::string& cell : head_cells(line)) {
    columns.push_back(head_column(cell));
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
