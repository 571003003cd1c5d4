// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/adhesion.hpp"

#include <numbers>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/require.hpp"

namespace asperity {

void check_attraction(const Scene& scene, const std::string& effect) {
  const auto refuse = [&](const std::string& beside, const char* hint) {
    asperity::refuse(quoted(effect) + " is not computed " + beside + " by this version", hint);
  };
  if (!scene.elasticity.model().attraction)
    refuse("on " + std::string(scene.elasticity.model().noun), "give elasticity=\"half_space\"");
  if (scene.effects.has<PlasticityOptions>()) refuse("together with `plasticity`", "leave one out");
  if (scene.effects.has<TangentialOptions>()) refuse("together with `tangential`", "leave one out");
  if (scene.accuracy.precision == Accuracy::Precision::single)
    refuse("with `precision` \"single\"", "leave `precision` out");
  if (scene.accuracy.estimate != Accuracy::Estimate::none || scene.accuracy.asked)
    refuse("with an estimate of the error of the grid", "leave `estimate` and `error` out, give `tolerance`");
}

void plan_gap_term(GapTerm term, std::string sentence, const ContactGeometry& geometry, Plan& plan) {
  const Grid& grid = geometry.grid();
  plan.terms.push_back({term.effect, std::move(sentence)});
  if (term.work > 0) {
    if (!plan.attracts()) {
      const auto field = static_cast<std::int64_t>(grid.nodes() * sizeof(double));
      plan.buffers.push_back({"attraction of each state", field});
      plan.buffers.push_back({"preload from which presses go on", 3 * field});
      plan.buffers.push_back({"work of the tangents", 5 * field, false});
      plan.solver = "tangents of the attraction, each a contact by preconditioned descent";
      // Medians of 60 contacts: 161 transforms by approach, 228 by pressure.
      constexpr double times_without = 5;
      plan.transforms *= times_without;
      plan.seconds *= times_without;
    }
    const double modulus = plan.elasticity->modulus;
    constexpr double most = 100;  // of the modulus; beyond it tangents fail on any grid
    if (!(term.greatest() <= most * modulus))
      refuse(quoted(term.effect) + " pulls with " + format_quantity(term.greatest(), dimension::pressure) +
                 " at touch, over a hundred times the contact modulus",
             "check the units of its work and range");
    const double zone = 0.25 * std::numbers::pi * modulus * term.work / (term.greatest() * term.greatest());
    const double cell = std::max(grid.hx(), grid.hy());
    constexpr double enough = 4;
    if (zone < enough * cell)
      plan.warnings.push_back(
          quoted(term.effect) + " acts around a contact in a zone about " +
          format_quantity(zone, dimension::length, 3) + " wide, " + format_short(zone / cell, 2) +
          " cells; below four cells, pull and jumps depend on the grid: give more `cells` or a longer range");
  }
  plan.attraction.push_back(std::move(term));
}

namespace {

void check_adhesion(const std::any& given, const Scene& scene) {
  if (std::any_cast<const AdhesionOptions&>(given).work > 0) check_attraction(scene, "adhesion");
}

void plan_adhesion(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  const auto& options = std::any_cast<const AdhesionOptions&>(given);
  const bool dugdale = options.model == GapLaw::dugdale;
  plan_gap_term({"adhesion", options.model, options.work, options.range},
                std::string(dugdale ? "constant" : "exponential") + " attraction of " +
                    format_short(options.work) + " J/m^2 within " +
                    format_quantity(options.range, dimension::length) + ", " +
                    format_quantity(options.work / options.range, dimension::pressure) + " at touch",
                geometry, plan);
}

}  // namespace

const Effect& adhesion_effect() {
  using O = AdhesionOptions;
  static const Effect record{
      .name = "adhesion",
      .sentence =
          "the surfaces attract each other across the gap; loads and approaches may be below zero. A press "
          "takes many transforms: of 240 contacts, balls and rough ground on 64 x 64 cells, 32 to 2397 by "
          "approach, 94 in the middle, and 66 to 8708 by pressure, 136 in the middle; contact:explain tells "
          "those of one",
      .acts = Effect::Acts::adds_term,
      .defaults = O{},
      .options = {quantity_row("work", &O::work, dimension::energy_per_area, at_least(0),
                               "of parting a unit of area")
                      .needed(),
                  quantity_row("range", &O::range, dimension::length, above(0),
                               "gap over which the attraction falls")
                      .needed(),
                  choice_row(
                      "model", &O::model,
                      {{"exponential", GapLaw::exponential}, {"dugdale", GapLaw::dugdale}},
                      "work/range e^(-gap/range), or work/range up to a gap of the range; the end is "
                      "smoothed over gaps of 0.5 to 1.5 ranges, so pull-off is 0.1 to 0.5 % above Maugis's")},
      .check = check_adhesion,
      .plan = plan_adhesion};
  return record;
}
const Effect& AdhesionOptions::effect() { return adhesion_effect(); }

}  // namespace asperity
