// SPDX-License-Identifier: GPL-3.0-or-later
// Row filter `where`: every named column must contain an accepted value (same_cell). Numbers are in SI, or in
// the unit of the condition's name; with a unit, "3 kN" is a number. An empty filter accepts all rows.
#pragma once

#include <string>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

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

}  // namespace asperity
