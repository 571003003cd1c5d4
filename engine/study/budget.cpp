// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/budget.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/study/sensitivity.hpp"

namespace asperity {

// In budget_plan.cpp.
void add_costs(Budget& budget, double order, double solver_seconds);

namespace {

[[noreturn]] void refuse_request(const std::string& sentence, const std::string& hint) {
  throw Error(ErrorCode::bad_value, sentence, hint);
}

void check_ascent(const std::vector<double>& list, const char* key, bool ascending) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!std::isfinite(list[k]) || list[k] <= 0)
      refuse_request(quoted(key) + " holds " + format_short(list[k]), "give numbers above 0");
    if (k > 0 && (ascending ? list[k] <= list[k - 1] : list[k] >= list[k - 1]))
      refuse_request(quoted(key) + " goes from " + format_short(list[k - 1]) + " to " + format_short(list[k]),
                     ascending                        ? "give each grid once, coarse ones first"
                     : std::string_view(key) == "tip" ? "give each radius once, blunt ones first"
                                                      : "give each tolerance once, loose ones first");
  }
}

std::size_t runs_of_inputs(const BudgetRequest& request) {
  if (request.inputs.empty()) return 0;
  return request.runs > 0 ? request.runs : chaos_runs(request.inputs.size());
}

double median_seconds(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

// Asks, counts and forecasts.
class BudgetRuns {
 public:
  BudgetRuns(const BudgetRequest& request, const BudgetBatch& ask) : request_(request), ask_(ask) {
    for (const UncertainInput& input : request.inputs) nominal_.push_back(input.value);
    grids_ = std::max<std::size_t>(1, request.cells.size());
    replicates_ = std::max<std::size_t>(1, request.replicates);
    tightest_ = request.tolerances.empty() ? 0 : request.tolerances.size() - 1;
    sharpest_ = request.tips.empty() ? 0 : request.tips.size() - 1;
    total_ = budget_runs(request);
    seconds.resize(grids_);
    for (std::size_t c = 0; c < grids_; ++c)
      weight_ +=
          weight_of(c) * static_cast<double>(replicates_ + (c == 0 ? total_ - grids_ * replicates_ : 0));
  }

  // answers[c][r]: on grid c with replicate r.
  std::vector<std::vector<double>> replicates() {
    std::vector<std::vector<double>> answers(grids_);
    const auto take = [&](const std::vector<double>& values) {
      for (std::size_t k = 0; k < values.size(); ++k) answers[k % grids_].push_back(values[k]);
    };
    for (std::size_t c = 0; c < grids_; ++c) add_replicate(0, c);
    take(run());
    forecast();
    for (std::size_t r = 1; r < replicates_; ++r)
      for (std::size_t c = 0; c < grids_; ++c) add_replicate(r, c);
    take(run());
    return answers;
  }
  // More runs over the inputs than were counted at first.
  void expect(std::size_t more) {
    total_ += more;
    weight_ += weight_of(0) * static_cast<double>(more);
  }
  double loose() {
    add(nominal_, 0, 0, tightest_ - 1, "solver");
    return run().front();
  }
  double blunt() {
    add(nominal_, 0, 0, tightest_, "tip");
    asked_.back().tip = sharpest_ - 1;
    return run().front();
  }
  std::vector<double> noisy() {
    for (std::size_t k = 0; k < request_.noises; ++k) {
      add(nominal_, 0, 0, tightest_, "noise");
      asked_.back().noise = k;
    }
    return run();
  }
  std::vector<double> at(std::span<const std::vector<double>> inputs) {
    for (const std::vector<double>& values : inputs) add(values, 0, 0, tightest_, "inputs");
    return run();
  }

  std::size_t count = 0;
  double sum = 0;
  std::vector<std::vector<double>> seconds;  // of runs at the values of the inputs, grid by grid
  double loose_seconds = 0;

 private:
  double weight_of(std::size_t c) const {
    return request_.cells.empty() ? 1 : request_.cells[c] * request_.cells[c];
  }

  void add_replicate(std::size_t replicate, std::size_t cells) {
    add(nominal_, replicate, cells, tightest_,
        replicates_ > 1 ? "replicate " + std::to_string(replicate + 1) : "the value");
  }

  void add(const std::vector<double>& inputs, std::size_t replicate, std::size_t cells, std::size_t tolerance,
           std::string part) {
    BudgetSetting setting;
    setting.inputs = inputs;
    setting.replicate = replicate;
    setting.cells = cells;
    setting.tolerance = tolerance;
    setting.tip = sharpest_;
    setting.part = std::move(part);
    setting.number = ++count;
    setting.of = total_;
    setting.done_before = std::min(1.0, done_ / weight_);
    done_ += weight_of(cells);
    setting.done_after = std::min(1.0, done_ / weight_);
    asked_.push_back(std::move(setting));
  }

  // The answers of what was added.
  std::vector<double> run() {
    if (asked_.empty()) return {};
    const std::vector<BudgetSetting> settings = std::exchange(asked_, {});
    const std::vector<BudgetAnswer> answers = ask_(settings);
    std::vector<double> values;
    for (std::size_t k = 0; k < settings.size(); ++k) {
      const BudgetSetting& setting = settings[k];
      if (!std::isfinite(answers[k].value))
        throw Error(
            ErrorCode::bad_value,
            "the answer of run " + std::to_string(setting.number) + " (" + setting.part + ") is not finite",
            "a budget needs a finite number of every run");
      if (!has_square(answers[k].value))
        throw Error(ErrorCode::bad_value,
                    "the answer of run " + std::to_string(setting.number) + " (" + setting.part + ") is " +
                        format_short(answers[k].value) + ", whose square leaves the range of numbers",
                    "return it in another unit");
      sum += answers[k].seconds;
      if (setting.part == "solver")
        loose_seconds = answers[k].seconds;
      else if (setting.part != "inputs" && setting.part != "tip" && setting.part != "noise")
        seconds[setting.cells].push_back(answers[k].seconds);
      values.push_back(answers[k].value);
    }
    return values;
  }

  void forecast() const {
    if (!request_.at_most) return;
    double expected = seconds[0][0] * static_cast<double>(total_ - grids_ * replicates_);
    for (const auto& on_grid : seconds) expected += on_grid[0] * static_cast<double>(replicates_);
    expected /= std::max(1, request_.at_a_time);
    if (expected > *request_.at_most)
      throw Error(ErrorCode::infeasible,
                  "the " + std::to_string(total_) + " runs will take " + format_short(expected, 2) +
                      " s, above `at_most` of " + format_short(*request_.at_most) + " s",
                  "allow more, or give fewer replicates, inputs or `runs`, or coarser `cells`");
  }

  const BudgetRequest& request_;
  const BudgetBatch& ask_;
  std::vector<BudgetSetting> asked_;  // that are not answered yet
  std::vector<double> nominal_;
  std::size_t grids_ = 1, replicates_ = 1, tightest_ = 0, sharpest_ = 0, total_ = 0;
  double weight_ = 0, done_ = 0;
};

// What the error of the finest grid is, of the change to it from one r times coarser: 1/(r^p - 1), over all
// orders p that are possible.
struct Extrapolation {
  double ratio = 2, low = 1, high = 2;
  double at(double order) const { return 1 / (elementary::pow(ratio, order) - 1); }
  // Mean and standard deviation for p alike anywhere between the ends.
  std::pair<double, double> moments() const {
    if (high == low) return {at(low), 0};
    constexpr int steps = 200;
    double mean = 0, square = 0;
    for (int k = 0; k < steps; ++k) {
      const double factor = at(low + (high - low) * (k + 0.5) / steps);
      mean += factor / steps;
      square += factor * factor / steps;
    }
    return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
  }
};

// What one draw is made of.
struct BudgetFindings {
  std::vector<double> extrapolated;  // a replicate each
  double centre = 0;                 // of them: their mean, or that of Cox
  double change = 0;                 // to the finest grid, in the mean
  Extrapolation by;
  double factor_mean = 0, factor_spread = 0;
  Extrapolation by_tip;  // of the change from the blunter tip to the sharpest
  double tip_change = 0, tip_mean = 0, tip_spread = 0;
  double noise = 0;                // standard deviation over its draws
  double solver = 0;               // half the width in which the error of the solver lies
  std::vector<double> of_answers;  // where chaos is refused: answers less their mean
};

double average_of(const std::vector<double>& values) {
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  return mean;
}

// Student's t with `degrees` of freedom from two uniform numbers (Bailey 1994).
double student_draw(const Stream& stream, std::uint64_t k, double degrees) {
  const double u = 1 - stream.uniform(2 * k), v = stream.uniform(2 * k + 1);
  return std::sqrt(degrees * elementary::expm1(-2 / degrees * elementary::log(u))) *
         elementary::cos(2 * std::numbers::pi * v);
}

class BudgetDraws {
 public:
  BudgetDraws(const BudgetRequest& request, const BudgetFindings& found, const Budget& budget)
      : request_(request), found_(found), budget_(budget) {
    if (request.interval == MeanInterval::log_normal && budget.sample) {
      std::vector<double> logs;
      for (const double value : found.extrapolated) logs.push_back(elementary::log(value));
      const double n = static_cast<double>(logs.size());
      const double mean = average_of(logs);
      for (const double value : logs) log_variance_ += (value - mean) * (value - mean) / (n - 1);
      log_centre_ = mean + log_variance_ / 2;
      log_error_ = std::sqrt(log_variance_ / n + log_variance_ * log_variance_ / (2 * (n - 1)));
    }
    if (budget.chaos) {
      at_values_ = budget.chaos->at(std::vector<double>(request.inputs.size()));
      lack_ = std::sqrt(budget.chaos->leave_one_out * budget.chaos->variance);
    }
  }

  std::vector<double> all() const {
    std::vector<double> drawn;
    drawn.reserve(request_.draws);
    const Stream t(request_.seed, "budget sampling"), order(request_.seed, "budget order"),
        solver(request_.seed, "budget solver"), lack(request_.seed, "budget lack"),
        tip(request_.seed, "budget tip"), noise(request_.seed, "budget noise");
    std::vector<Stream> of_inputs;
    for (std::size_t j = 0; j < request_.inputs.size(); ++j)
      of_inputs.emplace_back(request_.seed, "budget input " + std::to_string(j));
    std::vector<double> point(request_.inputs.size());
    for (std::uint64_t k = 0; k < request_.draws; ++k) {
      double value = found_.centre;
      if (budget_.sample) value += sampling(t, k);
      if (found_.change != 0)
        value += found_.change *
                 (found_.by.at(order.uniform(k, found_.by.low, found_.by.high)) - found_.factor_mean);
      if (found_.tip_change != 0)
        value += found_.tip_change *
                 (found_.by_tip.at(tip.uniform(k, found_.by_tip.low, found_.by_tip.high)) - found_.tip_mean);
      if (found_.noise > 0)
        value += found_.noise * student_draw(noise, k, static_cast<double>(request_.noises - 1));
      if (found_.solver > 0) value += found_.solver * solver.uniform(k, -1, 1);
      if (!found_.of_answers.empty()) {
        value += found_.of_answers[static_cast<std::size_t>(lack.below(k, found_.of_answers.size()))];
      } else if (budget_.chaos) {
        for (std::size_t j = 0; j < point.size(); ++j)
          point[j] = request_.inputs[j].shape == InputShape::uniform ? of_inputs[j].uniform(k, -1, 1)
                                                                     : of_inputs[j].normal(k);
        value += budget_.chaos->at(point) - at_values_;
        if (lack_ > 0) value += lack_ * lack.normal(k);
      }
      drawn.push_back(value);
    }
    std::ranges::sort(drawn);
    return drawn;
  }

 private:
  // Of the mean of the replicates, from their centre.
  double sampling(const Stream& stream, std::uint64_t k) const {
    const double t = student_draw(stream, k, static_cast<double>(budget_.sample->count - 1));
    if (request_.interval == MeanInterval::log_normal)
      return elementary::exp(log_centre_ + t * log_error_) - found_.centre;
    return t * *budget_.sample->standard_error;
  }

  const BudgetRequest& request_;
  const BudgetFindings& found_;
  const Budget& budget_;
  double log_variance_ = 0, log_centre_ = 0, log_error_ = 0;
  double at_values_ = 0, lack_ = 0;
};

// The value below which lies the share p of sorted draws.
double draw_below(const std::vector<double>& sorted, double p) {
  const double place = p * static_cast<double>(sorted.size()) - 0.5;
  const double low = std::clamp(std::floor(place), 0.0, static_cast<double>(sorted.size() - 1));
  const auto k = static_cast<std::size_t>(low);
  const double part = std::clamp(place - low, 0.0, 1.0);
  return k + 1 < sorted.size() ? sorted[k] + part * (sorted[k + 1] - sorted[k]) : sorted[k];
}

void look_at_cells(const BudgetRequest& request, const std::vector<std::vector<double>>& answers,
                   BudgetFindings& found, Budget& budget) {
  const std::size_t last = answers.size() - 1;
  found.extrapolated = answers[last];
  if (last == 0) {
    budget.notes.push_back(request.cells.empty()
                               ? "cells: not estimated; give two or more `cells`"
                               : "cells: not estimated from one grid; give two or more `cells`");
    return;
  }
  found.by = {request.cells[last] / request.cells[last - 1], request.order_low, request.order_high};
  std::tie(found.factor_mean, found.factor_spread) = found.by.moments();
  std::vector<double> steps;
  for (std::size_t r = 0; r < answers[last].size(); ++r) {
    steps.push_back(answers[last][r] - answers[last - 1][r]);
    found.extrapolated[r] += found.factor_mean * steps[r];
  }
  found.change = average_of(steps);
  if (std::ranges::all_of(steps, [](double step) { return step == 0; }))
    budget.warnings.emplace_back(
        "the two finest grids give the same answer, to the last digit: does `ask` use its `cells`?");
  budget.notes.push_back(
      "cells: the value is corrected by " + format_short(found.factor_mean * found.change, 3) +
      " for an error of order " + format_short(request.order_low) +
      (request.order_high > request.order_low ? " to " + format_short(request.order_high) : std::string()));
  if (last < 2) return;
  const double before = average_of(answers[last - 1]) - average_of(answers[last - 2]);
  const double ratio = request.cells[last - 1] / request.cells[last - 2];
  if (!(found.change / before > 0)) {
    budget.warnings.push_back(
        "the three finest grids do not approach a value from one side: chance of the cells, or too few of "
        "them; the share of cells is a guess");
    return;
  }
  // For equal ratios the changes go as r^p; unequal ones are taken for their mean.
  budget.order_observed =
      elementary::log(before / found.change) / elementary::log(std::sqrt(ratio * found.by.ratio));
  if (*budget.order_observed < request.order_low - 0.5 || *budget.order_observed > request.order_high + 0.5)
    budget.warnings.push_back("the order observed over three grids is " +
                              format_short(*budget.order_observed, 2) + ", off `order` from " +
                              format_short(request.order_low) + " to " + format_short(request.order_high));
}

void look_at_sample(const BudgetRequest& request, BudgetFindings& found, Budget& budget) {
  found.centre = average_of(found.extrapolated);
  if (request.replicates == 0) {
    budget.notes.push_back("sampling: not estimated; give `replicate`");
    return;
  }
  budget.sample = sample_mean(found.extrapolated, request.interval, request.confidence);
  budget.warnings.insert(budget.warnings.end(), budget.sample->warnings.begin(),
                         budget.sample->warnings.end());
  if (std::ranges::all_of(found.extrapolated,
                          [&](double value) { return value == found.extrapolated.front(); }))
    budget.warnings.emplace_back(
        "all replicates give the same answer, to the last digit: does `ask` use what `replicate` names?");
  if (request.interval != MeanInterval::log_normal) return;
  std::vector<double> logs;
  for (const double value : found.extrapolated) logs.push_back(elementary::log(value));
  const double mean = average_of(logs);
  double variance = 0;
  for (const double value : logs)
    variance += (value - mean) * (value - mean) / static_cast<double>(logs.size() - 1);
  found.centre = elementary::exp(mean + variance / 2);
}

void look_at_solver(const BudgetRequest& request, const std::vector<std::vector<double>>& answers,
                    BudgetRuns& runs, BudgetFindings& found, Budget& budget) {
  if (request.tolerances.size() < 2) {
    budget.notes.emplace_back("solver: not estimated; give two or more values of `tolerance`");
    return;
  }
  const std::size_t last = request.tolerances.size() - 1;
  const double ratio = request.tolerances[last - 1] / request.tolerances[last];
  found.solver = std::abs(runs.loose() - answers[0][0]) / (ratio - 1);
}

// What a stylus and its noise do to the answer; nothing is said of a budget that has no instrument.
void look_at_instrument(const BudgetRequest& request, const std::vector<std::vector<double>>& answers,
                        BudgetRuns& runs, BudgetFindings& found, Budget& budget) {
  if (request.tips.size() > 1) {
    const std::size_t last = request.tips.size() - 1;
    found.by_tip = {request.tips[last - 1] / request.tips[last], 1, 2};
    std::tie(found.tip_mean, found.tip_spread) = found.by_tip.moments();
    found.tip_change = answers[0][0] - runs.blunt();
    budget.notes.push_back("tip: the value is corrected by " +
                           format_short(found.tip_mean * found.tip_change, 3) +
                           " for an error of order 1 to 2 of its radius");
  }
  if (request.noises == 0) return;
  const std::vector<double> noisy = runs.noisy();
  const double n = static_cast<double>(noisy.size()), shift = average_of(noisy) - answers[0][0];
  double squares = 0;
  for (const double value : noisy)
    squares += (value - answers[0][0] - shift) * (value - answers[0][0] - shift);
  found.noise = std::sqrt(squares / (n - 1));
  budget.notes.push_back("noise: n = " + std::to_string(noisy.size()) + ", moves the answer by " +
                         format_short(shift, 3) + " in the mean, which is not corrected");
  if (std::abs(shift) > 3 * found.noise)
    budget.warnings.push_back("noise moves the answer by " + format_short(shift, 3) +
                              ", far more than it scatters it: filter what is measured, or ask for what does "
                              "not hang on the shortest waves");
}

void look_at_inputs(const BudgetRequest& request, BudgetRuns& runs, BudgetFindings& found, Budget& budget) {
  if (request.inputs.empty()) {
    budget.notes.emplace_back("inputs: taken as exact");
    return;
  }
  // Doubled only where nobody has said how many runs or how long.
  ChaosRequest of_inputs{request.inputs, request.runs, request.seed};
  if (request.at_most) of_inputs.runs = runs_of_inputs(request);
  std::size_t asked = 0;
  ChaosOfRuns chaos = chaos_of_batches(
      of_inputs, [&](std::span<const std::vector<double>> points) { return runs.at(points); },
      [&](std::size_t more) {
        if (asked > 0) runs.expect(more);
        asked += more;
      });
  budget.chaos = std::move(chaos.chaos);
  const std::vector<double>& answers = chaos.answers;
  // What is rough is said once, as a warning.
  const bool good = budget.chaos->trust() == ChaosTrust::good;
  if (!(budget.chaos->variance > 0))
    budget.warnings.emplace_back("the answer does not hang on the inputs: does `ask` use them?");
  budget.notes.push_back("inputs: taken as independent, shares do not hold for correlated ones" +
                         (good ? "; " + budget.chaos->text() : std::string()));
  if (good) return;
  budget.warnings.push_back(budget.chaos->text());
  if (budget.chaos->trust() == ChaosTrust::rough) return;
  const double mean = average_of(answers);
  for (const double answer : answers) found.of_answers.push_back(answer - mean);
}

void add_part(Budget& budget, std::string name, double uncertainty, double share_error = 0) {
  BudgetPart part;
  part.name = std::move(name);
  part.uncertainty = uncertainty;
  part.share_error = share_error;
  budget.parts.push_back(std::move(part));
}

void add_parts(const BudgetRequest& request, const BudgetFindings& found, Budget& budget) {
  if (budget.sample) add_part(budget, "sampling", *budget.sample->standard_error);
  if (request.cells.size() > 1) add_part(budget, "cells", std::abs(found.change) * found.factor_spread);
  if (request.tolerances.size() > 1) add_part(budget, "solver", found.solver / std::sqrt(3.0));
  if (request.tips.size() > 1) add_part(budget, "tip", std::abs(found.tip_change) * found.tip_spread);
  if (request.noises > 0) add_part(budget, "noise", found.noise);
  double variance_of_inputs = 0;
  if (!found.of_answers.empty()) {
    for (const double value : found.of_answers)
      variance_of_inputs += value * value / static_cast<double>(found.of_answers.size());
    add_part(budget, "inputs", std::sqrt(variance_of_inputs));
  } else if (budget.chaos) {
    variance_of_inputs = budget.chaos->variance * (1 + budget.chaos->leave_one_out);
    double together = variance_of_inputs;
    for (const VarianceShare& share : budget.chaos->shares) {
      const double variance = share.first * budget.chaos->variance;
      together -= variance;
      add_part(budget, share.name, std::sqrt(variance), share.first_error);
    }
    if (request.inputs.size() > 1) add_part(budget, "inputs together", std::sqrt(std::max(0.0, together)));
  }
  double variance = 0;
  for (const BudgetPart& part : budget.parts) variance += part.uncertainty * part.uncertainty;
  budget.uncertainty = std::sqrt(variance);
  for (BudgetPart& part : budget.parts) {
    part.share = variance > 0 ? part.uncertainty * part.uncertainty / variance : 0;
    part.share_error *= variance > 0 ? variance_of_inputs / variance : 0;
  }
}

void add_interval(const BudgetRequest& request, BudgetFindings& found, Budget& budget) {
  const bool sample_alone = budget.sample && !budget.chaos && found.change == 0 && found.solver == 0 &&
                            found.tip_change == 0 && found.noise == 0;
  budget.value = found.centre;
  if (sample_alone) {
    budget.low = *budget.sample->low;
    budget.high = *budget.sample->high;
    return;
  }
  found.centre += found.tip_mean * found.tip_change;
  budget.value = found.centre;
  if (budget.chaos && found.of_answers.empty())
    budget.value += budget.chaos->mean - budget.chaos->at(std::vector<double>(request.inputs.size()));
  const std::vector<double> drawn = BudgetDraws(request, found, budget).all();
  budget.low = draw_below(drawn, (1 - request.confidence) / 2);
  budget.high = draw_below(drawn, (1 + request.confidence) / 2);
}

}  // namespace

