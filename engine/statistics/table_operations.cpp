// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_operations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "engine/core/files/text_table.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

std::vector<Cell> cells_in(const Table& table, std::size_t row) {
  std::vector<Cell> cells;
  cells.reserve(table.columns().size());
  for (std::size_t k = 0; k < table.columns().size(); ++k) cells.push_back(table.cell(row, k));
  return cells;
}

struct JoinColumn {
  std::size_t here, there;
};

JoinColumn join_column(const Table& table, const Table& other, const std::string& name) {
  JoinColumn column{table.column(name, "by"), other.column(name, "by")};
  const std::string &here = table.columns()[column.here].unit, &there = other.columns()[column.there].unit;
  const Quantity one = parse_unit(here), another = parse_unit(there);
  if (one.dimension != another.dimension)
    throw Error(ErrorCode::bad_unit,
                "column " + quoted(name) + " is " + describe(one.dimension) + " in " + table.name() +
                    " and " + describe(another.dimension) + " in " + other.name(),
                "rows are joined by equal values: give both columns the unit");
  return column;
}

class PartnerIndex {
 public:
  PartnerIndex(const Table& table, const Table& other, const std::vector<JoinColumn>& columns)
      : table_(table), columns_(columns), order_(other.rows()) {
    for (std::size_t row = 0; row < other.rows(); ++row) {
      std::vector<Cell> key;
      for (const JoinColumn& column : columns) key.push_back(other.cell(row, column.there));
      keys_.push_back(std::move(key));
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) {
      return comes_before(keys_[a].front(), keys_[b].front());
    });
  }

  std::vector<std::size_t> of(std::size_t row) const {
    const Cell& first = table_.cell(row, columns_.front().here);
    Cell from = first, to = first;
    if (is_number(first) && !std::isnan(*number_in(first))) {
      const double x = *number_in(first), near = std::isfinite(x) ? 2e-12 * std::abs(x) : 0;
      from = x - near;
      to = x + near;
    }
    const auto key = [&](std::size_t k) -> const Cell& { return keys_[k].front(); };
    const auto begin = std::ranges::lower_bound(order_, from, comes_before, key);
    const auto end = std::ranges::upper_bound(order_, to, comes_before, key);
    std::vector<std::size_t> found;
    for (auto place = begin; place < end; ++place)
      if (is_partner(row, keys_[*place])) found.push_back(*place);
    std::ranges::sort(found);
    return found;
  }

 private:
  bool is_partner(std::size_t row, const std::vector<Cell>& key) const {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (!same_cell(table_.cell(row, columns_[k].here), key[k])) return false;
    return true;
  }

  const Table& table_;
  const std::vector<JoinColumn>& columns_;
  std::vector<std::vector<Cell>> keys_;
  std::vector<std::size_t> order_;
};

std::string key_text(const Table& table, const std::vector<JoinColumn>& columns, std::size_t row) {
  std::string text;
  for (const JoinColumn& column : columns) {
    const TableColumn& named = table.columns()[column.here];
    text += (text.empty() ? "" : " and ") + quoted(named.name) + " = " +
            text_with_unit(table.cell(row, column.here), named.unit);
  }
  return text;
}

std::vector<TableColumn> joined_columns(const Table& table, const Table& other, const Join& join,
                                        const std::vector<std::size_t>& taken) {
  std::vector<TableColumn> columns = table.columns();
  std::vector<std::string> both;
  for (const std::size_t k : taken) {
    TableColumn column = other.columns()[k];
    if (table.find_column(column.name)) {
      both.push_back(quoted(column.name));
      column.name += join.suffix;
    }
    columns.push_back(std::move(column));
  }
  if (!both.empty() && join.suffix.empty())
    refuse("both tables have " + joined(both, " and ") + " besides the columns of `by`",
           "give the other's names a suffix, as in { by=\"N\", suffix=\"_predicted\" }");
  return columns;
}

// Without an exponent up to a million.
std::string readable_number(double number, int digits) {
  constexpr double most = 1e7;
  const std::string text = format_short(number, digits);
  if (text.find('e') == std::string::npos || std::abs(number) < 1 || std::abs(number) >= most) return text;
  return std::to_string(static_cast<std::int64_t>(std::strtod(text.c_str(), nullptr)));
}

