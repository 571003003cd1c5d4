// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "engine/core/text.hpp"
#include "engine/study/budget.hpp"
#include "engine/study/study_text.hpp"

namespace asperity {

namespace {

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

std::string budget_share_text(double share) {
  return format_short(std::round(1000 * share) / 10 + 0.0, 4) + " %";
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

std::string Budget::text() const {
  std::string text = "budget: " + tidy(value, uncertainty, 5) + ", from " + tidy(low, uncertainty, 5) +
                     " to " + tidy(high, uncertainty, 5) + " (" + format_short(100 * confidence, 4) +
                     " %), standard uncertainty " + format_short(uncertainty, 3);
  if (uncertainty > 0)
    text += ", coverage factor " + format_short(half_width() / uncertainty, 3) + ", " +
            degrees_text(degrees()) + " degrees of freedom";
  text +=
      "; " + std::to_string(runs) + (runs == 1 ? " run, " : " runs, ") + format_short(seconds, 2) + " s\n";
  std::vector<TextLine> lines = {{"part", "u", "degrees", "share", "to halve it"}};
  const bool rough = chaos && chaos->trust() == ChaosTrust::rough;
  for (const BudgetPart& part : parts) {
    const bool of_input = !part.halving_seconds && part.name != "tip" && part.name != "noise";
    std::string halving = part.halving;
    if (part.halving_seconds) halving += ", " + format_short(*part.halving_seconds, 2) + " s";
    lines.push_back({part.name, tidy(part.uncertainty, uncertainty, 3), degrees_text(part.degrees),
                     (rough && of_input ? "~" : "") + budget_share_text(part.share),
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
