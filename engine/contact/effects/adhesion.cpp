// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/adhesion.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void plan_gap_term(GapTerm term, std::string sentence, const ContactGeometry& geometry, Plan& plan) {
  const Grid& grid = geometry.grid();
  plan.terms.push_back({term.effect, std::move(sentence)});
  if (term.work > 0) {
    if (!plan.attracts()) {
      const auto field = static_cast<std::int64_t>(grid.nodes() * sizeof(double));
      plan.buffers.push_back({"attraction of each state", field});
      plan.buffers.push_back({"turn that presses are drawn from", 3 * field});
      plan.buffers.push_back({"work of the tangents", 5 * field, false});
      plan.solver = "tangents of the attraction, each a contact by preconditioned descent";
      // Of 60 contacts that attract each other, balls and rough ground on 64 x 64 cells: 161 by approach, 228
      // by pressure in the middle.
      constexpr double times_without = 5;
      plan.transforms *= times_without;
      plan.seconds *= times_without;
    }
    const double modulus = std::get<HalfSpaceOperator>(plan.elasticity).modulus;
    constexpr double most = 100;  // of the modulus; beyond it no grid holds the tangents together
    if (!(term.greatest() <= most * modulus))
      throw Error(ErrorCode::bad_value,
                  quoted(term.effect) + " pulls with " +
                      format_quantity(term.greatest(), dimension::pressure) +
                      " at touch, over a hundred times the contact modulus",
                  "check the units of its work and range");
    const double zone = 0.25 * std::numbers::pi * modulus * term.work / (term.greatest() * term.greatest());
    const double cell = std::max(grid.hx(), grid.hy());
    constexpr double enough = 4;
    if (zone < enough * cell)
      plan.warnings.push_back("the zone where " + quoted(term.effect) + " pulls beside a contact is about " +
                              format_quantity(zone, dimension::length, 3) + " wide, " +
                              format_short(zone / cell, 2) +
                              " cells; under four, pull and jumps hang on the grid: take more `cells` or a "
                              "longer range");
  }
  plan.attraction.push_back(std::move(term));
}

void plan_adhesion(const AdhesionOptions& options, const ContactGeometry& geometry, Plan& plan) {
  const bool dugdale = options.model == GapLaw::dugdale;
  plan_gap_term({"adhesion", options.model, options.work, options.range, dugdale ? 0.5 : 0.0},
                std::string(dugdale ? "constant" : "exponential") + " attraction of " +
                    format_short(options.work) + " J/m^2 within " +
                    format_quantity(options.range, dimension::length) + ", " +
                    format_quantity(options.work / options.range, dimension::pressure) + " at touch",
                geometry, plan);
}

}  // namespace asperity
