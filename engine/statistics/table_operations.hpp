// SPDX-License-Identifier: GPL-3.0-or-later
// Filters, joins, columns and text of tables.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

Table rows_of(const Table& table, std::span<const std::size_t> rows);

// "2.8 um"; other cells as short_text().
std::string text_with_unit(const Cell& cell, const std::string& unit);

// Numbers in display units, each rounded once; a unit in one of `named` replaces the column's. For charts and
// messages: other table functions expect SI.
Table in_display_units(const Table& table, std::span<const std::string> named = {});

// For rows without partner.
enum class Unmatched { refuse, leave_out, keep };

struct Join {
  std::vector<std::string> by;
  std::string suffix{};  // for common names; "" refuses them
  Unmatched unmatched = Unmatched::refuse;
};

// Joins each row of `table` with each row of `other` equal in the columns `by` (same_cell, in one unit).
// Ignores rows of `other` without partner. Throws Error{unknown_name} for a missing column, Error{bad_unit}
// for different kinds of units, Error{bad_value} for a common name without suffix, for refused rows without
// partner, and if repeated rows meet repeated rows. O(n log n).
Table joined(const Table& table, const Table& other, const Join& join);

// All for an empty list; a unit in a name becomes the display unit. Throws as Table::column.
Table columns_of(const Table& table, std::span<const std::string> names);

// At most `most` rows, in display units; counts the others.
std::string table_text(const Table& table, std::size_t most = 20, int digits = 6);

// Row filter `where`: every named column must contain an accepted value (same_cell). Numbers are in SI, or in
// the unit of the condition's name; with a unit, "3 kN" is a number. An empty filter accepts all rows.
struct Condition {
  std::string column;
  std::vector<Cell> accepted;  // alternatives
};

class TableFilter {
 public:
  TableFilter() = default;
  explicit TableFilter(std::vector<Condition> conditions) : conditions_(std::move(conditions)) {}

  bool empty() const { return conditions_.empty(); }
  const std::vector<Condition>& conditions() const { return conditions_; }
  // In order. Throws Error{unknown_name} for a missing column, Error{bad_unit} for another kind of quantity.
  // O(rows × conditions × accepted values).
  std::vector<std::size_t> rows(const Table& table) const;
  // "`N` = 1 and `D` = 2 or 2.5"; "" for an empty filter.
  std::string text() const;

 private:
  std::vector<Condition> conditions_;
};

// The rows with finite numbers in all requested columns.
struct NumberColumns {
  std::vector<std::vector<double>> values;  // by column, equally long
  std::vector<std::size_t> rows;            // from 0
  std::size_t left_out = 0;
};

// `named`: key (for errors) and column. Throws Error{unknown_name} for a missing column, Error{bad_value}
// naming column, row and cell for text. O(rows × columns).
NumberColumns number_columns(const Table& table,
                             const std::vector<std::pair<std::string, std::string>>& named);

}  // namespace asperity
