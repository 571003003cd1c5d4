// SPDX-License-Identifier: GPL-3.0-or-later
// What a script expects of a column of its notebook, and the verdict. Every condition given must hold
// in every row that `where` speaks of and that has a value in the column. A trend (`increasing_in`,
// `decreasing_in`) is strict, and is asked of means: rows that share the other column's value
// (same_cell) are averaged first, because a single seed proves nothing about a population.
// `should_fail` marks a negative control: it passes when the conditions are violated. What cannot be
// judged (no rows, a missing column, text, nan, a trend of one point) never passes, control or not.
// A plain number is counted in the column's own unit; a quantity ("10 MPa") is converted to it first.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/statistics/table.hpp"
#include "engine/statistics/table_filter.hpp"

namespace asperity {

// What a cell is compared with: a plain number, or a quantity as it was written.
struct ExpectedValue {
  ExpectedValue(double number) : value(number) {}
  // Throws Error{bad_unit} as parse_quantity does.
  explicit ExpectedValue(std::string_view text);

  double value;          // SI for a quantity, until it is counted in the unit of its column
  std::string quantity;  // "10 MPa"; "" for a plain number
};

struct Expectation {
  std::string column;
  TableFilter where;
  std::optional<ExpectedValue> near;      // with exactly one of the two below
  std::optional<ExpectedValue> within;    // |value - near| <= within
  std::optional<double> relative;         // |value - near| <= relative·|near|
  std::optional<ExpectedValue> at_least;  // value >= at_least
  std::optional<ExpectedValue> at_most;   // value <= at_most
  std::optional<std::string> increasing_in;
  std::optional<std::string> decreasing_in;
  bool should_fail = false;
  std::string label;  // shown before the sentence
};

struct Verdict {
  bool passed = false;
  bool judged = true;  // false when there was nothing to judge
  bool should_fail = false;
  std::string notebook;
  std::string label;
  std::string sentence;  // what was expected, what was found, the first offending rows
};

// Throws Error{bad_value} for an expectation that says nothing or contradicts itself: no condition,
// `near` without `within` or `rel` or with both, these without `near`, a negative or nan bound,
// `at_least` above `at_most`, both trends in one column.
void check(const Expectation& expectation);

// The expectation with its quantities counted in the unit of the column; as it is where the table has no
// such column. Throws Error{bad_unit} for a quantity of another kind than the column's unit, and for one
// with a unit where the column has none.
Expectation in_column_unit(const Expectation& expectation, const Table& table);

// After check(). Throws as in_column_unit does. Rows are numbered from 1 in sentences, as in the notebook;
// differences get the slack of a few last digits that their own subtraction needs. Cost: rows × conditions.
Verdict evaluate(const Expectation& expectation, const Table& table, std::string_view notebook);

}  // namespace asperity
