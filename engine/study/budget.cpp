// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/budget.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/statistics/least_squares.hpp"
#include "engine/study/budget_draws.hpp"
#include "engine/study/sensitivity.hpp"

namespace asperity {

// In budget_plan.cpp.
void add_costs(Budget& budget, double order, double solver_seconds);

namespace {

std::size_t runs_of_inputs(const BudgetRequest& request) {
  if (request.inputs.empty()) return 0;
  return request.runs > 0 ? request.runs : chaos_runs(request.inputs.size());
}

class BudgetRuns {
 public:
  BudgetRuns(const BudgetRequest& request, const BudgetBatch& ask)
      : request_(request),
        ask_(ask),
        cells_(budget_grids(request)),
        grids_(std::max<std::size_t>(1, request.cells.size())),
        replicates_(std::max<std::size_t>(1, request.replicates)),
        total_(budget_runs(request)) {
    for (const UncertainInput& input : request.inputs) base_.inputs.push_back(input.value);
    if (!request.tolerances.empty()) base_.tolerance = request.tolerances.size() - 1;
    if (!request.tips.empty()) base_.tip = request.tips.size() - 1;
    seconds.resize(grids_);
    weight_ = weight_of(0) * static_cast<double>(total_ - grids_ * replicates_);
    for (std::size_t c = 0; c < grids_; ++c) weight_ += weight_of(c) * static_cast<double>(replicates_);
  }

  // First replicate, coarsest grid, tightest tolerance and finest tip.
  BudgetSetting base(std::string part) const {
    BudgetSetting setting = base_;
    setting.part = std::move(part);
    return setting;
  }

  std::vector<double> run(std::vector<BudgetSetting> settings, bool some_may_be_lost = false) {
    if (settings.empty()) return {};
    for (BudgetSetting& setting : settings) {
      setting.number = ++count;
      setting.of = total_;
      setting.done_before = std::min(1.0, done_ / weight_);
      setting.done_after = std::min(1.0, (done_ += weight_of(setting.cells)) / weight_);
    }
    const std::vector<BudgetAnswer> answers = ask_(settings);
    std::vector<double> values;
    for (std::size_t k = 0; k < settings.size(); ++k) {
      const BudgetSetting& of = settings[k];
      const std::string run = "the answer of run " + std::to_string(of.number) + " (" + of.part + ") is ";
      if (!std::isfinite(answers[k].value)) {
        if (!lost)
          lost =
              Error(ErrorCode::bad_value, run + "not finite", "a budget needs a finite number of every run");
        if (!some_may_be_lost) throw *lost;
      } else if (!has_square(answers[k].value)) {
        refuse(run + format_short(answers[k].value) + ", whose square leaves the range of numbers",
               "return it in another unit");
      }
      sum += answers[k].seconds;
      if (of.part == "solver")
        loose_seconds = answers[k].seconds;
      else if (of.inputs == base_.inputs && of.tip == base_.tip && !of.noise && of.cells < grids_)
        seconds[of.cells].push_back(answers[k].seconds);
      values.push_back(answers[k].value);
    }
    return values;
  }

  // answers[c][r]: grid c, replicate r.
  std::vector<std::vector<double>> replicates() {
    std::vector<std::vector<double>> answers(grids_);
    for (const auto& [from, to] :
         {std::pair(std::size_t{0}, std::size_t{1}), std::pair(std::size_t{1}, replicates_)}) {
      std::vector<BudgetSetting> settings;
      for (std::size_t r = from; r < to; ++r)
        for (std::size_t c = 0; c < grids_; ++c) {
          settings.push_back(base(replicates_ > 1 ? "replicate " + std::to_string(r + 1) : "the value"));
          settings.back().replicate = r;
          settings.back().cells = c;
        }
      const std::vector<double> values = run(std::move(settings), from > 0);
      for (std::size_t k = 0; k < values.size(); ++k) answers[k % grids_].push_back(values[k]);
      if (from == 0) forecast();
    }
    return answers;
  }
  // Empty if `ask` refuses a grid.
  std::vector<double> between() {
    std::vector<BudgetSetting> settings(cells_.size() - grids_, base("grids between"));
    for (std::size_t k = 0; k < settings.size(); ++k) settings[k].cells = grids_ + k;
    try {
      return run(std::move(settings));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::bad_value) throw;
      return {};
    }
  }
  void expect(std::size_t more) {
    total_ += more;
    weight_ += weight_of(0) * static_cast<double>(more);
  }