// In the unit of the condition's name, or a quantity.
Cell wanted_in_si(const Cell& accepted, const std::string& unit_in_name, const TableColumn& column) {
  const auto* text = std::get_if<std::string>(&accepted);
  if (text == nullptr) return cell_in_si(accepted, unit_in_name);
  if (column.unit.empty()) return accepted;
  if (trimmed(*text).find_first_of("0123456789") != trimmed(*text).find_first_not_of("+-.")) return accepted;
  try {
    return from_unit(parse_quantity_in(*text, column.unit), column.unit);
  } catch (const Error& error) {
    throw Error(ErrorCode::bad_unit, "`where." + column.name + "`: " + error.sentence(), error.hint());
  }
}

}  // namespace

Table rows_of(const Table& table, std::span<const std::size_t> rows) {
  std::vector<std::vector<Cell>> cells;
  cells.reserve(rows.size());
  for (const std::size_t row : rows) cells.push_back(cells_in(table, row));
  return {table.columns(), std::move(cells), table.name()};
}

std::string text_with_unit(const Cell& cell, const std::string& unit) {
  if (!is_number(cell) || unit.empty()) return short_text(cell);
  return format_short(in_unit(*number_in(cell), unit)) + " " + unit;
}

Table in_display_units(const Table& table, std::span<const std::string> named) {
  std::vector<TableColumn> columns = table.columns();
  for (const std::string& name : named)
    if (const auto k = table.find_column(name)) columns[*k].unit = table.display_unit_of(name, *k);
  std::vector<std::vector<Cell>> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    rows.push_back(cells_in(table, row));
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (Cell& cell = rows.back()[k]; is_number(cell) && !columns[k].unit.empty())
        cell = in_unit(*number_in(cell), columns[k].unit);
  }
  return {std::move(columns), std::move(rows), table.name()};
}

Table joined(const Table& table, const Table& other, const Join& join) {
  if (join.by.empty()) refuse("`by` names no column", "name one that both tables have: { by=\"N\" }");
  std::vector<JoinColumn> by;
  for (const std::string& name : join.by) by.push_back(join_column(table, other, name));
  std::vector<std::size_t> taken;
  for (std::size_t k = 0; k < other.columns().size(); ++k)
    if (std::ranges::none_of(by, [k](const JoinColumn& c) { return c.there == k; })) taken.push_back(k);
  std::vector<TableColumn> columns = joined_columns(table, other, join, taken);
  const PartnerIndex index(table, other, by);
  std::vector<std::vector<Cell>> rows;
  std::vector<std::size_t> owner(other.rows(), table.rows());  // row of `table`
  std::size_t alone = 0, first_alone = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::vector<std::size_t> partners = index.of(row);
    if (partners.empty() && alone++ == 0) first_alone = row;
    if (partners.empty() && join.unmatched == Unmatched::keep) rows.push_back(cells_in(table, row));
    for (const std::size_t partner : partners) {
      if (partners.size() > 1 && owner[partner] < table.rows())
        refuse("rows with " + key_text(table, by, row) + " occur more than once in both tables",
               "join by one more column, or take means of one table first");
      owner[partner] = row;
      std::vector<Cell> cells = cells_in(table, row);
      for (const std::size_t k : taken) cells.push_back(other.cell(partner, k));
      rows.push_back(std::move(cells));
    }
  }
  if (alone > 0 && join.unmatched == Unmatched::refuse)
    refuse(counted(alone, "row") + " of " + table.name() + " without a match in " + other.name() +
               ", the first in row " + std::to_string(first_alone + 1) + ": " +
               key_text(table, by, first_alone),
           "unmatched=\"leave out\" takes the other rows, unmatched=\"keep\" leaves their cells empty");
  return {std::move(columns), std::move(rows), table.name()};
}

Table columns_of(const Table& table, std::span<const std::string> names) {
  if (names.empty()) return table;
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows(table.rows());
  for (const std::string& name : names) {
    const std::size_t k = table.column(name, "column");
    columns.push_back(table.columns()[k]);
    columns.back().unit = table.display_unit_of(name, k);
    for (std::size_t row = 0; row < table.rows(); ++row) rows[row].push_back(table.cell(row, k));
  }
  return {std::move(columns), std::move(rows), table.name()};
}

