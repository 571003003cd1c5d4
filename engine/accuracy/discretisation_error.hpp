// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation errors of a state by Richardson extrapolation (1911) from the same press on companion grids.
// An error C h^p changes by C h^p (r^p - 1) on a grid r times coarser; p is measured for each quantity. Much
// of the error is random. Areas also use their outline; first touch uses the parabola through the highest
// node.
// Estimates are no bounds; docs/accuracy.md tabulates their reliability over 100 scenes (tests/accuracy).
// Coarser grids cost a third of a press and show only the size of the random error. A finer grid costs about
// eleven presses and shows the random error itself, but not unlimited growth. Roughness below the cell size,
// tile size and model errors are not included.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/contact/state.hpp"

namespace asperity {

struct DiscretisationEstimate {
  double value = 0;
  // In the unit of the quantity: 0 if prescribed; infinite if the value grows over two coarser grids, as the
  // peak pressure at a cut rim.
  double error = 0;
  // Corrected by an error of known sign: area, approach, …; on a finer grid, every quantity.
  double extrapolated = 0;
  double margin = 1;        // `margin` × `error` covers 19 of 20 scenes
  double relative() const;  // infinite for a zero value with an error
};

// area_fraction, corrected_area_fraction, area, approach, …
std::span<const std::string> estimated_quantities();
// Throws Error{bad_value} or Error{unknown_name} for both kinds of grids, too few cells, an unknown quantity,
// a share outside 1e-6 … 1. O(1).
void check_accuracy(const Scene& scene);
// Throws Error{unknown_name}, Error{bad_state} without accuracy={ estimate=true }, and errors of the
// quantity. The first call computes each grid (`stiffness`: a solve). Thread-safe.
DiscretisationEstimate discretisation_estimate(const State& state, std::string_view quantity);

// "error of the grid, estimated: approach 6.6 nm, …"; empty without an estimate.
std::string discretisation_text(const State& state);

// Rise of parabolas through the highest node, ≥ 0, in the unit of the field. 0 at a rim without wrap, of the
// tile or of the lowest nodes.
double rise_between_nodes(const Field& field, bool wraps);

}  // namespace asperity