  std::size_t count = 0;
  double sum = 0;
  std::vector<std::vector<double>> seconds;  // by grid, for the nominal inputs
  double loose_seconds = 0;
  std::optional<Error> lost;

 private:
  double weight_of(std::size_t c) const { return cells_.empty() ? 1 : cells_[c] * cells_[c]; }

  void forecast() const {
    if (!request_.at_most) return;
    double expected = seconds[0][0] * static_cast<double>(total_ - grids_ * replicates_);
    for (const auto& on_grid : seconds) expected += on_grid[0] * static_cast<double>(replicates_);
    for (std::size_t c = grids_; c < cells_.size(); ++c) expected += seconds.back()[0];
    expected /= std::max(1, request_.at_a_time);
    if (expected > *request_.at_most)
      refuse_infeasible("the " + std::to_string(total_) + " runs will take " + format_short(expected, 2) +
                            " s, above `at_most` of " + format_short(*request_.at_most) + " s",
                        "allow more, or give fewer replicates, inputs or `runs`, or coarser `cells`");
  }

  const BudgetRequest& request_;
  const BudgetBatch& ask_;
  const std::vector<double> cells_;
  const std::size_t grids_, replicates_;
  std::size_t total_;
  BudgetSetting base_;
  double weight_ = 0, done_ = 0;
};

// Averages repeats of specimens; drops replicates that are not finite.
void take_specimens(const BudgetRequest& request, const BudgetRuns& runs,
                    std::vector<std::vector<double>>& answers, Budget& budget) {
  std::map<std::size_t, std::vector<std::size_t>> repeats;
  std::vector<std::string> lost;
  const std::size_t all = answers.front().size();
  for (std::size_t r = 0; r < all; ++r)
    if (std::ranges::all_of(answers, [r](const auto& on_grid) { return std::isfinite(on_grid[r]); }))
      repeats[request.specimens.empty() ? r : request.specimens[r]].push_back(r);
    else
      lost.push_back(std::to_string(r + 1));
  if (4 * lost.size() > all) throw *runs.lost;
  if (!lost.empty())
    budget.warnings.push_back("of " + std::to_string(all) + " replicates, " + joined(lost, " and ") +
                              " gave no finite number: the mean is that of the others");
  for (auto& on_grid : answers) {
    std::vector<double> means;
    for (const auto& [specimen, of] : repeats) {
      means.push_back(0);
      for (const std::size_t r : of) means.back() += on_grid[r] / static_cast<double>(of.size());
    }
    on_grid = std::move(means);
  }
  budget.repeats = static_cast<double>(all - lost.size()) / static_cast<double>(repeats.size());
  if (request.replicates == 0) return;
  budget.replicates = repeats.size();
  if (repeats.size() < 2) refuse("`replicate` has one specimen", "scatter takes two or more, better five");
}

// Drift of this order, fitted with scatter proportional to cell width: value at width 0 relative to the
// finest grid, standard error.
std::pair<double, double> drift_of(const std::vector<double>& widths, const std::vector<double>& steps,
                                   double order) {
  TableColumns columns(2);
  std::vector<double> weighted;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    columns[0].push_back(1 / widths[k]);
    columns[1].push_back(elementary::pow(widths[k], order - 1));
    weighted.push_back(steps[k] / widths[k]);
  }
  const LinearLeastSquares fit = linear_least_squares(columns, weighted);
  double squares = 0, influence = 0;
  for (const double residual : fit.residuals) squares += residual * residual;
  for (const std::vector<double>& of : fit.influence) influence += of[0] * of[0];
  return {fit.coefficients[0], std::sqrt(squares * influence / static_cast<double>(widths.size() - 2))};
}

