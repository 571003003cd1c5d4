// SPDX-License-Identifier: GPL-3.0-or-later
// Result of a work-precision study: answer, error and run time of each setting. An error can be small by
// accident, where it changes sign along a way. Only held errors are compared with bounds: the largest error
// of a setting and every finer measured setting of its way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/plot/chart.hpp"
#include "engine/statistics/table.hpp"
#include "engine/study/study_setting.hpp"

namespace asperity {

// A number, or the knobs of its setting.
using StudyTruth = std::variant<double, Knobs>;

struct StudyRequest {
  std::vector<StudyWay> ways;  // each with settings
  StudyTruth truth = 0.0;
  int repeats = 5;                // timed, per setting
  std::optional<double> at_most;  // seconds, including the truth
};

struct StudyRow {
  enum class End { measured, failed, left_out };
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::size_t way = 0;
  std::size_t setting = 0;
  End end = End::left_out;
  std::string reason;  // of failure or omission; remark

  double value = none;
  double absolute_error = none;  // |value - truth|
  double error = none;           // relative; absolute if the truth is 0
  double held_error = none;
  int confirmed = 0;    // finer settings with errors
  bool steady = true;   // the same bits always
  bool pareto = false;  // on the Pareto front

  double seconds = none;  // median, or the first run
  double seconds_low = none;
  double seconds_high = none;
  double first_seconds = none;             // may include set-up of caches
  std::optional<double> expected_seconds;  // per run left out
  std::vector<double> runs;                // timed, in order
};

struct StudyResult {
  StudyRequest request;
  std::vector<StudyRow> rows;  // by way
  std::optional<double> truth;
  double truth_seconds = 0;  // 0 for a given truth
  std::int64_t calls = 0;
  double asked_seconds = 0;  // inside the studied function
  double total_seconds = 0;
  bool complete = false;  // false after a stop

  const StudyWay& way_of(const StudyRow& row) const { return request.ways[row.way]; }
  const Knobs& knobs_of(const StudyRow& row) const { return way_of(row).settings[row.setting]; }
  std::string name_of(const StudyRow& row) const;
  // Such a row has no error.
  bool is_truth(const StudyRow& row) const;
  // Errors are absolute if the truth is 0.
  bool relative() const { return !truth || *truth != 0; }
  // Time outside the function over time inside.
  double overhead() const;
};

// Errors, median times and Pareto front. O(rows²).
void conclude(StudyResult& result);

// Smallest held error; null without errors.
const StudyRow* best_held(const StudyResult& result);

// Fastest row with held error ≤ `error`. Among identical answers the first counts, unless a later row takes
// less than half its time. Throws Error{infeasible}, naming the best held error and an accidentally small
// error; Error{bad_value} unless 0 < `error` < ∞.
const StudyRow& cheapest(const StudyResult& result, double error);

// Other rows within `error` with overlapping time ranges; without repeated answers.
std::vector<const StudyRow*> tied_with(const StudyResult& result, const StudyRow& chosen, double error);

// "1.2 %", "1234 %".
std::string share_text(double share);
// "1.2 %" (relative) or "1.2e-07".
std::string error_text(double error, bool relative);
// "12.3 ms", "4.2 s", "3 min 20 s", "2 h 5 min".
std::string seconds_text(double seconds);

// No final line end.
std::string study_text(const StudyResult& result);

// Columns: way, knobs, value, error and so on; SI.
Table study_table(const StudyResult& result);

Json to_json(const Knobs& knobs);
Json to_json(const StudyRequest& request);
// The result without times.
Json answers_json(const StudyResult& result);

// Error against run time, logarithmic, one line per way. Bars span fastest and slowest run; rings mark the
// Pareto front, crosses failed settings, triangles omitted settings at their expected time, diamonds answers
// identical to the truth.

// Throws Error{bad_value} without errors.
LineChart study_chart(const StudyResult& result, const std::string& title);

}  // namespace asperity
