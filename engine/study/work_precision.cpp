// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/work_precision.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr std::array<std::string_view, 3> modelled = {"cells", "cells_factor", "tolerance"};

double model(std::string_view name, double value) {
  if (name == "cells") {
    const double n = std::max(value, 2.0);
    return n * n * elementary::log(n);
  }
  if (name == "cells_factor") return value * value;
  // Plus one for set-up.
  return 1 + std::max(0.0, -elementary::log10(std::max(value, 1e-300)));
}

bool is_modelled(std::string_view name) { return std::ranges::find(modelled, name) != modelled.end(); }

constexpr double look_every = 0.1;       // seconds between progress messages
constexpr double settling_share = 0.01;  // of run time
constexpr const char* title = "work and precision";

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void check(const StudyRequest& request) {
  require(request.repeats >= 1, "repeats", request.repeats, "", "give at least 1");
  if (const auto* value = std::get_if<double>(&request.truth); value != nullptr && !std::isfinite(*value))
    refuse("`truth` is " + format_short(*value),
           "give a finite number, or the knobs of a setting to be taken for it");
  std::set<std::string> names;
  std::size_t settings = 0;
  for (const StudyWay& way : request.ways) {
    settings += way.settings.size();
    if (!names.insert(way.name).second)
      refuse("two ways are called " + quoted(way.name), "give each a name of its own");
  }
  if (settings == 0)
    refuse("there is no setting to try",
           "give `try` at least one way, such as { name=\"finer grid\", cells={128, 256} }");
}

}  // namespace

void CostForecast::learn(std::size_t way, const Knobs& knobs, double seconds) {
  measured_.push_back({way, knobs, std::max(seconds, 0.0)});
}

double CostForecast::relative(const Knobs& knobs) {
  double cost = 1;
  for (const std::string_view name : modelled)
    if (const auto value = number_of(knobs, name)) cost *= model(name, *value);
  return cost;
}

double CostForecast::ratio(const Knobs& knobs, const Measured& reference) const {
  double factor = 1;
  for (const std::string_view name : modelled) {
    const auto wanted = number_of(knobs, name), had = number_of(reference.knobs, name);
    if (wanted && had) factor *= model(name, *wanted) / std::max(model(name, *had), 1e-300);
  }
  for (const Knob& knob : knobs) {
    if (is_modelled(knob.name)) continue;
    const auto wanted = number_of(knobs, knob.name), had = number_of(reference.knobs, knob.name);
    if (!wanted || !had || *wanted == *had || *wanted <= 0 || *had <= 0) continue;
    for (const Measured& other : measured_) {
      const auto before = number_of(other.knobs, knob.name);
      if (other.way != reference.way || !before || *before <= 0 || *before == *had) continue;
      if (relative(other.knobs) != relative(reference.knobs) || other.seconds <= 0) continue;
      constexpr double steepest = 4;
      const double power =
          std::clamp(elementary::log(reference.seconds / other.seconds) / elementary::log(*had / *before),
                     0.0, steepest);
      return factor * elementary::pow(*wanted / *had, power);
    }
  }
  return factor;
}

std::optional<double> CostForecast::seconds(std::optional<std::size_t> way, const Knobs& knobs) const {
  const Measured* best = nullptr;
  std::pair<int, double> best_rank{-1, 0};
  for (const Measured& one : measured_) {
    int shared = way && one.way == *way ? 1000 : 0;
    for (const Knob& knob : knobs)
      shared += std::ranges::any_of(one.knobs, [&](const Knob& own) { return own.name == knob.name; });
    // Most expensive: fixed costs matter least.
    const std::pair<int, double> rank{shared, one.seconds};
    if (rank > best_rank) {
      best = &one;
      best_rank = rank;
    }
  }
  if (best == nullptr) return {};
  return best->seconds * ratio(knobs, *best);
}

double WorkPrecision::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

WorkPrecision::WorkPrecision(StudyRequest request, StudyWork& work, Monitor& monitor, Clock clock)
    : work_(work), monitor_(monitor), clock_(std::move(clock)) {
  check(request);
  result_.request = std::move(request);
  if (const auto* value = std::get_if<double>(&result_.request.truth)) result_.truth = *value;
  for (std::size_t way = 0; way < result_.request.ways.size(); ++way)
    for (std::size_t k = 0; k < result_.request.ways[way].settings.size(); ++k) {
      StudyRow row;
      row.way = way;
      row.setting = k;
      row.reason = "not reached";
      result_.rows.push_back(std::move(row));
    }
  asked_.assign(result_.rows.size(), false);
}

void WorkPrecision::run() {
  begun_ = now_ = recorded_at_ = shown_at_ = clock_();
  wall_begun_ = PartMonitor::Clock::now();
  try {
    scout();
    monitor_.inform(quote_text());
    ask_truth();
    first_runs();
    rounds();
    result_.complete = true;
  } catch (const std::exception&) {
    finish();
    throw;
  }
  finish();
}