constexpr int order_steps = 200;
template <class At>
std::vector<double> over_orders(double low, double high, At at) {
  std::vector<double> found;
  for (int k = 0; k < (high > low ? order_steps : 1); ++k)
    found.push_back(at(low + (high - low) * (k + 0.5) / order_steps));
  return found;
}

// Richardson's correction of the finer answer, for all orders.
std::vector<double> extrapolations(double change, double ratio, double low, double high) {
  return over_orders(low, high, [&](double order) { return change / (elementary::pow(ratio, order) - 1); });
}

// Discretisation error of a single specimen.
void look_at_chance(const BudgetRequest& request, const std::vector<std::vector<double>>& answers,
                    const std::vector<double>& between, BudgetTerm& term, Budget& budget) {
  // In standard errors: drifts of order 1 to 2 exceed this, scatter of rough faces hardly ever.
  constexpr double clear = 15;
  const std::vector<double> grids = budget_grids(request);
  const std::size_t last = answers.size() - 1;
  std::vector<double> widths{1}, steps{0};
  std::vector<std::string> others;
  double squares = 0;
  for (std::size_t c = 0; c <= last + between.size(); ++c) {
    if (c == last) continue;
    widths.push_back(grids[last] / grids[c]);
    steps.push_back((c < last ? answers[c].front() : between[c - last - 1]) - answers[last].front());
    squares += steps.back() * steps.back() / (1 + widths.back() * widths.back());
    others.push_back(format_short(grids[c]));
  }
  const std::size_t count = others.size();
  const std::string names = joined(others, " and ");
  term.scale = std::sqrt(squares / static_cast<double>(count));
  term.degrees = count == 1 ? 1 : std::max(2.0, static_cast<double>(count - 1));
  if (count == 1) {
    budget.warnings.emplace_back(
        "cells: one change may be small by chance, and the interval is wide for it; give three `cells`");
  } else {
    const auto [off, error] = drift_of(widths, steps, (request.order_low + request.order_high) / 2);
    if (std::abs(off) > clear * error) {
      term.scale = error;
      term.list = over_orders(request.order_low, request.order_high,
                              [&](double order) { return drift_of(widths, steps, order).first; });
      budget.notes.push_back("cells: the value is corrected by " + format_short(average_of(term.list), 3) +
                             " for the drift through " + names + " and " + format_short(grids[last]));
      return;
    }
  }
  budget.notes.push_back("cells: the value is that on " + format_short(grids[last]) +
                         "; its error is as great as the scatter of " + names + " about it");
}

