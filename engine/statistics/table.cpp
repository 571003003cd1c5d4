// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/table_head.hpp"

namespace asperity {

bool is_number(const Cell& cell) {
  return std::holds_alternative<double>(cell) || std::holds_alternative<std::int64_t>(cell);
}

std::optional<double> number_in(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  if (const bool* truth = std::get_if<bool>(&cell)) return *truth ? 1.0 : 0.0;
  return {};
}

std::string short_text(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return format_short(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  if (const bool* truth = std::get_if<bool>(&cell)) return *truth ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&cell)) return *text;
  return "nothing";
}

bool same_cell(const Cell& a, const Cell& b) {
  if (!is_number(a) || !is_number(b)) return a == b;
  const std::optional<double> x = number_in(a), y = number_in(b);
  if (std::isnan(*x) || std::isnan(*y)) return std::isnan(*x) && std::isnan(*y);
  constexpr double relative = 1e-12;
  if (std::isinf(*x) || std::isinf(*y)) return *x == *y;
  return *x == *y || std::abs(*x - *y) <= relative * std::max(std::abs(*x), std::abs(*y));
}

bool comes_before(const Cell& a, const Cell& b) {
  const auto rank = [](const Cell& cell) {
    return is_empty(cell) ? 0 : is_number(cell) ? 1 : std::holds_alternative<bool>(cell) ? 2 : 3;
  };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  if (!is_number(a)) return a < b;
  const double x = *number_in(a), y = *number_in(b);
  if (std::isnan(x) || std::isnan(y)) return std::isnan(y) && !std::isnan(x);
  return x < y;
}

TableColumn split_column_unit(std::string_view name) {
  if (!name.ends_with(']') && !name.ends_with(')') && name.find(" / ") == std::string_view::npos)
    return {std::string(name), {}};
  const TableHead head = table_head(name);
  if (head.unit == "-" || head.unit == "1") return {head.name, {}};
  if (!known_unit(head.unit)) return {std::string(name), {}};  // "signal [counts]"
  return {head.name, head.unit};
}

Cell cell_in_si(const Cell& cell, const std::string& unit_in_name) {
  return is_number(cell) && !unit_in_name.empty() ? from_unit(*number_in(cell), unit_in_name) : cell;
}

namespace {

// Security: a spreadsheet would execute the text. Plain numbers are safe.
bool is_formula(std::string_view text) {
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
  const std::string_view digits = text.front() == '+' ? text.substr(1) : text;
  double number = 0;
  const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return wrong != std::errc() || end != digits.data() + digits.size();
}

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

// 100000 instead of "1e+05".
std::string csv_number(double si, const std::string& unit) {
  constexpr double most = 1e15;
  std::string text = text_in_unit(si, unit);
  const double number = in_unit(si, unit);
  if (std::abs(number) >= most || number != std::floor(number)) return text;
  if (text.find('e') == std::string::npos) return text;
  return std::to_string(static_cast<std::int64_t>(number));
}

std::string csv_cell(const Cell& cell, const std::string& unit) {
  if (std::holds_alternative<double>(cell) || (is_number(cell) && !unit.empty()))
    return csv_number(*number_in(cell), unit);
  if (const std::string* text = std::get_if<std::string>(&cell)) return csv_text(*text);
  return is_empty(cell) ? std::string() : short_text(cell);
}

void check_unit(const TableColumn& column, std::string_view unit) {
  const Dimension given = parse_unit(unit).dimension, own = parse_unit(column.unit).dimension;
  if ((column.unit.empty() && !column.plain) || own == given) return;
  throw Error(ErrorCode::bad_unit,
              "column " + quoted(column.name) + " is " + describe(own) + ", and " + quoted(unit) +
                  " is a unit of " + describe(given),
              "write " + (column.unit.empty() ? quoted(column.name) + " or " + quoted(column.name + " [%]")
                                              : quoted(column.name + " [" + column.unit + "]")));
}

}  // namespace

Table::Table(std::vector<TableColumn> columns, std::vector<std::vector<Cell>> rows, std::string name)
    : name_(std::move(name)), columns_(std::move(columns)), rows_(std::move(rows)) {
  std::vector<std::string> names = column_names();
  std::ranges::sort(names);
  if (!names.empty() && names.front().empty())
    refuse("a column has an empty name", "give every column a name");
  if (const auto twice = std::ranges::adjacent_find(names); twice != names.end())
    refuse("two columns are called " + quoted(*twice), "give each column a name of its own");
  for (const std::vector<Cell>& row : rows_)
    if (row.size() > columns_.size())
      refuse("a row has " + std::to_string(row.size()) + " cells under " + std::to_string(columns_.size()) +
             " columns");
}

std::vector<std::string> Table::column_names() const {
  std::vector<std::string> names;
  for (const TableColumn& column : columns_) names.push_back(column.name);
  return names;
}