void check_request(const BudgetRequest& request) {
  if (!request.inputs.empty()) check_inputs(request.inputs);
  if (request.replicates == 1)
    refuse_request("`replicate` has one value", "scatter takes two or more, better five");
  check_ascent(request.cells, "cells", true);
  check_ascent(request.tolerances, "tolerance", false);
  check_ascent(request.tips, "tip", false);
  if (request.noises == 1) refuse_request("`noise` has one draw", "scatter takes two or more, better five");
  if (!(request.order_low > 0) || !(request.order_high >= request.order_low) || !(request.order_high <= 10))
    refuse_request(
        "`order` goes from " + format_short(request.order_low) + " to " + format_short(request.order_high),
        "give the least and the greatest order of the error of the cells, above 0 and at most 10");
  if (!(request.confidence > 0 && request.confidence < 1))
    refuse_request("`confidence` is " + format_short(request.confidence), "give a number between 0 and 1");
  if (request.half_width && !(*request.half_width > 0 && std::isfinite(*request.half_width)))
    refuse_request("`half_width` is " + format_short(*request.half_width), "give a finite number above 0");
  if (request.draws < 100) refuse_request("there are fewer than 100 draws", "give more");
  if (request.inputs.empty() && request.replicates == 0 && request.cells.size() < 2 &&
      request.tolerances.size() < 2 && request.tips.size() < 2 && request.noises == 0)
    refuse_request("there is nothing to vary",
                   "give `inputs`, `replicate`, `noise`, or two or more `cells`, `tolerance` or `tip`");
}

