// SPDX-License-Identifier: GPL-3.0-or-later
// Result of a work-precision study: answer, error and run time of each setting. An error can be small by
// accident, where it changes sign along a way. The held error, the largest error of a setting and every finer
// measured setting of its way, excludes such accidents. Only held errors are compared with bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

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
  std::string reason;  // of a failure or omission; or a remark

  double value = none;
  double absolute_error = none;  // |value - truth|
  double error = none;           // absolute_error / |truth|; absolute if the truth is 0
  double held_error = none;
  int confirmed = 0;    // number of finer settings with errors
  bool steady = true;   // all runs gave the same bits
  bool pareto = false;  // nothing is both faster and more accurate

  double seconds = none;  // median of timed runs, or the first run
  double seconds_low = none;
  double seconds_high = none;
  double first_seconds = none;             // may include set-up of caches
  std::optional<double> expected_seconds;  // per run, if left out
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
  // Time outside the studied function over time inside.
  double overhead() const;
};

// Computes errors, median times and the Pareto front. O(rows²).
void conclude(StudyResult& result);

// Smallest held error; null without errors.
const StudyRow* best_held(const StudyResult& result);

// Fastest row with held error ≤ `error`. Among identical answers the first counts, unless a later row takes
// less than half its time. Throws Error{infeasible}, naming the best held error and an accidentally small
// error; Error{bad_value} unless 0 < `error` < ∞.
const StudyRow& cheapest(const StudyResult& result, double error);

// Other rows within `error` whose time ranges overlap with `chosen`; without repeated answers.
std::vector<const StudyRow*> tied_with(const StudyResult& result, const StudyRow& chosen, double error);

}  // namespace asperity
