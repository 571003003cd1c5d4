// SPDX-License-Identifier: GPL-3.0-or-later
// What a script expects of a column of its notebook, and the verdict. Every condition given must hold
// in every row that `where` speaks of and that has a value in the column. A trend (`increasing_in`,
// `decreasing_in`) is strict, and is asked of means: rows that share the other column's value
// (same_cell) are averaged first, because a single seed proves nothing about a population.
// `should_fail` marks a negative control: it passes when the conditions are violated. What cannot be
// judged (no rows, a missing column, text, nan, a trend of one point) never passes, control or not.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/experiment/table.hpp"
#include "engine/experiment/table_filter.hpp"

namespace asperity {

struct Expectation {
  std::string column;
  TableFilter where;
  std::optional<double> near;      // with exactly one of the two below
  std::optional<double> within;    // |value - near| <= within
  std::optional<double> relative;  // |value - near| <= relative·|near|
  std::optional<double> at_least;  // value >= at_least
  std::optional<double> at_most;   // value <= at_most
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

// After check(). Rows are numbered from 1 in sentences, as in the notebook; differences get the
// slack of a few last digits that their own subtraction needs. Cost: rows × conditions.
Verdict evaluate(const Expectation& expectation, const Table& table, std::string_view notebook);

}  // namespace asperity
