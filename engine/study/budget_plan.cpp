// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of halving a part, and the cheapest way to an interval. Times scale as a power of the cells,
// discretisation errors with their order, the error of the mean as the root of the replicates.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/distributions.hpp"
#include "engine/study/budget.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_replicates = 100000;

// Total variance and degrees of freedom (Welch–Satterthwaite), with factors for sampling and cells.
// Correlated inputs count as one.
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
  return {variance, degrees < 1e6 ? degrees : infinity};
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

  // Fewest on these cells; 0: unreachable.
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

void check_ascent(const std::vector<double>& list, const char* key, bool ascending) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!std::isfinite(list[k]) || list[k] <= 0)
      refuse(quoted(key) + " holds " + format_short(list[k]), "give numbers above 0");
    if (k > 0 && (ascending ? list[k] <= list[k - 1] : list[k] >= list[k - 1]))
      refuse(quoted(key) + " goes from " + format_short(list[k - 1]) + " to " + format_short(list[k]),
             ascending                        ? "give each grid once, coarse ones first"
             : std::string_view(key) == "tip" ? "give each radius once, blunt ones first"
                                              : "give each tolerance once, loose ones first");
  }
}

// Rounding errors around 0 print as 0.
std::string tidy(double value, double uncertainty, int digits) {
  return format_short(std::abs(value) < 1e-12 * uncertainty ? 0 : value, digits);
}

std::string degrees_text(double degrees) {
  return std::isfinite(degrees) ? format_short(degrees, 3) : std::string("∞");
}

// Table of inputs after the GUM.
void add_input_sheet(const Budget& budget, std::string& text) {
  std::vector<TextLine> lines = {{"input", "value", "u", "degrees", "sensitivity", "contribution", "shape"}};
  for (const BudgetPart& part : budget.parts)
    if (const auto& input = part.input)
      lines.push_back({input->name, format_quantity(input->value, input->dimension, 5),
                       format_quantity(input->uncertainty, input->dimension, 3), degrees_text(input->degrees),
                       tidy(part.sensitivity, budget.uncertainty / input->uncertainty, 4),
                       tidy(std::abs(part.sensitivity) * input->uncertainty, budget.uncertainty, 3),
                       input_shapes()[static_cast<std::size_t>(input->shape)]});
  if (lines.size() > 1) text += aligned(lines).substr(1) + "\n";
}

std::string grid_text(std::size_t replicates, double cells) {
  std::string text = replicates > 0 ? std::to_string(replicates) + " replicates" : "one run";
  if (cells > 0) text += " on " + format_short(cells) + "²";
  return text;
}

void add_plan_text(const Budget& budget, std::string& text) {
  if (!budget.asked) return;
  const std::string asked = "± " + format_short(*budget.asked, 3);
  if (budget.plan) {
    const double now = budget.cells.empty() ? 0 : budget.cells.back();
    text += "  cheapest way to " + asked + ": " + grid_text(budget.plan->replicates, budget.plan->cells) +
            " instead of " + grid_text(budget.replicates, now) + ", " +
            format_short(budget.plan->seconds, 2) + " s\n";
    return;
  }
  text += "  " + asked + " cannot be reached by replicates and cells alone";
  for (const BudgetPart& part : budget.parts)
    if (!part.halving_seconds || part.name == "solver") {
      text += ": the greatest other share is that of " + part.name;
      break;
    }
  text += "\n";
}

}  // namespace

void check_request(const BudgetRequest& request) {
  if (!request.inputs.empty()) check_inputs(request.inputs);
  if (request.replicates == 1) refuse("`replicate` has one value", "scatter takes two or more, better five");
  check_ascent(request.cells, "cells", true);
  check_ascent(request.tolerances, "tolerance", false);
  check_ascent(request.tips, "tip", false);
  if (request.noises == 1) refuse("`noise` has one draw", "scatter takes two or more, better five");
  if (!(request.order_low > 0) || !(request.order_high >= request.order_low) || !(request.order_high <= 10))
    refuse("`order` goes from " + format_short(request.order_low) + " to " + format_short(request.order_high),
           "give the least and the greatest order of the error of the cells, above 0 and at most 10");
  if (!(request.confidence > 0 && request.confidence < 1))
    refuse("`confidence` is " + format_short(request.confidence), "give a number between 0 and 1");
  if (request.half_width && !(*request.half_width > 0 && std::isfinite(*request.half_width)))
    refuse("`half_width` is " + format_short(*request.half_width), "give a finite number above 0");
  if (request.draws < 100) refuse("there are fewer than 100 draws", "give more");
  if (request.inputs.empty() && request.replicates == 0 && request.cells.size() < 2 &&
      request.tolerances.size() < 2 && request.tips.size() < 2 && request.noises == 0)
    refuse("there is nothing to vary",
           "give `inputs`, `replicate`, `noise`, or two or more `cells`, `tolerance` or `tip`");
}

double Budget::degrees() const { return whole_of(*this, 1, 1, static_cast<double>(replicates)).second; }

// `order`: of the discretisation error; `solver_seconds`: extra time per run of the tightest tolerance, on
// the coarsest grid.
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
      // All runs repeat, with more time.
      part.halving_seconds = planner.seconds(n, planner.finest()) +
                             runs * growth * solver_seconds * elementary::log(2) / elementary::log(ratio);
    } else if (part.name == "tip") {
      // Error about proportional to radius^(3/2).
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

std::string Budget::text() const {
  std::string text = "budget: " + tidy(value, uncertainty, 5) + ", from " + tidy(low, uncertainty, 5) +
                     " to " + tidy(high, uncertainty, 5) + " (" + format_short(100 * confidence, 4) +
                     " %), standard uncertainty " + format_short(uncertainty, 3);
  if (uncertainty > 0)
    text += ", coverage factor " + format_short(half_width() / uncertainty, 3) + ", " +
            degrees_text(degrees()) + " degrees of freedom";
  text += "; " + counted(runs, "run") + ", " + format_short(seconds, 2) + " s\n";
  std::vector<TextLine> lines = {{"part", "u", "degrees", "share", "to halve it"}};
  const bool rough = chaos && chaos->trust() == ChaosTrust::rough;
  for (const BudgetPart& part : parts) {
    const bool of_input = !part.halving_seconds && part.name != "tip" && part.name != "noise";
    std::string halving = part.halving;
    if (part.halving_seconds) halving += ", " + format_short(*part.halving_seconds, 2) + " s";
    lines.push_back(
        {part.name, tidy(part.uncertainty, uncertainty, 3), degrees_text(part.degrees),
         (rough && of_input ? "~" : "") + format_short(std::round(1000 * part.share) / 10 + 0.0, 4) + " %",
         halving + "; then ± " + format_short(part.half_width_after, 3)});
  }
  text += aligned(lines).substr(1) + "\n";
  add_input_sheet(*this, text);
  if (sample) {
    text += "  sampling: n = " + std::to_string(sample->count);
    if (repeats > 1) text += " specimens of " + format_short(repeats, 3) + " runs each";
    if (sample->skewness) text += ", skewness " + format_short(*sample->skewness, 2);
    text += "; " + sample->method + "\n";
  }
  if (order_observed) text += "  order of the cells, observed: " + format_short(*order_observed, 3) + "\n";
  for (const std::string& note : notes) text += "  " + note + "\n";
  for (const std::string& warning : warnings) text += "  warning: " + warning + "\n";
  add_plan_text(*this, text);
  return text;
}

}  // namespace asperity
