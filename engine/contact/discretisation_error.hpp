// SPDX-License-Identifier: GPL-3.0-or-later
// How far the numbers of a state are from those of an ever finer grid: an estimate, by Richardson (1911),
// from the same press of the same bodies on grids of half and of a quarter of the cells. A quantity
// that errs by C h^p changes by C h^p (r^p - 1) to a grid r times coarser; p is fixed for each quantity by
// measurement, and the larger answer of the two pairs of grids counts, for much of what cells do to a
// contact is chance, of which a single difference can be small by accident. The area is judged by its own
// outline, and the first touch, the top of the highest peak between its nodes, by the parabola through
// them. An estimate is no bound. Over 56 scenes with a known or a much finer answer on which nothing was
// tuned (tests/accuracy), the true error was within three times the estimate in all for the area fraction, 98
// % for the corrected one, 94 % for the energy, 92 % for the approach; the estimate was within three times
// the true error in 96, 70, 57 and 84 %, for of an error that is chance nobody can tell the size from its
// law. It says nothing of roughness finer than the cells, of the size of the tile, or of the model.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/contact/plan.hpp"
#include "engine/contact/press_request.hpp"
#include "engine/contact/scene.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// The same press on coarser grids.
class CoarserSolutions {
 public:
  struct Level {
    State state;
    double ratio = 2;  // width of a cell over that of the next finer grid
  };
  CoarserSolutions(const PressRequest& request, std::vector<Level> levels)
      : request_(request), levels_(std::move(levels)) {}

  const PressRequest& request() const { return request_; }
  std::span<const Level> levels() const { return levels_; }  // one or two, the finer first

 private:
  PressRequest request_;
  std::vector<Level> levels_;
};

// The grids that a press on `grid` is compared with: half the cells a side and a quarter, where 8 cells are
// left along x or y; a side of fewer than 16 keeps its cells. Odd cells are halved upwards.
std::vector<Grid> coarser_grids(const Grid& grid);

// Solves `request` on coarser grids for the bodies as they lie in `geometry`, with what they and `plan`,
// which is theirs, remember of earlier events, to a tolerance of 1e-5 or that of the scene, whichever is
// looser. Heights are those of every second node, or interpolated where the cells are odd. Costs 1/4 + 1/16
// of the press, in time and in transforms of the finest grid. Throws what a press throws, and
// Error{bad_value} naming `estimate` where there are too few cells; a coarser grid that misses its tolerance
// counts with the best it reached.
std::shared_ptr<const CoarserSolutions> solve_coarser(const Scene& scene, const ContactGeometry& geometry,
                                                      const Plan& plan, const PressRequest& request,
                                                      Monitor& monitor = Monitor::silent());

// Throws Error{bad_value} naming `estimate` where the tile has too few cells for it.
void check_estimate(const Grid& grid);

// Adds to the plan of a press what the estimate takes.
void plan_estimate(const ContactGeometry& geometry, Plan& plan);

struct DiscretisationEstimate {
  double value = 0;  // as the state has it
  // Estimated magnitude, in the unit of the quantity: 0 of what was prescribed, infinite where the value
  // grows from grid to grid without end, as the peak pressure at the rim of a cut body does.
  double error = 0;
  double extrapolated = 0;  // the value with the error taken off where its sign is known: area, approach, …
  double margin = 1;        // times the error: above the true error in 19 of 20 scenes
  double relative() const;  // error / |value|; infinite for an error of a value of zero
};

// Names as a state has them: area_fraction, corrected_area_fraction, area, approach, …
std::span<const std::string> estimated_quantities();
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
