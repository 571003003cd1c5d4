// SPDX-License-Identifier: GPL-3.0-or-later
// How far the numbers of a state are from those of an ever finer grid: an estimate, by Richardson (1911),
// from the same press of the same bodies on companion grids. A quantity that errs by C h^p changes by
// C h^p (r^p - 1) to a grid r times coarser, and p is fixed for each quantity by measurement; but much of
// what cells do to a contact is chance. The area is judged by its own outline, and the first touch, the top
// of the highest peak between its nodes, by the parabola through them. An estimate is no bound; of 100 scenes
// with a known or a much finer answer on which nothing was tuned (tests/accuracy),
//
//                              from half and a quarter of the cells   from thrice the cells a side
//                              error within 3   within a factor       within a factor of three,
//                              estimates        of three              above and below
//     area fraction            100 %            98 %                  100 %
//     corrected area fraction   98 %            82 %                   93 %
//     approach                  95 %            87 %                   98 %
//     energy                    95 %            54 %                   97 %
//     separation, mean gap      88, 91 %        51, 51 %               96, 93 %
//     stiffness                 96 %            55 %                   88 %
//
// and of 16 with a prescribed approach, whose load, separation and energy err as the first touch does, 94 %,
// 75 to 81 %, and 100 %. Coarser grids cost about a third of a press and show how great the chance is, not
// what came of it: of two errors from like normal laws one is within a factor of three of the other in 59 %
// of all cases, and of an error whose law is known outright no guess is in more than 78 %. The finer grid
// sees the chance itself, at some eleven times the cost: its own error is a ninth as great in the middle
// scene, and the estimate is the step to it, its outline and first touch mended. What one step cannot show is
// a value that grows without end. It says nothing of roughness finer than the cells made or measured, of the
// size of the tile, or of the model.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/contact/state.hpp"

namespace asperity {

struct DiscretisationEstimate {
  double value = 0;  // as the state has it
  // Estimated magnitude, in the unit of the quantity: 0 of what was prescribed, infinite where the value
  // grows through two coarser grids without end, as the peak pressure at the rim of a cut body does.
  double error = 0;
  // The value with the error taken off where its sign is known: area, approach, …; with a finer grid, of
  // each.
  double extrapolated = 0;
  double margin = 1;        // times the error: above the true error in 19 of 20 scenes
  double relative() const;  // error / |value|; infinite for an error of a value of zero
};

// Names as a state has them: area_fraction, corrected_area_fraction, area, approach, …
std::span<const std::string> estimated_quantities();
// Throws Error{bad_value} or Error{unknown_name} where the scene asks for an estimate or an error that cannot
// be had: two kinds at once, too few cells, no such quantity, a share outside 1e-6 … 1. O(1).
void check_accuracy(const Scene& scene);
// Throws Error{unknown_name}, Error{bad_state} naming accuracy={ estimate=true } where it was not asked for,
// and what the quantity itself throws. Works the quantity out on each grid when first asked, which for
// `stiffness` is a solve. Thread-safe.
DiscretisationEstimate discretisation_estimate(const State& state, std::string_view quantity);

// "error of the grid, estimated: approach 6.6 nm, …", of the quantities that print(state) shows; empty where
// it was not asked for.
std::string discretisation_text(const State& state);

// By how much the parabolas through the highest node and its neighbours rise above it, >= 0; 0 across a rim
// that does not wrap, of the tile or of nodes that hold the lowest value of all. In the unit of the field.
double rise_between_nodes(const Field& field, bool wraps);

}  // namespace asperity
