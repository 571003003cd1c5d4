// SPDX-License-Identifier: GPL-3.0-or-later
// Cells and tolerance chosen for an error that was asked for: the same press of the same surfaces on grids
// from coarse to fine, each twice the cells of the one before, until the estimate of the discretisation error
// (accuracy/discretisation_error.hpp), times the margin that covers 19 scenes in 20, and the algebraic bound
// together are within what was asked for. Where corrected areas alone are asked for of a body under a flat,
// and an outline between the nodes is known, what its doubt says of the cells that would do is the next grid
// tried, up to sixteen times the cells a side, with half-way grids (24, 48, 96 ... cells) between, unless the
// heights there would be interpolated between nodes that were measured. The corrected area of half-spaces
// that do not attract each other is that within an outline between the nodes (contact/outline_area.hpp),
// better than the same press gives without; its estimate is the doubt of that outline, with a margin, and a
// share of how far it moved from the grid before. Of others it goes by the edges of the outline and by how
// far successive grids agree. Of the bound on an area a tenth counts; that of an area within an outline
// between the nodes is not looked at. Grids begin at 16 cells; none under 32, of anything but areas 64, is
// believed. The two grids tried before a grid are the coarser ones its estimate needs, so nothing is solved
// twice, and each is pressed from the pressures of the one before. How often errors are met and what that
// costs: bench/asked_errors.lua. Surfaces that generators made are made again with all their waves and
// features; others are sampled at every second node, and beyond the cells they came with interpolated, which
// adds no roughness that was not measured. Two rough bodies lie on each other as they did on the cells given,
// exactly on coarser cells and on a periodic boundary; on finer cells of a free one the upper body is turned
// over about the middle of the new nodes, up to one given cell away.
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

// Memory of a solve that no grid passes, unless the run's own limit leaves less.
inline constexpr double most_bytes_of_a_choice = 4.0 * (std::int64_t{1} << 30);

struct AccuracyChoice {
  Scene scene;  // the bodies on the cells chosen, with the accuracy chosen
  std::shared_ptr<const ContactGeometry> geometry;
  Plan plan;
  std::shared_ptr<const Solver> solver;
  State state;  // under the request, with its estimate, the choice, and the cost of all that was tried
};

// For a contact that no event has changed yet, pressed by more than zero. Cost: one to two times that of the
// last press, counted as `choice` apart from it. Throws what a press throws, and Error{not_converged} with
// what was reached where the finest grid does not meet the error, unless the scene takes the best there is.
AccuracyChoice choose_accuracy(const Scene& scene, const ContactGeometry& geometry,
                               const PressRequest& request, Monitor& monitor = Monitor::silent());

// The error of a later press on the cells that were chosen, recorded in the state. Throws
// Error{not_converged} where it is above what was asked for, unless `scene` takes the best there is.
// `plan` is that of the press.
State held_to(const State& state, const ChosenAccuracy& chosen, const Scene& scene, const Plan& plan);

// The tolerance that a choice begins with.
double first_tolerance(const AskedError& asked);

// What a contact that asks for an error is going to do, or has done, as one line of its plan; empty where it
// does not ask.
std::string choice_text(const Scene& scene, const Plan& plan);

// The finest cells that may be chosen, given those that a contact came with and what it holds there.
Grid finest_grid(const Grid& given, const Plan& plan);

}  // namespace asperity
