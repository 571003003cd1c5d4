// SPDX-License-Identifier: GPL-3.0-or-later
// An expectation about a notebook column. Every condition must hold in every row selected by `where` that has
// a value. A trend is strict and compares means over rows with the same value (same_cell) of the other
// column: a single seed proves nothing about a population. `should_fail` marks a negative control, which
// passes if a condition fails. An expectation that cannot be judged (no rows, missing column, text, nan,
// trend of one point) never passes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/statistics/table.hpp"
#include "engine/statistics/table_filter.hpp"

namespace asperity {

// A number in the column's unit, or a quantity.
struct ExpectedValue {
  ExpectedValue(double number) : value(number) {}
  // Throws Error{bad_unit} as parse_quantity does.
  explicit ExpectedValue(std::string_view text);

  double value;          // SI for a quantity, later in the column's unit
  std::string quantity;  // "10 MPa", or ""
};

struct Expectation {
  std::string column;
  TableFilter where;
  std::optional<ExpectedValue> near;      // with `within` or `relative`
  std::optional<ExpectedValue> within;    // |value - near| <= within
  std::optional<double> relative;         // |value - near| <= relative·|near|
  std::optional<ExpectedValue> at_least;  // value >= at_least
  std::optional<ExpectedValue> at_most;   // value <= at_most
  std::optional<std::string> increasing_in;
  std::optional<std::string> decreasing_in;
  bool should_fail = false;
  std::string label;
};

struct Verdict {
  bool passed = false;
  bool judged = true;  // false if there was nothing to judge
  bool should_fail = false;
  std::string notebook;
  std::string label;
  std::string sentence;  // with the first offending rows
};

// Throws Error{bad_value} for no condition, `near` without exactly one of `within` and `rel`, these without
// `near`, a negative or nan bound, `at_least` above `at_most`, both trends in one column.
void check(const Expectation& expectation);

// Quantities in the column's unit, if the table has the column. Throws Error{bad_unit} for another dimension,
// and for a quantity with a unit if the column has none.
Expectation in_column_unit(const Expectation& expectation, const Table& table);

// Throws as check() and in_column_unit() do. Differences have a slack of a few digits. Cost: rows ×
// conditions.
Verdict evaluate(const Expectation& expectation, const Table& table, std::string_view notebook);

}  // namespace asperity