void look_at_cells(const BudgetRequest& request, std::vector<std::vector<double>>& answers, BudgetRuns& runs,
                   BudgetFindings& found, Budget& budget) {
  const std::size_t last = answers.size() - 1;
  if (last == 0) {
    budget.notes.push_back(request.cells.empty()
                               ? "cells: not estimated; give two or more `cells`"
                               : "cells: not estimated from one grid; give two or more `cells`");
    return;
  }
  const double ratio = request.cells[last] / request.cells[last - 1];
  std::vector<double> steps;
  for (std::size_t r = 0; r < answers[last].size(); ++r)
    steps.push_back(answers[last][r] - answers[last - 1][r]);
  const double change = average_of(steps);
  if (std::ranges::all_of(steps, [](double step) { return step == 0; }))
    budget.warnings.emplace_back(
        "the two finest grids give the same answer, to the last digit: does `ask` use its `cells`?");
  if (last > 1) {
    const double before = average_of(answers[last - 1]) - average_of(answers[last - 2]);
    // The observed order is exact for equal ratios; otherwise the mean ratio is used.
    if (change / before > 0)
      budget.order_observed =
          elementary::log(before / change) /
          elementary::log(std::sqrt(ratio * request.cells[last - 1] / request.cells[last - 2]));
    if (!budget.order_observed)
      budget.warnings.emplace_back(
          "the three finest grids do not approach a value from one side: give more or finer `cells`");
    else if (*budget.order_observed < request.order_low - 0.5 ||
             *budget.order_observed > request.order_high + 0.5)
      budget.warnings.push_back("the order observed over three grids is " +
                                format_short(*budget.order_observed, 2) + ", off `order` from " +
                                format_short(request.order_low) + " to " + format_short(request.order_high));
  }
  BudgetTerm& term = found.terms.emplace_back();
  term.name = "cells";
  if (request.replicates == 0) return look_at_chance(request, answers, runs.between(), term, budget);
  term.list = extrapolations(1, ratio, request.order_low, request.order_high);
  const double factor = average_of(term.list), count = static_cast<double>(steps.size());
  term.degrees = count - 1;
  term.scale = term.uncertainty() * deviation_of(steps, term.degrees) / std::sqrt(count);
  for (std::size_t r = 0; r < steps.size(); ++r) answers[last][r] += factor * steps[r];
  for (double& value : term.list) value = change * (value - factor);
  budget.notes.push_back(
      "cells: the value is corrected by " + format_short(factor * change, 3) + " for an error of order " +
      format_short(request.order_low) +
      (request.order_high > request.order_low ? " to " + format_short(request.order_high) : std::string()));
}

void look_at_sample(const BudgetRequest& request, const std::vector<double>& values, BudgetFindings& found,
                    Budget& budget) {
  found.centre = average_of(values);
  if (request.replicates == 0) {
    budget.notes.push_back("sampling: not estimated; give `replicate`");
    return;
  }
  budget.sample = sample_mean(values, request.interval, request.confidence);
  budget.warnings.insert(budget.warnings.end(), budget.sample->warnings.begin(),
                         budget.sample->warnings.end());
  if (std::ranges::all_of(values, [&](double value) { return value == values.front(); }))
    budget.warnings.emplace_back(
        "all replicates give the same answer, to the last digit: does `ask` use what `replicate` names?");
  found.terms.push_back(
      {"sampling", {}, *budget.sample->standard_error, static_cast<double>(budget.sample->count - 1)});
  if (request.interval == MeanInterval::log_normal) found.centre = elementary::exp(budget.sample->log_centre);
}

void look_at_solver(const BudgetRequest& request, BudgetRuns& runs, BudgetFindings& found, Budget& budget) {
  if (request.tolerances.size() < 2) {
    budget.notes.emplace_back("solver: not estimated; give two or more values of `tolerance`");
    return;
  }
  const std::size_t last = request.tolerances.size() - 1;
  const double ratio = request.tolerances[last - 1] / request.tolerances[last];
  BudgetSetting loose = runs.base("solver");
  --loose.tolerance;
  const double half = (runs.run({loose}).front() - found.first) / (ratio - 1) /
                      std::sqrt(1 - 1.0 / (order_steps * order_steps));
  found.terms.push_back({"solver", over_orders(-1, 1, [&](double share) { return share * half; })});
}