void WorkPrecision::finish() {
  conclude(result_);
  flush();
  result_.total_seconds = clock_() - begun_;
}

void WorkPrecision::flush() {
  if (unrecorded_.empty()) return;
  const std::vector<StudyRun> runs = std::exchange(unrecorded_, {});
  recorded_at_ = now_;
  work_.record(runs);
}

// --- one call

void WorkPrecision::show(const std::string& part, double expected) {
  const double total = elapsed() + quote().seconds;
  share_ = std::max(share_, total > 0 ? elapsed() / total : 0);
  share_after_ = total > 0 ? std::clamp((elapsed() + expected) / total, share_, 1.0) : share_;
  shown_at_ = now_;
  monitor_.progress_of_parts(title, share_, part, elapsed());
}

StudyAnswer WorkPrecision::call(const Knobs& knobs, const std::string* way, int round, double& seconds) {
  stop_flag().check();
  work_.prepare(knobs);
  std::string part = way == nullptr ? "the truth" : *way;
  if (now_ - shown_at_ >= look_every || result_.calls == 0) {
    part += " " + lua_source(knobs);
    if (round > 0)
      part += ", run " + std::to_string(round) + " of " + std::to_string(result_.request.repeats);
    show(part, seconds);
  } else {
    share_after_ = share_;
  }
  PartMonitor part_monitor(monitor_, title, std::move(part), share_, share_after_, wall_begun_);
  part_monitor.compute_afresh();
  const double begins = clock_();
  StudyAnswer answer = work_.ask(knobs, part_monitor);
  now_ = clock_();
  seconds = now_ - begins;
  result_.asked_seconds += seconds;
  ++result_.calls;
  if (answer.value && !std::isfinite(*answer.value)) {
    answer.failure = "the answer is " + format_short(*answer.value);
    answer.value.reset();
  }
  if (!answer.value && answer.failure.empty()) answer.failure = "no answer (nil)";
  unrecorded_.push_back({&knobs, way, round, answer.value, seconds});
  if (now_ - recorded_at_ >= look_every) flush();
  since_settled_ += seconds;
  if (settling_share * since_settled_ >= settling_) {
    work_.settle();
    const double settled = clock_();
    settling_ = settled - now_;
    now_ = settled;
    since_settled_ = 0;
  }
  return answer;
}

bool WorkPrecision::first_run(StudyRow& row) {
  double seconds = forecast(row).value_or(0);
  const StudyAnswer answer = call(result_.knobs_of(row), &result_.way_of(row).name, 0, seconds);
  asked_[static_cast<std::size_t>(&row - result_.rows.data())] = true;
  row.first_seconds = seconds;
  row.reason.clear();
  if (!answer.value) {
    row.end = StudyRow::End::failed;
    row.reason = answer.failure;
    return false;
  }
  row.end = StudyRow::End::measured;
  row.value = *answer.value;
  if (result_.is_truth(row)) row.reason = "the truth itself, so without an error";
  forecast_.learn(row.way, result_.knobs_of(row), seconds);
  return true;
}

// --- the budget

double WorkPrecision::left() const {
  return result_.request.at_most ? *result_.request.at_most - elapsed()
                                 : std::numeric_limits<double>::infinity();
}

// Outstanding timed runs.
double WorkPrecision::committed() const {
  double seconds = 0;
  for (const StudyRow& row : result_.rows)
    if (row.end == StudyRow::End::measured)
      seconds += row.first_seconds * std::max(0, result_.request.repeats - static_cast<int>(row.runs.size()));
  return seconds;
}

std::optional<double> WorkPrecision::forecast(const StudyRow& row) const {
  return forecast_.seconds(row.way, result_.knobs_of(row));
}

std::optional<double> WorkPrecision::truth_forecast() const {
  const auto* knobs = std::get_if<Knobs>(&result_.request.truth);
  if (knobs == nullptr || result_.truth) return 0.0;
  return forecast_.seconds({}, *knobs);
}

std::vector<StudyRow*> WorkPrecision::waiting() {
  std::vector<std::pair<double, StudyRow*>> found;
  for (std::size_t k = 0; k < result_.rows.size(); ++k)
    if (!asked_[k]) found.emplace_back(forecast(result_.rows[k]).value_or(0), &result_.rows[k]);
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<StudyRow*> rows;
  for (const auto& [seconds, row] : found) rows.push_back(row);
  return rows;
}

void WorkPrecision::leave_out(StudyRow& row, double expected, double needed) {
  asked_[static_cast<std::size_t>(&row - result_.rows.data())] = true;
  row.end = StudyRow::End::left_out;
  row.expected_seconds = expected;
  row.reason = "budget: about " + seconds_text(needed) + " needed, " +
               seconds_text(std::max(left() - committed(), 0.0)) + " left";
}

