// SPDX-License-Identifier: GPL-3.0-or-later
// What a study of work and precision found: one row a setting, with its answer, its error against the
// truth, and the seconds that it took. Seconds are the median of the timed runs, with the fastest and
// the slowest of them beside it. A setting that failed and one that was left out keep their rows.
//
// An error may be small by accident: along a way the error can pass through zero, and the settings about
// that place look better than finer ones. So each row also has the greatest error among it and the
// finer settings of its way that were measured, its held error, and only that is compared with a bound.
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

// A number, or the knobs of a setting whose answer is taken for it.
using StudyTruth = std::variant<double, Knobs>;

struct StudyRequest {
  std::vector<StudyWay> ways;  // each with settings
  StudyTruth truth = 0.0;
  int repeats = 5;                // timed runs a setting, after a first one that is not
  std::optional<double> at_most;  // seconds for everything, the truth included
};

struct StudyRow {
  enum class End { measured, failed, left_out };
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::size_t way = 0;      // place among the ways
  std::size_t setting = 0;  // place in the way
  End end = End::left_out;
  std::string reason;  // why it failed or was left out; or what is to be known of a measured one

  double value = none;           // of the first run
  double absolute_error = none;  // |value - truth|
  double error = none;           // that over |truth|, or that itself where the truth is 0
  double held_error = none;      // greatest error among it and the finer ones
  int confirmed = 0;             // finer ones of its way that were measured
  bool steady = true;            // every run gave the same bits
  bool pareto = false;           // nothing measured is both faster and closer

  double seconds = none;        // median of the timed runs; of the first run where there is none
  double seconds_low = none;    // fastest
  double seconds_high = none;   // slowest
  double first_seconds = none;  // of the first run, which may have made plans and touched memory first
  std::optional<double> expected_seconds;  // of one run, of a setting that was left out
  std::vector<double> runs;                // the timed ones, in order
};

struct StudyResult {
  StudyRequest request;
  std::vector<StudyRow> rows;  // way by way, in the order of the request
  std::optional<double> truth;
  double truth_seconds = 0;  // 0 for a truth that was given
  std::int64_t calls = 0;    // of the studied function
  double asked_seconds = 0;  // inside the studied function
  double total_seconds = 0;
  bool complete = false;  // false: it was stopped on the way

  const StudyWay& way_of(const StudyRow& row) const { return request.ways[row.way]; }
  const Knobs& knobs_of(const StudyRow& row) const { return way_of(row).settings[row.setting]; }
  // "finer grid { cells=256 }".
  std::string name_of(const StudyRow& row) const;
  // Whether it is the setting that the truth comes from, or gave its very bits: such a row has no error.
  bool is_truth(const StudyRow& row) const;
  // Whether errors are relative to the truth; they are not where the truth is 0.
  bool relative() const { return !truth || *truth != 0; }
  // What the study itself took, over what it measured.
  double overhead() const;
};

// Fills in seconds, errors, held errors and the front from values, runs and the truth. Linear in the
// settings but for the front, which is quadratic.
void conclude(StudyResult& result);

// The row that holds the smallest error; null if none has one.
const StudyRow* best_held(const StudyResult& result);

// The row of the cheapest setting whose held error is at most `error`. Answers that are the same bits are of
// one way: of two such rows the one that is listed first stands for both, unless the other takes less than
// half its time. Throws Error{infeasible} that names the best that was reached, and an accidental crossing if
// there was one; Error{bad_value} for a bound that is not above zero.
const StudyRow& cheapest(const StudyResult& result, double error);

// The other rows that hold `error` and may be as fast as the row that `cheapest` gave: their range of seconds
// overlaps with its. In the order of the rows; none of whose answer an earlier row has.
std::vector<const StudyRow*> tied_with(const StudyResult& result, const StudyRow& chosen, double error);

}  // namespace asperity