std::optional<std::size_t> Table::find_column(std::string_view name) const {
  const std::string wanted = split_column_unit(name).name;
  const auto found = std::ranges::find(columns_, wanted, &TableColumn::name);
  if (found == columns_.end()) return {};
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t Table::column(std::string_view name, std::string_view key) const {
  if (const auto found = find_column(name)) {
    display_unit_of(name, *found);  // refuses another dimension
    return *found;
  }
  const std::vector<std::string> names = column_names();
  const std::string near = did_you_mean(name, names);
  std::string hint = near.empty() ? "its columns are " + joined(names, " and ") : "";
  if (names.empty()) hint = "nothing is written in " + name_ + " yet";
  refuse_name(quoted(key) + " names " + quoted(name) + ", which is no column of " + name_ + near, hint);
}

const Cell& Table::cell(std::size_t row, std::size_t column) const {
  static const Cell nothing;
  const std::vector<Cell>& cells = rows_[row];
  return column < cells.size() ? cells[column] : nothing;
}

std::string Table::display_unit_of(std::string_view name, std::size_t column) const {
  const std::string unit = split_column_unit(name).unit;
  if (unit.empty()) return columns_[column].unit;
  check_unit(columns_[column], unit);
  return unit;
}

std::vector<Entry> Table::resolved(std::span<const Entry> row) const {
  if (row.empty()) refuse("a notebook row has no columns", "give at least one, as in {mu = 0.4}");
  std::vector<Entry> all;
  std::vector<std::string> seen;
  for (const Entry& entry : row) {
    TableColumn given = split_column_unit(entry.column);
    if (given.name.empty()) refuse("a notebook column has an empty name", "give every column a name");
    seen.push_back(given.name);
    Cell value = cell_in_si(entry.value, given.unit);
    std::string unit = given.unit.empty() ? entry.unit : given.unit;
    if (const auto known = find_column(given.name)) {
      if (!unit.empty()) check_unit(columns_[*known], unit);
      if (!columns_[*known].unit.empty()) unit = columns_[*known].unit;
    }
    all.push_back({std::move(given.name), std::move(value), std::move(unit)});
  }
  std::ranges::sort(seen);
  if (const auto twice = std::ranges::adjacent_find(seen); twice != seen.end())
    refuse("a notebook row has column " + quoted(*twice) + " twice", "give each column one value");
  return all;
}

std::size_t Table::place(std::string_view name) {
  if (const auto known = find_column(name)) return *known;
  if (name.empty()) refuse("a notebook column has an empty name", "give every column a name");
  columns_.push_back({std::string(name), {}});
  return columns_.size() - 1;
}

bool Table::append(std::span<const Entry> row) {
  std::vector<Entry> entries = resolved(row);
  bool changed = false;
  std::vector<Cell> cells;
  for (Entry& entry : entries) {
    const std::size_t before = columns_.size();
    const std::size_t k = place(entry.column);
    changed |= columns_.size() != before || columns_[k].unit != entry.unit;
    columns_[k].unit = std::move(entry.unit);
    if (cells.size() <= k) cells.resize(k + 1);
    cells[k] = std::move(entry.value);
  }
  rows_.push_back(std::move(cells));
  return changed;
}

bool Table::declare_column(std::string_view column) {
  const std::size_t before = columns_.size();
  place(column);
  return columns_.size() != before;
}

void Table::declare_dimension(std::string_view column, Dimension dimension) {
  TableColumn& declared = columns_[place(column)];
  declared.unit = si_unit(dimension);
  declared.plain = dimension == dimension::number;
}

bool Table::declare_unit(std::string_view column, std::string_view unit) {
  const std::size_t before = columns_.size();
  const std::size_t k = place(column);
  check_unit(columns_[k], unit);
  return std::exchange(columns_[k].unit, std::string(unit)) != unit || columns_.size() != before;
}

std::string Table::digest() const {
  Digester digester;
  digester.add("table").add(static_cast<std::int64_t>(columns_.size()));
  for (const TableColumn& column : columns_)
    digester.add(column.name).add(si_unit(parse_unit(column.unit).dimension));
  digester.add(static_cast<std::int64_t>(rows_.size()));
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Cell& one = cell(row, k);
      digester.add(static_cast<std::int64_t>(is_number(one) ? Cell(0.0).index() : one.index()));
      if (const auto number = number_in(one)) digester.add(*number);
      if (const auto* text = std::get_if<std::string>(&one)) digester.add(*text);
    }
  return digester.hex();
}

std::string Table::csv_header() const {
  std::string line;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const TableColumn& column = columns_[k];
    line += (k > 0 ? "," : "") +
            csv_text(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  return line + "\n";
}

std::string Table::csv_row(std::size_t row) const {
  std::string line;
  for (std::size_t k = 0; k < columns_.size(); ++k)
    line += (k > 0 ? "," : "") + csv_cell(cell(row, k), columns_[k].unit);
  return line + "\n";
}

std::string Table::csv() const {
  std::string text = csv_header();
  for (std::size_t row = 0; row < rows(); ++row) text += csv_row(row);
  return text;
}

}  // namespace asperity