void look_at_instrument(const BudgetRequest& request, BudgetRuns& runs, BudgetFindings& found,
                        Budget& budget) {
  if (request.tips.size() > 1) {
    const std::size_t last = request.tips.size() - 1;
    const double ratio = request.tips[last - 1] / request.tips[last];
    BudgetSetting blunt = runs.base("tip");
    --blunt.tip;
    found.terms.push_back({"tip", extrapolations(found.first - runs.run({blunt}).front(), ratio, 1, 2)});
    budget.notes.push_back("tip: the value is corrected by " +
                           format_short(average_of(found.terms.back().list), 3) +
                           " for an error of order 1 to 2 of its radius");
  }
  if (request.noises == 0) return;
  std::vector<BudgetSetting> draws(request.noises, runs.base("noise"));
  for (std::size_t k = 0; k < draws.size(); ++k) draws[k].noise = k;
  const std::vector<double> noisy = runs.run(std::move(draws));
  const double shift = average_of(noisy) - found.first, degrees = static_cast<double>(noisy.size() - 1);
  const double noise = deviation_of(noisy, degrees);
  found.terms.push_back({"noise", {}, noise, degrees});
  budget.notes.push_back("noise: n = " + std::to_string(noisy.size()) + ", moves the answer by " +
                         format_short(shift, 3) + " in the mean, without a correction");
  if (std::abs(shift) > 3 * noise)
    budget.warnings.push_back(
        "noise moves the answer by " + format_short(shift, 3) +
        ", far more than its scatter: filter the measurement, or request a quantity of longer waves");
}

void look_at_inputs(const BudgetRequest& request, BudgetRuns& runs, BudgetFindings& found, Budget& budget) {
  if (request.inputs.empty()) {
    budget.notes.emplace_back("inputs: taken as exact");
    return;
  }
  // Runs double only without `runs` and `at_most`.
  ChaosRequest of_inputs{request.inputs, request.runs, request.seed};
  if (request.at_most) of_inputs.runs = runs_of_inputs(request);
  // Student's t extrapolates far beyond the points.
  if (std::ranges::any_of(request.inputs, [](const auto& of) { return of.degrees < 30; }))
    of_inputs.highest = 3;
  std::size_t asked = 0;
  ChaosOfRuns chaos = chaos_of_batches(
      of_inputs,
      [&](std::span<const std::vector<double>> points) {
        std::vector<BudgetSetting> settings(points.size(), runs.base("inputs"));
        for (std::size_t k = 0; k < points.size(); ++k) settings[k].inputs = points[k];
        return runs.run(std::move(settings));
      },
      [&](std::size_t more) {
        if (asked > 0) runs.expect(more);
        asked += more;
      });
  budget.chaos = std::move(chaos.chaos);
  const ChaosTrust trust = budget.chaos->trust();
  if (!(budget.chaos->variance > 0))
    budget.warnings.emplace_back("the answer does not depend on the inputs: does `ask` use them?");
  budget.notes.push_back(
      (request.correlations.empty() ? "inputs: taken as independent" : "inputs: correlated") +
      (trust == ChaosTrust::good ? "; " + budget.chaos->text() : std::string()));
  if (trust != ChaosTrust::good) budget.warnings.push_back(budget.chaos->text());
  if (trust != ChaosTrust::refused) return;
  for (double& answer : chaos.answers) answer -= found.first;
  found.terms.push_back({"inputs", std::move(chaos.answers)});
}

BudgetPart& add_part(Budget& budget, std::string name, double uncertainty, double degrees) {
  return budget.parts.emplace_back(BudgetPart{std::move(name), uncertainty, degrees});
}

