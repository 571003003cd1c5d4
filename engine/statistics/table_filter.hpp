// SPDX-License-Identifier: GPL-3.0-or-later
// Which rows of a table a `where` speaks of: those in which every named column holds one of the
// accepted values (same_cell). In a column with a unit a text such as "3 kN" stands for a number counted in
// it. An empty filter takes every row.
#pragma once

#include <string>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

struct Condition {
  std::string column;
  std::vector<Cell> accepted;  // any value in this list
};

class TableFilter {
 public:
  TableFilter() = default;
  explicit TableFilter(std::vector<Condition> conditions) : conditions_(std::move(conditions)) {}

  bool empty() const { return conditions_.empty(); }
  const std::vector<Condition>& conditions() const { return conditions_; }
  // Matching rows in order. Throws Error{unknown_name} naming `where` for a column the table lacks,
  // with the nearest, and Error{bad_unit} for a quantity of another kind than the column's. Cost: rows ×
  // conditions × accepted values.
  std::vector<std::size_t> rows(const Table& table) const;
  // "`N` = 1 and `D` = 2 or 2.5"; "" for an empty filter.
  std::string text() const;

 private:
  std::vector<Condition> conditions_;
};

}  // namespace asperity
