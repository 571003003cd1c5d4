// SPDX-License-Identifier: GPL-3.0-or-later
// What it costs to halve a part of a budget, and the cheapest way to an interval. Times of other grids follow
// from those measured, as a power of the cells; the error of the cells falls with their order, that of the
// mean with the root of the replicates.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/study/budget.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_replicates = 100000;

const BudgetPart* part_called(const Budget& budget, const char* name) {
  for (const BudgetPart& part : budget.parts)
    if (part.name == name) return &part;
  return nullptr;
}

// Seconds of a run on other grids.
class GridTimes {
 public:
  explicit GridTimes(const Budget& budget) : budget_(budget) {
    const auto& t = budget.seconds_of_cells;
    if (t.size() > 1 && t.back() > 0 && t[t.size() - 2] > 0)
      power_ = std::clamp(elementary::log(t.back() / t[t.size() - 2]) /
                              elementary::log(budget.cells.back() / budget.cells[t.size() - 2]),
                          0.0, 4.0);
  }
  double at(double cells) const {
    for (std::size_t k = 0; k < budget_.cells.size(); ++k)
      if (budget_.cells[k] == cells) return budget_.seconds_of_cells[k];
    return budget_.seconds_of_cells.back() * elementary::pow(cells / budget_.cells.back(), power_);
  }

 private:
  const Budget& budget_;
  double power_ = 2;
};

double even_cells(double cells) { return 2 * std::ceil(cells / 2 - 1e-9); }

// Predicts interval and time for other numbers of replicates and cells.
class Planner {
 public:
  Planner(const Budget& budget, double order) : budget_(budget), times_(budget), order_(order) {
    if (const BudgetPart* part = part_called(budget, "sampling")) sampling_ = part->uncertainty;
    if (const BudgetPart* part = part_called(budget, "cells")) cells_ = part->uncertainty;
    rest_ = std::max(0.0, budget.uncertainty * budget.uncertainty - sampling_ * sampling_ - cells_ * cells_);
    if (budget.cells.size() > 1) ratio_ = budget.cells.back() / budget.cells[budget.cells.size() - 2];
    const double now = reach(replicates_now(), finest());
    if (now > 0 && std::isfinite(budget.half_width())) scale_ = budget.half_width() / now;
  }

  double half_width(std::size_t replicates, double cells) const { return scale_ * reach(replicates, cells); }

  double seconds(std::size_t replicates, double cells) const {
    double of_one = 0;
    if (budget_.cells.empty())
      of_one = budget_.seconds_of_cells.back();
    else
      of_one = times_.at(cells) + (budget_.cells.size() > 1 ? times_.at(cells / ratio_) : 0);
    return of_one * static_cast<double>(std::max<std::size_t>(1, replicates));
  }

  // The fewest replicates on these cells; 0 for none, or where there is nothing to sample.
  std::size_t replicates_for(double half, double cells) const {
    if (half_width(most_replicates, cells) > half) return 0;
    std::size_t low = 1, high = most_replicates;  // not enough, enough
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
  std::size_t replicates_now() const { return budget_.replicates; }
  double finer_half() const { return even_cells(finest() * elementary::exp2(1 / order_)); }
  double run_seconds(double cells) const { return times_.at(cells); }

 private:
  double reach(std::size_t replicates, double cells) const {
    double sampling = 0;
    if (budget_.replicates > 0)
      sampling =
          sampling_ * sampling_ * static_cast<double>(budget_.replicates) / static_cast<double>(replicates);
    double of_cells = 0;
    if (budget_.cells.size() > 1) {
      const double u = cells_ * elementary::pow(finest() / cells, order_);
      of_cells = u * u;
    }
    const double variance = sampling + of_cells + rest_;
    if (!(variance > 0)) return 0;
    // Degrees of freedom of the whole, by Welch and Satterthwaite.
    double degrees = std::numeric_limits<double>::infinity();
    if (sampling > 0 && replicates > 1)
      degrees = variance / sampling * (variance / sampling) * static_cast<double>(replicates - 1);
    if (degrees > 1e9) degrees = std::numeric_limits<double>::infinity();
    return student_t_factor(budget_.confidence, degrees) * std::sqrt(variance);
  }

  const Budget& budget_;
  GridTimes times_;
  double order_;
  double sampling_ = 0, cells_ = 0, rest_ = 0, ratio_ = 2, scale_ = 1;
};

}  // namespace

// Fills what halving takes, how wide the interval is then, and the plan. `order` is that of the error of the
// cells; `solver_seconds` is how much longer a run on the coarsest grid takes to the tightest tolerance than
// to the one before.
void add_costs(Budget& budget, double order, double solver_seconds) {
  const Planner planner(budget, order);
  const std::size_t n = budget.replicates;
  const double runs = static_cast<double>(std::max<std::size_t>(1, n));
  for (BudgetPart& part : budget.parts) {
    part.half_width_after = budget.half_width() * std::sqrt(std::max(0.0, 1 - 0.75 * part.share));
    if (part.name == "sampling") {
      part.halving = std::to_string(3 * n) + " more replicates";
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
      // The whole is run again, each run longer by what a halved tolerance takes.
      part.halving_seconds = planner.seconds(n, planner.finest()) +
                             runs * growth * solver_seconds * elementary::log(2) / elementary::log(ratio);
    } else if (part.name == "tip") {
      // Of an error that falls as the radius to the power of about 3/2.
      part.halving =
          "a tip of " + format_quantity(budget.tips.back() / elementary::exp2(2.0 / 3), dimension::length, 2);
    } else if (part.name == "noise") {
      part.halving = "the mean of four measurements";
    } else if (part.name == "inputs" || part.name == "inputs together") {
      part.halving = "better measured inputs";
    } else if (budget.chaos) {
      for (const UncertainInput& input : budget.chaos->inputs)
        if (input.name == part.name)
          part.halving = "measured to u = " + format_short(input.uncertainty / 2, 3);
    }
  }
  if (budget.asked) budget.plan = planner.cheapest(*budget.asked);
}

}  // namespace asperity
