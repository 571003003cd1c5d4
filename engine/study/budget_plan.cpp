// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of halving a part of a budget, and the cheapest way to an interval. Times scale as a power of the
// cells, discretisation errors with their order, the error of the mean as the root of the replicates.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/study/budget.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_replicates = 100000;

// Total variance and degrees of freedom (Welch–Satterthwaite), with factors on the variances of sampling and
// cells. Correlated inputs count as one.
std::pair<double, double> whole_of(const Budget& budget, double sampling, double cells, double replicates) {
  const bool correlated =
      std::ranges::find(budget.parts, "correlation", &BudgetPart::name) != budget.parts.end();
  double variance = 0, squares = 0, of_inputs = 0, alone = 0, slow = 0;
  for (const BudgetPart& part : budget.parts) {
    const bool sampled = part.name == "sampling";
    const double of_part = part.variance() * (sampled ? sampling : part.name == "cells" ? cells : 1);
    variance += of_part;
    if (correlated && (part.input || part.name == "correlation")) {
      of_inputs += of_part;
      alone += part.input ? of_part : 0;
      slow += part.input ? of_part / part.degrees : 0;
    } else {
      squares += of_part * of_part / (sampled ? std::max(1.0, replicates - 1) : part.degrees);
    }
  }
  if (slow > 0) squares += of_inputs * of_inputs * slow / alone;
  const double degrees = variance * variance / squares;
  return {variance, degrees < 1e6 ? degrees : std::numeric_limits<double>::infinity()};
}

double even_cells(double cells) { return 2 * std::ceil(cells / 2 - 1e-9); }

class Planner {
 public:
  Planner(const Budget& budget, double order) : budget_(budget), order_(order) {
    const auto& t = budget.seconds_of_cells;
    if (budget.cells.size() > 1) ratio_ = budget.cells.back() / budget.cells[budget.cells.size() - 2];
    if (t.size() > 1 && t.back() > 0 && t[t.size() - 2] > 0)
      power_ = std::clamp(elementary::log(t.back() / t[t.size() - 2]) / elementary::log(ratio_), 0.0, 4.0);
    const double now = reach(budget_.replicates, finest());
    if (now > 0 && std::isfinite(budget.half_width())) scale_ = budget.half_width() / now;
  }

  double half_width(std::size_t replicates, double cells) const { return scale_ * reach(replicates, cells); }

  double seconds(std::size_t replicates, double cells) const {
    double of_one = run_seconds(cells);
    if (budget_.cells.size() > 1) of_one += run_seconds(cells / ratio_);
    return of_one * budget_.repeats * static_cast<double>(std::max<std::size_t>(1, replicates));
  }

  // Fewest replicates on these cells; 0: unreachable.
  std::size_t replicates_for(double half, double cells) const {
    if (half_width(most_replicates, cells) > half) return 0;
    std::size_t low = 1, high = most_replicates;  // insufficient, sufficient
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (half_width(middle, cells) <= half ? high : low) = middle;
    }
    return high;
  }

  std::vector<double> grids() const {
    if (budget_.cells.size() < 2) return {finest()};
    std::vector<double> list = budget_.cells;
    for (int k = -6; k <= 6; ++k) {
      const double cells = even_cells(finest() * elementary::exp2(k / 2.0));
      if (cells >= budget_.cells.front()) list.push_back(cells);
    }
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  std::optional<BudgetPlan> cheapest(double half) const {
    std::optional<BudgetPlan> best;
    for (const double cells : grids()) {
      BudgetPlan plan;
      plan.cells = cells;
      if (budget_.replicates > 0) {
        plan.replicates = replicates_for(half, cells);
        if (plan.replicates == 0) continue;
      } else if (half_width(0, cells) > half) {
        continue;
      }
      plan.seconds = seconds(plan.replicates, cells);
      plan.half_width = half_width(plan.replicates, cells);
      if (!best || plan.seconds < best->seconds) best = plan;
    }
    return best;
  }

  double finest() const { return budget_.cells.empty() ? 0 : budget_.cells.back(); }
  double finer_half() const { return even_cells(finest() * elementary::exp2(1 / order_)); }
  double run_seconds(double cells) const {
    const double finest_seconds = budget_.seconds_of_cells.back();
    return budget_.cells.empty() ? finest_seconds
                                 : finest_seconds * elementary::pow(cells / finest(), power_);
  }

 private:
  double reach(std::size_t replicates, double cells) const {
    const double n = static_cast<double>(replicates);
    const auto [variance, degrees] = whole_of(budget_, static_cast<double>(budget_.replicates) / n,
                                              elementary::pow(finest() / cells, 2 * order_), n);
    return variance > 0 ? student_t_factor(budget_.confidence, degrees) * std::sqrt(variance) : 0;
  }

  const Budget& budget_;
  double order_, ratio_ = 2, scale_ = 1, power_ = 2;  // `power_`: of the seconds
};

}  // namespace

double Budget::degrees() const { return whole_of(*this, 1, 1, static_cast<double>(replicates)).second; }

// `order`: of the discretisation error; `solver_seconds`: extra time per run on the coarsest grid of the
// tightest tolerance.
void add_costs(Budget& budget, double order, double solver_seconds) {
  const Planner planner(budget, order);
  const std::size_t n = budget.replicates;
  const double runs = budget.repeats * static_cast<double>(std::max<std::size_t>(1, n));
  const double whole = budget.uncertainty * budget.uncertainty;
  for (BudgetPart& part : budget.parts) {
    // Includes joint effects.
    const double share = part.input && whole > 0 ? part.total / whole : std::max(0.0, part.share);
    part.half_width_after = budget.half_width() * std::sqrt(std::max(0.0, 1 - 0.75 * share));
    if (part.name == "sampling") {
      part.half_width_after = planner.half_width(4 * n, planner.finest());
      part.halving = std::to_string(3 * n) + (budget.repeats > 1 ? " more specimens" : " more replicates");
      part.halving_seconds = planner.seconds(3 * n, planner.finest());
    } else if (part.name == "cells") {
      const double finer = planner.finer_half();
      part.halving = "cells = " + format_short(finer);
      part.halving_seconds = runs * planner.run_seconds(finer);
    } else if (part.name == "solver") {
      const double tightest = budget.tolerances.back();
      const double ratio = budget.tolerances[budget.tolerances.size() - 2] / tightest;
      const double first = budget.seconds_of_cells.front();
      const double growth = first > 0 ? budget.seconds_of_cells.back() / first : 1;
      part.halving = "tolerance = " + format_short(tightest / 2, 3);
      // All runs repeat and take longer.
      part.halving_seconds = planner.seconds(n, planner.finest()) +
                             runs * growth * solver_seconds * elementary::log(2) / elementary::log(ratio);
    } else if (part.name == "tip") {
      // The error scales as about radius^(3/2).
      part.halving =
          "a tip of " + format_quantity(budget.tips.back() / elementary::exp2(2.0 / 3), dimension::length, 2);
    } else if (part.name == "noise") {
      part.halving = "the mean of four measurements";
    } else if (part.input) {
      part.halving =
          "measured to u = " + format_quantity(part.input->uncertainty / 2, part.input->dimension, 3);
    } else {
      part.halving = "better measured inputs";
    }
  }
  if (budget.asked) budget.plan = planner.cheapest(*budget.asked);
}

}  // namespace asperity