std::size_t budget_runs(const BudgetRequest& request) {
  return std::max<std::size_t>(1, request.cells.size()) * std::max<std::size_t>(1, request.replicates) +
         (request.tolerances.size() > 1 ? 1 : 0) + (request.tips.size() > 1 ? 1 : 0) + request.noises +
         runs_of_inputs(request);
}

Budget budget_of(const BudgetRequest& request, const BudgetAsk& ask) {
  return budget_of_batches(request, [&ask](std::span<const BudgetSetting> settings) {
    std::vector<BudgetAnswer> answers;
    for (const BudgetSetting& setting : settings) answers.push_back(ask(setting));
    return answers;
  });
}

Budget budget_of_batches(const BudgetRequest& request, const BudgetBatch& ask) {
  check_request(request);
  Budget budget;
  budget.confidence = request.confidence;
  budget.replicates = request.replicates;
  budget.cells = request.cells;
  budget.tolerances = request.tolerances;
  budget.tips = request.tips;
  budget.asked = request.half_width;
  BudgetFindings found;
  BudgetRuns runs(request, ask);
  const auto answers = runs.replicates();
  look_at_cells(request, answers, found, budget);
  look_at_sample(request, found, budget);
  look_at_solver(request, answers, runs, found, budget);
  look_at_instrument(request, answers, runs, found, budget);
  look_at_inputs(request, runs, found, budget);
  add_parts(request, found, budget);
  add_interval(request, found, budget);
  budget.runs = runs.count;
  budget.seconds = runs.sum;
  for (const auto& on_grid : runs.seconds) budget.seconds_of_cells.push_back(median_seconds(on_grid));
  const double solver_seconds =
      request.tolerances.size() > 1 ? std::max(0.0, runs.seconds[0][0] - runs.loose_seconds) : 0;
  add_costs(budget, (request.order_low + request.order_high) / 2, solver_seconds);
  std::ranges::stable_sort(budget.parts,
                           [](const BudgetPart& a, const BudgetPart& b) { return a.share > b.share; });
  return budget;
}

}  // namespace asperity
