// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of cells and tolerance for a requested error. One press is solved on grids from coarse to fine, each
// doubling the cells per side, until the estimated error meets the request. Each press starts from the
// previous pressures; the previous grid also serves the error estimate. Without attraction, the corrected
// area is the area within an outline between nodes (contact/outline_area.hpp). docs/accuracy.md lists success
// rates and costs.
// Generated surfaces are generated again on other cells. Other surfaces are sampled at every second node and
// never refined. Two rough bodies face each other node over node as on the given cells; an upper body off the
// lattice turns about the middle of the new nodes. Single precision saves no time: 0.96 to 1.19 times double
// on periodic tiles, 1.13 to 1.78 on free tiles (bench_half_space precision=6 seeds=2 threads=1).
#pragma once

#include <memory>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct AccuracyChoice {
  Scene scene;
  std::shared_ptr<const ContactGeometry> geometry;
  Plan plan;
  std::shared_ptr<const Solver> solver;
  State state;  // with estimate, choice, cost of every grid
};

// For a load above zero without earlier events. Throws errors of a press, and Error{not_converged} naming
// limit and required cells if no permitted grid meets the request, unless the scene accepts the best.
AccuracyChoice choose_accuracy(const Scene& scene, const ContactGeometry& geometry,
                               const PressRequest& request, Monitor& monitor = Monitor::silent());

// A later press on the chosen cells. Throws Error{not_converged} above the request, unless `scene` accepts
// the best grid.
State held_to(const State& state, const ChosenAccuracy& chosen, const Scene& scene, const Plan& plan);

// Tolerance of a first try, if an error is requested.
Accuracy before_choice(Accuracy accuracy);
// A tolerance replaces a requested error.
Accuracy with_tolerance(Accuracy accuracy, double tolerance);
Accuracy without_companion(Accuracy accuracy);

// Before the choice, memory and time become those of the finest permitted grid.
void plan_choice(const Scene& scene, Plan& plan);

}  // namespace asperity
