// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

std::optional<double> number_in(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return *number;
  if (const bool* truth = std::get_if<bool>(&cell)) return *truth ? 1.0 : 0.0;
  return {};
}

std::string short_text(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return format_short(*number);
  if (const bool* truth = std::get_if<bool>(&cell)) return *truth ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&cell)) return *text;
  return "nothing";
}

bool same_cell(const Cell& a, const Cell& b) {
  const double* x = std::get_if<double>(&a);
  const double* y = std::get_if<double>(&b);
  if (x == nullptr || y == nullptr) return a == b;
  if (std::isnan(*x) || std::isnan(*y)) return std::isnan(*x) && std::isnan(*y);
  constexpr double relative = 1e-12;
  if (std::isinf(*x) || std::isinf(*y)) return *x == *y;
  return *x == *y || std::abs(*x - *y) <= relative * std::max(std::abs(*x), std::abs(*y));
}

namespace {

// "load [N]" -> {"load", "N"}; anything else is a name without a unit.
TableColumn split_unit(std::string_view name) {
  const std::size_t open = name.rfind(" [");
  if (name.ends_with(']') && open != std::string_view::npos && open > 0 && open + 3 < name.size())
    return {std::string(name.substr(0, open)), std::string(name.substr(open + 2, name.size() - open - 3))};
  return {std::string(name), {}};
}

TableColumn column_of(const Entry& entry) {
  TableColumn column = split_unit(entry.column);
  if (!entry.unit.empty()) column.unit = entry.unit;
  return column;
}

// Whether a spreadsheet would take the text for a formula, and compute it or ask another program for it. A
// number it takes for that number.
bool is_formula(std::string_view text) {
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
  const std::string_view digits = text.front() == '+' ? text.substr(1) : text;
  double number = 0;
  const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return wrong != std::errc() || end != digits.data() + digits.size();
}

// A formula is quoted and has an apostrophe before it, by which spreadsheets know a text.
std::string csv_text(std::string_view given) {
  const bool formula = is_formula(given);
  const std::string guarded = "'" + std::string(given);
  const std::string_view text = formula ? std::string_view(guarded) : given;
  if (!formula && !text.empty() && text.find_first_of(",\"\r\n") == std::string_view::npos)
    return std::string(text);
  std::string quoted_text = "\"";
  for (const char c : text) {
    if (c == '"') quoted_text += '"';
    quoted_text += c;
  }
  return quoted_text + "\"";
}

std::string csv_cell(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return format_exact(*number);
  if (const std::string* text = std::get_if<std::string>(&cell)) return csv_text(*text);
  return is_empty(cell) ? std::string() : short_text(cell);
}

[[noreturn]] void refuse_unit(std::string_view column, std::string_view had, std::string_view given) {
  throw Error(ErrorCode::bad_unit,
              "column " + quoted(column) + " is in " + std::string(had) + ", not in " + std::string(given),
              "a column has one unit; convert the value, or give it a column of its own");
}

}  // namespace

std::vector<std::string> Table::column_names() const {
  std::vector<std::string> names;
  for (const TableColumn& column : columns_) names.push_back(column.name);
  return names;
}

std::optional<std::size_t> Table::find_column(std::string_view name) const {
  const TableColumn wanted = split_unit(name);
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].name == wanted.name && (wanted.unit.empty() || columns_[k].unit == wanted.unit)) return k;
  return {};
}

std::size_t Table::column(std::string_view name, std::string_view key) const {
  if (const auto found = find_column(name)) return *found;
  const std::vector<std::string> names = column_names();
  const std::string near = did_you_mean(name, names);
  std::string hint;
  if (names.empty()) {
    hint = "nothing is written in the notebook yet";
  } else if (near.empty()) {
    hint = "its columns are " + joined(names, " and ");
  }
  throw Error(ErrorCode::unknown_name,
              quoted(key) + " names " + quoted(name) + ", which is no column of the notebook" + near, hint);
}

const Cell& Table::cell(std::size_t row, std::size_t column) const {
  static const Cell nothing;
  const std::vector<Cell>& cells = rows_[row];
  return column < cells.size() ? cells[column] : nothing;
}

void Table::check(std::span<const Entry> row) const {
  if (row.empty())
    throw Error(ErrorCode::bad_value, "a notebook row has no columns", "give at least one, as in {mu = 0.4}");
  std::vector<std::string> seen;
  for (const Entry& entry : row) {
    const TableColumn column = column_of(entry);
    if (column.name.empty())
      throw Error(ErrorCode::bad_value, "a notebook column has an empty name", "give every column a name");
    seen.push_back(column.name);
    const auto known = find_column(column.name);
    if (known && !column.unit.empty() && !columns_[*known].unit.empty() &&
        columns_[*known].unit != column.unit)
      refuse_unit(column.name, columns_[*known].unit, column.unit);
  }
  std::ranges::sort(seen);
  if (const auto twice = std::ranges::adjacent_find(seen); twice != seen.end())
    throw Error(ErrorCode::bad_value, "a notebook row has column " + quoted(*twice) + " twice",
                "give each column one value");
}

std::size_t Table::place(std::string_view name) {
  if (const auto known = find_column(name)) return *known;
  columns_.push_back({std::string(name), {}});
  return columns_.size() - 1;
}

bool Table::append(std::span<const Entry> row) {
  check(row);
  bool changed = false;
  std::vector<Cell> cells;
  for (const Entry& entry : row) {
    TableColumn given = column_of(entry);
    const std::size_t before = columns_.size();
    const std::size_t k = place(given.name);
    changed |= columns_.size() != before;
    if (columns_[k].unit.empty() && !given.unit.empty()) {
      columns_[k].unit = std::move(given.unit);
      changed = true;
    }
    if (cells.size() <= k) cells.resize(k + 1);
    cells[k] = entry.value;
  }
  rows_.push_back(std::move(cells));
  return changed;
}

bool Table::declare_unit(std::string_view column, std::string_view unit) {
  if (column.empty())
    throw Error(ErrorCode::bad_value, "a notebook column has an empty name", "give every column a name");
  const std::size_t before = columns_.size();
  const std::size_t k = place(column);
  if (!columns_[k].unit.empty() && columns_[k].unit != unit) refuse_unit(column, columns_[k].unit, unit);
  if (columns_[k].unit == unit) return columns_.size() != before;
  columns_[k].unit = unit;
  return true;
}

std::string Table::csv_header() const {
  std::string line;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const TableColumn& column = columns_[k];
    if (k > 0) line += ',';
    line += csv_text(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  return line + "\n";
}

std::string Table::csv_row(std::size_t row) const {
  std::string line;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (k > 0) line += ',';
    line += csv_cell(cell(row, k));
  }
  return line + "\n";
}

std::string Table::csv() const {
  std::string text = csv_header();
  for (std::size_t row = 0; row < rows(); ++row) text += csv_row(row);
  return text;
}

}  // namespace asperity
