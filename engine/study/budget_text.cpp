// SPDX-License-Identifier: GPL-3.0-or-later
// A budget as a table.
#include <algorithm>
#include <cmath>

#include "engine/core/text.hpp"
#include "engine/study/budget.hpp"

namespace asperity {

namespace {

std::string padded_cell(std::string text, std::size_t width, bool right) {
  if (text.size() >= width) return text;
  const std::string space(width - text.size(), ' ');
  return right ? space + text : text + space;
}

std::string budget_share_text(double share) { return format_short(std::round(1000 * share) / 10, 4) + " %"; }

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

std::string Budget::text() const {
  std::string text = "budget: " + format_short(value, 5) + ", from " + format_short(low, 5) + " to " +
                     format_short(high, 5) + " (" + format_short(100 * confidence, 4) +
                     " %), standard uncertainty " + format_short(uncertainty, 3) + "; " +
                     std::to_string(runs) + (runs == 1 ? " run, " : " runs, ") + format_short(seconds, 2) +
                     " s\n";
  std::size_t width = 6;
  for (const BudgetPart& part : parts) width = std::max(width, part.name.size() + 2);
  text += "  " + padded_cell("part", width, false) + padded_cell("u", 11, true) +
          padded_cell("share", 9, true) + "   to halve it\n";
  const bool rough = chaos && chaos->trust() == ChaosTrust::rough;
  for (const BudgetPart& part : parts) {
    const bool of_input = !part.halving_seconds && part.name != "tip" && part.name != "noise";
    text += "  " + padded_cell(part.name, width, false) +
            padded_cell(format_short(part.uncertainty, 3), 11, true) +
            padded_cell((rough && of_input ? "~" : "") + budget_share_text(part.share), 9, true) + "   " +
            part.halving;
    if (part.halving_seconds) text += ", " + format_short(*part.halving_seconds, 2) + " s";
    text += "; then ± " + format_short(part.half_width_after, 3) + "\n";
  }
  if (sample) {
    text += "  sampling: n = " + std::to_string(sample->count);
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