// Rows: each input, correlations, the rest.
void add_inputs(const BudgetRequest& request, const InputDraws& inputs, Budget& budget) {
  const PolynomialChaos& chaos = *budget.chaos;
  const std::size_t count = request.inputs.size();
  double rest = chaos.variance * (1 + chaos.leave_one_out), mutual = 0;
  std::vector<double> slopes;
  for (std::size_t j = 0; j < count; ++j) {
    constexpr double step = 0.1;
    std::vector<double> above(count), below(count);
    above[j] = step;
    below[j] = -step;
    const UncertainInput& input = request.inputs[j];
    const VarianceShare& share = chaos.shares[j];
    const double slope = (chaos.at(above) - chaos.at(below)) / (input.at(step) - input.at(-step));
    slopes.push_back(slope * input.uncertainty);
    BudgetPart& part =
        add_part(budget, input.name,
                 request.correlations.empty() ? std::sqrt(share.first * chaos.variance) : std::abs(slopes[j]),
                 input.degrees);
    part.share_error = share.first_error;
    part.input = input;
    part.sensitivity = slope;
    part.total = share.total * chaos.variance;
    rest -= part.variance();
    for (std::size_t k = 0; k < j; ++k) mutual += 2 * slopes[j] * slopes[k] * inputs.correlation(j, k);
  }
  // Also halves its covariances.
  for (std::size_t j = 0; j < count && !request.correlations.empty(); ++j) {
    BudgetPart& part = budget.parts[budget.parts.size() - count + j];
    part.total = part.variance() * (1 - 4.0 / 3);
    for (std::size_t k = 0; k < count; ++k)
      part.total += 4.0 / 3 * slopes[j] * slopes[k] * inputs.correlation(j, k);
  }
  if (!request.correlations.empty())
    add_part(budget, "correlation", std::sqrt(std::abs(mutual)), infinity).sign = mutual < 0 ? -1 : 1;
  if (count > 1) add_part(budget, "inputs together", std::sqrt(std::max(0.0, rest)), infinity);
}

void add_parts(const BudgetRequest& request, const InputDraws& inputs, const BudgetFindings& found,
               Budget& budget) {
  for (const BudgetTerm& term : found.terms)
    add_part(budget, term.name, term.uncertainty(), term.scale > 0 ? term.degrees : infinity);
  double variance = 0, of_inputs = 0;
  for (const BudgetPart& part : budget.parts) variance += part.variance();
  if (budget.chaos && budget.chaos->trust() != ChaosTrust::refused) {
    const std::size_t others = budget.parts.size();
    add_inputs(request, inputs, budget);
    for (std::size_t k = others; k < budget.parts.size(); ++k) of_inputs += budget.parts[k].variance();
  }
  variance += of_inputs;
  budget.uncertainty = std::sqrt(std::max(0.0, variance));
  for (BudgetPart& part : budget.parts) {
    part.share = variance > 0 ? part.variance() / variance : 0;
    part.share_error *= variance > 0 ? of_inputs / variance : 0;
  }
}

// Ascending; inputs by their polynomial unless refused.
std::vector<double> budget_draws(const BudgetRequest& request, const InputDraws& inputs,
                                 const BudgetFindings& found, const Budget& budget) {
  const Stream lack(request.seed, "budget lack");
  std::vector<Stream> places, scatters;
  for (const BudgetTerm& term : found.terms) {
    places.emplace_back(request.seed, "budget place " + term.name);
    scatters.emplace_back(request.seed, "budget " + term.name);
  }
  const PolynomialChaos* chaos =
      budget.chaos && budget.chaos->trust() != ChaosTrust::refused ? &*budget.chaos : nullptr;
  const double at_values = chaos != nullptr ? chaos->at(std::vector<double>(request.inputs.size())) : 0;
  std::vector<double> drawn;
  for (std::uint64_t k = 0; k < request.draws; ++k) {
    double value = found.centre;
    for (std::size_t i = 0; i < found.terms.size(); ++i) {
      const BudgetTerm& term = found.terms[i];
      if (!term.list.empty())
        value += term.list[static_cast<std::size_t>(places[i].below(k, term.list.size()))];
      if (!(term.scale > 0)) continue;
      const double t = student_draw(scatters[i], k, term.degrees);
      if (term.name == "sampling" && request.interval == MeanInterval::log_normal)
        value += elementary::exp(budget.sample->log_centre + t * budget.sample->log_error) - found.centre;
      else
        value += t * term.scale;
    }
    if (chaos != nullptr)
      value += chaos->at(inputs.at(k)) - at_values +
               std::sqrt(chaos->leave_one_out * chaos->variance) * lack.normal(k);
    drawn.push_back(value);
  }
  std::ranges::sort(drawn);
  return drawn;
}

