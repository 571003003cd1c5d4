// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/study_result.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/study/study_text.hpp"

namespace asperity {

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

bool has_error(const StudyRow& row) { return row.end == StudyRow::End::measured && std::isfinite(row.error); }

std::vector<StudyRow*> rows_of_way(StudyResult& result, std::size_t way) {
  std::vector<StudyRow*> rows(result.request.ways[way].settings.size(), nullptr);
  for (StudyRow& row : result.rows)
    if (row.way == way) rows[row.setting] = &row;
  return rows;
}

}  // namespace

std::string StudyResult::name_of(const StudyRow& row) const {
  return way_of(row).name + " " + lua_source(knobs_of(row));
}

bool StudyResult::is_truth(const StudyRow& row) const {
  const auto* knobs = std::get_if<Knobs>(&request.truth);
  return knobs != nullptr && (*knobs == knobs_of(row) || (truth && row.value == *truth));
}

double StudyResult::overhead() const {
  return asked_seconds > 0 ? (total_seconds - asked_seconds) / asked_seconds : 0;
}

void conclude(StudyResult& result) {
  for (StudyRow& row : result.rows) {
    row.pareto = false;
    row.confirmed = 0;
    row.error = row.held_error = row.absolute_error = StudyRow::none;
    if (row.end != StudyRow::End::measured) continue;
    row.seconds = row.seconds_low = row.seconds_high = row.first_seconds;
    if (!row.runs.empty()) {
      row.seconds = median(row.runs);
      row.seconds_low = *std::min_element(row.runs.begin(), row.runs.end());
      row.seconds_high = *std::max_element(row.runs.begin(), row.runs.end());
    }
    if (!result.truth || result.is_truth(row)) continue;
    row.absolute_error = std::abs(row.value - *result.truth);
    row.error = result.relative() ? row.absolute_error / std::abs(*result.truth) : row.absolute_error;
  }
  for (std::size_t way = 0; way < result.request.ways.size(); ++way) {
    const std::vector<StudyRow*> rows = rows_of_way(result, way);
    const std::vector<std::size_t> order = coarse_to_fine(result.request.ways[way]);
    double greatest = 0;
    int finer = 0;
    for (auto place = order.rbegin(); place != order.rend(); ++place) {
      StudyRow* row = rows[*place];
      if (row == nullptr || !has_error(*row)) continue;
      greatest = std::max(greatest, row->error);
      row->held_error = greatest;
      row->confirmed = finer++;
    }
  }
  for (StudyRow& row : result.rows) {
    if (!has_error(row)) continue;
    row.pareto = std::none_of(result.rows.begin(), result.rows.end(), [&](const StudyRow& other) {
      return has_error(other) && other.seconds <= row.seconds && other.error <= row.error &&
             (other.seconds < row.seconds || other.error < row.error);
    });
  }
}

const StudyRow* best_held(const StudyResult& result) {
  const StudyRow* best = nullptr;
  for (const StudyRow& row : result.rows) {
    if (!has_error(row)) continue;
    // Among equal held errors, the row with this error itself.
    if (best == nullptr || row.held_error < best->held_error ||
        (row.held_error == best->held_error && row.error > best->error))
      best = &row;
  }
  return best;
}

namespace {

constexpr double much_faster = 0.5;

// Whether an earlier row has the same answer at a similar time.
bool stood_for(const StudyResult& result, const StudyRow& row, double error) {
  for (const StudyRow& other : result.rows) {
    if (&other == &row) return false;
    if (has_error(other) && other.held_error <= error && other.value == row.value &&
        row.seconds >= much_faster * other.seconds)
      return true;
  }
  return false;
}

}  // namespace

std::vector<const StudyRow*> tied_with(const StudyResult& result, const StudyRow& chosen, double error) {
  std::vector<const StudyRow*> tied;
  for (const StudyRow& row : result.rows)
    if (&row != &chosen && has_error(row) && row.held_error <= error && !stood_for(result, row, error) &&
        row.seconds_low <= chosen.seconds_high && chosen.seconds_low <= row.seconds_high)
      tied.push_back(&row);
  return tied;
}

const StudyRow& cheapest(const StudyResult& result, double error) {
  require(error > 0 && !std::isinf(error), "error", error, "", "give a number above 0");
  const StudyRow *found = nullptr, *accident = nullptr;
  for (const StudyRow& row : result.rows) {
    if (!has_error(row)) continue;
    if (row.held_error <= error) {
      if (stood_for(result, row, error)) continue;
      if (found == nullptr || row.seconds < found->seconds) found = &row;
    } else if (row.error <= error && accident == nullptr) {
      accident = &row;
    }
  }
  if (found != nullptr) return *found;
  std::string sentence = "no setting of the study holds an error of " + error_text(error, result.relative());
  const StudyRow* best = best_held(result);
  if (best == nullptr) throw Error(ErrorCode::infeasible, sentence, "none of them was measured");
  sentence += ": the best reached is " + error_text(best->held_error, result.relative()) + ", by " +
              result.name_of(*best);
  std::string hint = "add finer settings to a way, or ask for less";
  if (accident != nullptr)
    hint = result.name_of(*accident) + " is at " + error_text(accident->error, result.relative()) +
           ", but finer settings of its way are not, so that is an accident; " + hint;
  throw Error(ErrorCode::infeasible, sentence, hint);
}

}  // namespace asperity
