// SPDX-License-Identifier: GPL-3.0-or-later
// Cells and tolerance chosen for a requested error: the same press of the same bodies on grids from coarse to
// fine, each with twice the cells a side of the one before, until the estimated error is within the request.
// Each press begins from the pressures of the one before, which is also the coarser grid of its estimate, so
// nothing is solved twice. The corrected area of half-spaces and boxes without attraction is the area within
// an outline between the nodes (contact/outline_area.hpp). docs/accuracy.md has a table of how often requests
// are met and at what cost; bench/requested_error.lua measures it.
//
// Surfaces with a generator are made again on other cells with all their waves and features. Others are
// sampled at every second node, and no grid is finer than their own. Two rough bodies lie node over node as
// on the cells given; an upper body turned off the lattice is turned about the middle of the new nodes.
//
// The precision is that of the scene, double unless single is named: single takes as many transforms and, of
// the time of double, 0.96 to 1.19 on periodic tiles of 64² to 1024² cells and 1.13 to 1.78 on free ones
// (bench_half_space precision=6 seeds=2 threads=1 sizes=64,128,256,512,1024, tolerances of 1e-3 to 1e-7).
#pragma once

#include <memory>

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solver.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

struct AccuracyChoice {
  Scene scene;  // the bodies on the cells chosen, with the accuracy chosen
  std::shared_ptr<const ContactGeometry> geometry;
  Plan plan;
  std::shared_ptr<const Solver> solver;
  State state;  // under the request, with its estimate, the choice, and the cost of all grids tried
};

// For a contact that no event has changed yet, pressed by more than zero. Throws what a press throws, and
// Error{not_converged} if no grid within the limits meets the error, unless the scene takes the best there
// is. The error names the limit and the cells a side that would be needed.
AccuracyChoice choose_accuracy(const Scene& scene, const ContactGeometry& geometry,
                               const PressRequest& request, Monitor& monitor = Monitor::silent());

// The error of a later press on the cells that were chosen, recorded in the state. Throws
// Error{not_converged} where it is above the request, unless `scene` takes the best there is. `plan` is that
// of the press.
State held_to(const State& state, const ChosenAccuracy& chosen, const Scene& scene, const Plan& plan);

// The tolerance that a choice begins with.
double first_tolerance(const AskedError& asked);

// Adds a sentence about the choice to `plan`, the plan of the cells given. Until the choice is made, memory
// and time in the plan become those of the finest grid allowed.
void plan_choice(const Scene& scene, Plan& plan);

}  // namespace asperity
