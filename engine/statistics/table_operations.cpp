// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_operations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

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
  double factor = 1;
};

JoinColumn join_column(const Table& table, const Table& other, const std::string& name) {
  JoinColumn column{table.column(name, "by"), other.column(name, "by")};
  const std::string &here = table.columns()[column.here].unit, &there = other.columns()[column.there].unit;
  if (here == there) return column;
  const Quantity one = parse_unit(here), another = parse_unit(there);
  if (one.dimension != another.dimension)
    throw Error(ErrorCode::bad_unit,
                "column " + quoted(name) + " is " + describe(one.dimension) + " in " + table.name() +
                    " and " + describe(another.dimension) + " in " + other.name(),
                "rows are joined by equal values: give both columns the unit");
  column.factor = another.value / one.value;
  return column;
}

// Sort order: empty, numbers, NaN, booleans, texts.
int rank_of(const Cell& cell) {
  if (is_empty(cell)) return 0;
  if (is_number(cell)) return std::isnan(*number_in(cell)) ? 2 : 1;
  return std::holds_alternative<bool>(cell) ? 3 : 4;
}

bool before(const Cell& a, const Cell& b) {
  const int one = rank_of(a), another = rank_of(b);
  if (one != another) return one < another;
  if (one == 1 || one == 3) return *number_in(a) < *number_in(b);
  return one == 4 && std::get<std::string>(a) < std::get<std::string>(b);
}

class PartnerIndex {
 public:
  PartnerIndex(const Table& table, const Table& other, const std::vector<JoinColumn>& columns)
      : table_(table), columns_(columns), order_(other.rows()) {
    for (std::size_t row = 0; row < other.rows(); ++row) {
      std::vector<Cell> key;
      for (const JoinColumn& column : columns) {
        const Cell& cell = other.cell(row, column.there);
        key.push_back(column.factor != 1 && is_number(cell) ? Cell(*number_in(cell) * column.factor) : cell);
      }
      keys_.push_back(std::move(key));
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(
        order_, [&](std::size_t a, std::size_t b) { return before(keys_[a].front(), keys_[b].front()); });
  }

  std::vector<std::size_t> of(std::size_t row) const {
    const Cell& first = table_.cell(row, columns_.front().here);
    Cell from = first, to = first;
    if (rank_of(first) == 1) {
      const double x = *number_in(first), near = std::isfinite(x) ? 2e-12 * std::abs(x) : 0;
      from = x - near;
      to = x + near;
    }
    const auto key = [&](std::size_t k) -> const Cell& { return keys_[k].front(); };
    const auto begin = std::ranges::lower_bound(order_, from, before, key);
    const auto end = std::ranges::upper_bound(order_, to, before, key);
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
            short_text(table.cell(row, column.here)) + (named.unit.empty() ? "" : " " + named.unit);
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
    throw Error(
        ErrorCode::bad_value, "both tables have " + joined(both, " and ") + ", by which they are not joined",
        "tell the other's apart by a suffix of their names, as in { by=\"N\", suffix=\"_predicted\" }");
  return columns;
}

}  // namespace

Table rows_of(const Table& table, std::span<const std::size_t> rows) {
  std::vector<std::vector<Cell>> cells;
  cells.reserve(rows.size());
  for (const std::size_t row : rows) cells.push_back(cells_in(table, row));
  Table some(table.columns(), std::move(cells));
  some.rename(table.name());
  return some;
}

Table in_si(const Table& table) {
  std::vector<TableColumn> columns = table.columns();
  std::vector<std::vector<Cell>> rows(table.rows());
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = cells_in(table, row);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].unit.empty()) continue;
    const std::string unit = std::exchange(columns[k].unit, si_unit(parse_unit(columns[k].unit).dimension));
    for (std::vector<Cell>& row : rows) {
      if (!is_number(row[k])) continue;
      const double number = *number_in(row[k]);
      row[k] = unit == columns[k].unit || !std::isfinite(number)
                   ? number
                   : parse_quantity(format_exact(number) + " " + unit).value;
    }
  }
  Table converted(std::move(columns), std::move(rows));
  converted.rename(table.name());
  return converted;
}

Table joined(const Table& table, const Table& other, const Join& join) {
  if (join.by.empty())
    throw Error(ErrorCode::bad_value, "`by` names no column", "name one that both tables have: { by=\"N\" }");
  std::vector<JoinColumn> by;
  for (const std::string& name : join.by) by.push_back(join_column(table, other, name));
  std::vector<std::size_t> taken;
  for (std::size_t k = 0; k < other.columns().size(); ++k)
    if (std::ranges::none_of(by, [k](const JoinColumn& c) { return c.there == k; })) taken.push_back(k);
  std::vector<TableColumn> columns = joined_columns(table, other, join, taken);
  const PartnerIndex index(table, other, by);
  std::vector<std::vector<Cell>> rows;
  std::vector<std::size_t> owner(other.rows(), table.rows());  // row joined to each other row
  std::size_t alone = 0, first_alone = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::vector<std::size_t> partners = index.of(row);
    if (partners.empty() && alone++ == 0) first_alone = row;
    if (partners.empty() && join.unmatched == Unmatched::keep) rows.push_back(cells_in(table, row));
    for (const std::size_t partner : partners) {
      if (partners.size() > 1 && owner[partner] < table.rows())
        throw Error(ErrorCode::bad_value,
                    "rows with " + key_text(table, by, row) + " stand more than once in both tables",
                    "join by one more column that tells them apart, or take means of one of the two first");
      owner[partner] = row;
      std::vector<Cell> cells = cells_in(table, row);
      for (const std::size_t k : taken) cells.push_back(other.cell(partner, k));
      rows.push_back(std::move(cells));
    }
  }
  if (alone > 0 && join.unmatched == Unmatched::refuse)
    throw Error(ErrorCode::bad_value,
                (alone == 1 ? "1 row" : std::to_string(alone) + " rows") + " of " + table.name() +
                    " found none in " + other.name() + ", the first in row " +
                    std::to_string(first_alone + 1) + ": " + key_text(table, by, first_alone),
                "unmatched=\"leave out\" takes the other rows, unmatched=\"keep\" leaves their cells empty");
  Table both(std::move(columns), std::move(rows));
  both.rename(table.name());
  return both;
}

std::string table_text(const Table& table, std::size_t most) {
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
      const bool scaled = shown.factor != 1 && is_number(cell);
      lines[row + 1].push_back(is_empty(cell) ? ""
                               : scaled       ? format_short(*number_in(cell) / shown.factor)
                                              : short_text(cell));
    }
  }
  // Line ends would break columns.
  for (std::vector<std::string>& line : lines)
    for (std::string& cell : line)
      std::ranges::replace_if(
          cell, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  std::string text = table.name() + ": " + std::to_string(table.rows()) +
                     (table.rows() == 1 ? " row of " : " rows of ") + std::to_string(table.columns().size()) +
                     (table.columns().size() == 1 ? " column" : " columns");
  for (const std::vector<std::string>& line : lines) {
    text += "\n ";
    for (std::size_t k = 0; k < line.size(); ++k) {
      std::size_t width = 0;
      for (const std::vector<std::string>& other : lines) width = std::max(width, other[k].size());
      text += " " + std::string(width - line[k].size(), ' ') + line[k];
    }
  }
  if (rows < table.rows()) text += "\n  and " + std::to_string(table.rows() - rows) + " more";
  return plain_text(std::move(text));
}

}  // namespace asperity