void add_interval(const BudgetRequest& request, const InputDraws& inputs, const BudgetFindings& found,
                  Budget& budget) {
  budget.value = found.centre;
  for (const BudgetTerm& term : found.terms) budget.value += average_of(term.list);
  if (found.terms.size() == 1 && found.terms.front().list.empty() && !budget.chaos) {
    const BudgetTerm& term = found.terms.front();
    const double reach = term.scale * student_t_factor(request.confidence, term.degrees);
    budget.low = budget.sample ? *budget.sample->low : budget.value - reach;
    budget.high = budget.sample ? *budget.sample->high : budget.value + reach;
    return;
  }
  if (budget.chaos && budget.chaos->trust() != ChaosTrust::refused)
    budget.value += budget.chaos->mean - budget.chaos->at(std::vector<double>(request.inputs.size()));
  const std::vector<double> drawn = budget_draws(request, inputs, found, budget);
  const auto tail =
      static_cast<std::size_t>((1 - request.confidence) / 2 * static_cast<double>(drawn.size()));
  budget.low = drawn[tail];
  budget.high = drawn[drawn.size() - 1 - tail];
}

}  // namespace

std::vector<double> budget_grids(const BudgetRequest& request) {
  std::vector<double> grids = request.cells;
  if (request.replicates > 0 || grids.size() != 2) return grids;
  for (const double share : {0.25, 0.5}) {
    const double cells = 2 * std::ceil((grids[0] + share * (grids[1] - grids[0])) / 2);
    if (cells < grids[1] && cells != grids.back()) grids.push_back(cells);
  }
  return grids;
}

std::size_t budget_runs(const BudgetRequest& request) {
  const std::size_t between = budget_grids(request).size() - request.cells.size();
  return std::max<std::size_t>(1, request.cells.size()) * std::max<std::size_t>(1, request.replicates) +
         between + (request.tolerances.size() > 1 ? 1 : 0) + (request.tips.size() > 1 ? 1 : 0) +
         request.noises + runs_of_inputs(request);
}

Budget budget_of_batches(const BudgetRequest& request, const BudgetBatch& ask) {
  check_request(request);
  const InputDraws inputs(request.inputs, request.correlations, request.seed);
  Budget budget;
  budget.confidence = request.confidence;
  budget.replicates = request.replicates;
  budget.cells = request.cells;
  budget.tolerances = request.tolerances;
  budget.tips = request.tips;
  budget.asked = request.half_width;
  BudgetFindings found;
  BudgetRuns runs(request, ask);
  auto answers = runs.replicates();
  found.first = answers[0][0];
  take_specimens(request, runs, answers, budget);
  look_at_cells(request, answers, runs, found, budget);
  look_at_sample(request, answers.back(), found, budget);
  look_at_solver(request, runs, found, budget);
  look_at_instrument(request, runs, found, budget);
  look_at_inputs(request, runs, found, budget);
  add_parts(request, inputs, found, budget);
  add_interval(request, inputs, found, budget);
  if (budget.asked && request.of_answer) *budget.asked *= std::abs(budget.value);
  budget.runs = runs.count;
  budget.seconds = runs.sum;
  for (const auto& on_grid : runs.seconds) budget.seconds_of_cells.push_back(median(on_grid));
  const double solver_seconds =
      request.tolerances.size() > 1 ? std::max(0.0, runs.seconds[0][0] - runs.loose_seconds) : 0;
  const bool by_chance = request.replicates == 0 && !found.terms.empty() && found.terms.front().list.empty();
  add_costs(budget, by_chance ? 1 : (request.order_low + request.order_high) / 2, solver_seconds);
  std::ranges::stable_sort(budget.parts,
                           [](const BudgetPart& a, const BudgetPart& b) { return a.share > b.share; });
  return budget;
}

}  // namespace asperity
