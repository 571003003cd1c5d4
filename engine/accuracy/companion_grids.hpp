// SPDX-License-Identifier: GPL-3.0-or-later
// A press solved once more on other cells of its tile, of the same bodies as they lie: on half and a quarter
// of the cells, or on thrice as many a side. The estimate of the error of the grid is in
// discretisation_error.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/contact/plan.hpp"
#include "engine/contact/press_request.hpp"
#include "engine/contact/scene.hpp"
#include "engine/contact/solver.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// The same press on companion grids than that of a state: on one or two coarser ones, the finer first, or on
// one finer grid.
class CompanionGrids {
 public:
  struct Level {
    State state;
    double ratio = 2;  // width of a cell over that of the next finer grid; below 1 of a finer grid
  };
  CompanionGrids(const PressRequest& request, std::vector<Level> levels)
      : request_(request), levels_(std::move(levels)) {}

  const PressRequest& request() const { return request_; }
  std::span<const Level> levels() const { return levels_; }
  bool finer() const { return levels_.front().ratio < 1; }

 private:
  PressRequest request_;
  std::vector<Level> levels_;
};

// The grids that a press on `grid` is compared with: half the cells a side and a quarter, where 8 cells are
// left along x or y; a side of fewer than 16 keeps its cells. Odd cells are halved upwards.
std::vector<Grid> coarser_grids(const Grid& grid);

// `request` pressed from the pressures of the same press on coarser cells, if there is one and it is near
// enough to save transforms; as without it otherwise. Within the tolerance the answer is the same.
State press_from_coarser(const Solver& solver, const State* coarser, const PressRequest& request,
                         Monitor& monitor);

// Solves `request` on coarser grids for the bodies as they lie in `geometry`, with what they and `plan`,
// which is theirs, remember of earlier events, to a tolerance of 1e-5 or that of the scene, whichever is
// looser. Heights are those of every second node, or interpolated where the cells are odd. On cells that were
// chosen for an error each begins from the coarser one before it, as in the choice. Costs 1/4 + 1/16 of the
// press, in time and in transforms of the finest grid. Throws what a press throws, and Error{bad_value}
// naming `estimate` where there are too few cells; a coarser grid that misses its tolerance counts with the
// best it reached.
std::shared_ptr<const CompanionGrids> solve_coarser(const Scene& scene, const ContactGeometry& geometry,
                                                    const Plan& plan, const PressRequest& request,
                                                    Monitor& monitor = Monitor::silent());

// The same on thrice the cells a side (finer_heights.hpp), to a tolerance of 1e-6 or that of the scene,
// whichever is looser. Costs nine to twelve times the press; throws what finer_grid throws.
std::shared_ptr<const CompanionGrids> solve_finer(const Scene& scene, const ContactGeometry& geometry,
                                                  const Plan& plan, const PressRequest& request,
                                                  Monitor& monitor = Monitor::silent());

// Memory that a state's solution keeps, and those of the same press on companion grids.
std::int64_t bytes_held_with_other_grids(const State& state);

// The same on `grid`, of these combined heights, missing (NaN) where nothing faces the lower body; to a
// tolerance of `tolerance` or that of the scene, whichever is looser, or as well as can be; begun from
// `coarser`, if it is not null, as press_from_coarser does. Transforms are counted in those of the finest
// grid of `geometry`, by the state in those of `grid`.
State press_on(const Grid& grid, Field heights, double tolerance, const Scene& scene,
               const ContactGeometry& geometry, const Plan& plan, const PressRequest& request,
               Monitor& monitor = Monitor::silent(), const State* coarser = nullptr);

// Throws Error{bad_value} naming `estimate` where the tile has too few cells for it.
void check_estimate(const Grid& grid);

// The work of an estimate, over that of the press alone.
double estimate_work(const ContactGeometry& geometry, const Accuracy& accuracy);
// Of one transform of a grid, in any unit: n log n.
double transform_work(const Grid& grid);

// Adds the cost of the requested estimate to the plan of a press.
void plan_estimate(const ContactGeometry& geometry, Plan& plan);
// make_plan with that added.
Plan plan_with_estimate(const Scene& scene, const ContactGeometry& geometry);

}  // namespace asperity