WorkPrecision::Quote WorkPrecision::quote() {
  Quote quote;
  quote.seconds = truth_forecast().value_or(0) + committed();
  for (const StudyRow* row : waiting()) {
    const double needed = (1 + result_.request.repeats) * forecast(*row).value_or(0);
    if (quote.seconds + needed > left())
      quote.left_out.push_back(row);
    else
      quote.seconds += needed;
  }
  return quote;
}

std::string WorkPrecision::quote_text() {
  const StudyRequest& request = result_.request;
  const Quote expected = quote();
  std::string text = std::string(title) + ": " +
                     counted(result_.rows.size() - expected.left_out.size(), "setting") + ", each timed " +
                     counted(static_cast<std::size_t>(request.repeats), "time") +
                     " after a first run: about " + seconds_text(elapsed() + expected.seconds);
  if (const auto* knobs = std::get_if<Knobs>(&request.truth)) {
    const auto truth = truth_forecast();
    text += "; the truth " + lua_source(*knobs) + " takes " +
            (truth ? "about " + seconds_text(*truth) : std::string("an unknown time"));
  }
  if (request.at_most) text += "; at most " + seconds_text(*request.at_most);
  if (!expected.left_out.empty()) {
    std::vector<std::string> names;
    for (const StudyRow* row : expected.left_out) names.push_back(result_.name_of(*row));
    text += ", which leaves out " + joined(names, " and ");
  }
  return text;
}

// --- the parts of the study

// Runs the cheapest setting of each way; after a failure, the next.
void WorkPrecision::scout() {
  for (std::size_t way = 0; way < result_.request.ways.size(); ++way) {
    std::vector<StudyRow*> rows;
    for (StudyRow& row : result_.rows)
      if (row.way == way) rows.push_back(&row);
    std::ranges::stable_sort(rows, [&](const StudyRow* a, const StudyRow* b) {
      return CostForecast::relative(result_.knobs_of(*a)) < CostForecast::relative(result_.knobs_of(*b));
    });
    for (StudyRow* row : rows) {
      const double expected = forecast(*row).value_or(0);
      const double needed = expected + committed() + truth_forecast().value_or(0);
      if (needed > left()) {
        leave_out(*row, expected, (1 + result_.request.repeats) * expected);
        continue;
      }
      if (first_run(*row)) break;
    }
  }
}

void WorkPrecision::ask_truth() {
  const auto* knobs = std::get_if<Knobs>(&result_.request.truth);
  if (knobs == nullptr) return;
  if (const double expected = truth_forecast().value_or(0); expected > left())
    refuse_infeasible("the truth " + lua_source(*knobs) + " would take about " + seconds_text(expected) +
                          ", and " + seconds_text(std::max(left(), 0.0)) + " are left of `at_most`",
                      "raise `at_most`, or give a cheaper or an exact truth");
  double seconds = truth_forecast().value_or(0);
  const StudyAnswer answer = call(*knobs, nullptr, 0, seconds);
  result_.truth_seconds = seconds;
  if (!answer.value)
    refuse_infeasible("the truth " + lua_source(*knobs) + " failed: " + answer.failure,
                      "give other knobs for it, or an exact value");
  result_.truth = *answer.value;
}

void WorkPrecision::first_runs() {
  // Each run improves the forecast.
  for (std::vector<StudyRow*> rows = waiting(); !rows.empty(); rows = waiting()) {
    StudyRow& row = *rows.front();
    const double expected = forecast(row).value_or(0);
    const double needed = (1 + result_.request.repeats) * expected;
    if (committed() + needed > left())
      leave_out(row, expected, needed);
    else
      first_run(row);
  }
}

void WorkPrecision::rounds() {
  for (int round = 1; round <= result_.request.repeats; ++round)
    for (StudyRow& row : result_.rows) {
      if (row.end != StudyRow::End::measured) continue;
      const double expected = row.runs.empty() ? row.first_seconds : row.runs.back();
      if (expected > left()) {
        row.reason = "budget: " + std::to_string(row.runs.size()) + " of " +
                     std::to_string(result_.request.repeats) + " runs";
        continue;
      }
      double seconds = expected;
      const StudyAnswer answer = call(result_.knobs_of(row), &result_.way_of(row).name, round, seconds);
      if (!answer.value) {
        row.end = StudyRow::End::failed;
        row.reason = "run " + std::to_string(round) + ": " + answer.failure;
        continue;
      }
      row.runs.push_back(seconds);
      if (row.steady && !same_bits(*answer.value, row.value)) {
        row.steady = false;
        row.reason = "run " + std::to_string(round) + " gave " + format_short(*answer.value, 17);
      }
    }
}

}  // namespace asperity
