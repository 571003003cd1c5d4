// SPDX-License-Identifier: GPL-3.0-or-later
// An expectation about a notebook column. Every condition must hold in every row selected by `where` that has
// a value. A trend is strict and compares means over rows with equal values (same_cell) of the other column.
// `should_fail` marks a negative control, which passes if a condition fails. An expectation without rows,
// column or numbers, or a trend of one point, never passes.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity {

// In SI, in the unit of the column's name, or a quantity.
struct ExpectedValue {
  ExpectedValue(double number) : value(number) {}
  // Throws Error{bad_unit} as parse_quantity does.
  explicit ExpectedValue(std::string_view text);

  double value;          // later in the display unit
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
  bool judged = true;  // false: nothing to judge
  bool should_fail = false;
  std::string notebook;
  std::string label;
  std::string sentence;  // names the first offending rows
};

// Throws Error{bad_value} for no condition, `near` without exactly one of `within` and `rel`, these without
// `near`, a negative or nan bound, `at_least` above `at_most`, both trends in one column.
void check(const Expectation& expectation);

// Judges in display units; a unit in the column's name replaces them. Differences have a slack of a few
// digits. Throws as check() does, and Error{bad_unit} for a quantity of another dimension. Cost: rows ×
// conditions.
Verdict evaluate(const Expectation& expectation, const Table& table, std::string_view notebook);

// The verdicts of a run in order. Thread-safe.
Json to_json(const Verdict& verdict);

class ExpectationLog {
 public:
  void add(Verdict verdict);
  std::vector<Verdict> exchange(std::vector<Verdict> verdicts);
  std::vector<Verdict> verdicts() const;
  std::size_t failed() const;
  // "12 expectations hold (2 negative controls fail, as they should)", "3 of 12 expectations fail"; may be
  // "".
  std::string summary() const;

 private:
  mutable std::mutex mutex_;
  std::vector<Verdict> verdicts_;
};

}  // namespace asperity