std::string table_text(const Table& table, std::size_t most, int digits) {
  const std::size_t rows = table.rows() > most ? most : table.rows();
  std::vector<std::vector<std::string>> lines(rows + 1);
  for (std::size_t k = 0; k < table.columns().size(); ++k) {
    const TableColumn& column = table.columns()[k];
    double largest = 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
      if (const auto number = number_in(table.cell(row, k)); number && std::isfinite(*number))
        largest = std::max(largest, std::abs(*number));
    DisplayUnit shown{column.unit, 1};
    if (!column.unit.empty())
      if (const Quantity one = parse_unit(column.unit); one.value == 1 && one.dimension != dimension::number)
        shown = display_unit(largest, one.dimension);
    lines[0].push_back(shown.name.empty() ? column.name : column.name + " [" + shown.name + "]");
    for (std::size_t row = 0; row < rows; ++row) {
      const Cell& cell = table.cell(row, k);
      lines[row + 1].push_back(is_empty(cell) ? ""
                               : std::holds_alternative<double>(cell) ||
                                       (is_number(cell) && !shown.name.empty())
                                   ? readable_number(in_unit(*number_in(cell), shown.name), digits)
                                   : short_text(cell));
    }
  }
  // Line ends would break columns.
  for (std::vector<std::string>& line : lines)
    for (std::string& cell : line)
      std::ranges::replace_if(
          cell, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  std::string text =
      table.name() + ": " + counted(table.rows(), "row") + " of " + counted(table.columns().size(), "column");
  std::vector<std::size_t> widths(table.columns().size());
  for (const std::vector<std::string>& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], characters_of(line[k]));
  for (const std::vector<std::string>& line : lines) {
    if (line.empty()) break;
    text += "\n ";
    for (std::size_t k = 0; k < line.size(); ++k)
      text += " " + std::string(widths[k] - characters_of(line[k]), ' ') + line[k];
  }
  if (rows < table.rows()) text += "\n  and " + std::to_string(table.rows() - rows) + " more";
  return plain_text(std::move(text));
}

std::vector<std::size_t> TableFilter::rows(const Table& table) const {
  std::vector<std::size_t> columns;
  std::vector<std::vector<Cell>> wanted;
  for (const Condition& condition : conditions_) {
    columns.push_back(table.column(condition.column, "where"));
    wanted.emplace_back();
    for (const Cell& accepted : condition.accepted)
      wanted.back().push_back(
          wanted_in_si(accepted, split_column_unit(condition.column).unit, table.columns()[columns.back()]));
  }
  std::vector<std::size_t> matching;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool matches = true;
    for (std::size_t k = 0; matches && k < columns.size(); ++k) {
      const Cell& cell = table.cell(row, columns[k]);
      matches =
          std::ranges::any_of(wanted[k], [&](const Cell& accepted) { return same_cell(cell, accepted); });
    }
    if (matches) matching.push_back(row);
  }
  return matching;
}

std::string TableFilter::text() const {
  std::string text;
  for (const Condition& condition : conditions_) {
    std::vector<std::string> values;
    for (const Cell& cell : condition.accepted) values.push_back(short_text(cell));
    if (!text.empty()) text += " and ";
    text += quoted(condition.column) + " = " + joined(values);
  }
  return text;
}

NumberColumns number_columns(const Table& table,
                             const std::vector<std::pair<std::string, std::string>>& named) {
  std::vector<std::size_t> places;
  for (const auto& [key, column] : named) places.push_back(table.column(column, key));
  NumberColumns found;
  found.values.resize(places.size());
  std::vector<double> row_values(places.size());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool whole = true;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Cell& cell = table.cell(row, places[k]);
      const auto number = number_in(cell);
      if (!number && !is_empty(cell))
        refuse("column " + quoted(table.columns()[places[k]].name) + " holds the text \"" +
                   short_text(cell).substr(0, 40) + "\" in row " + std::to_string(row + 1) +
                   ", and numbers are wanted",
               "leave such rows out with `where`, or write the numbers in a column of their own");
      whole = whole && number && std::isfinite(*number);
      row_values[k] = number.value_or(0);
    }
    if (!whole) {
      ++found.left_out;
      continue;
    }
    for (std::size_t k = 0; k < places.size(); ++k) found.values[k].push_back(row_values[k]);
    found.rows.push_back(row);
  }
  return found;
}

}  // namespace asperity
