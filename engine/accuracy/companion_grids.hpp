// SPDX-License-Identifier: GPL-3.0-or-later
// A press solved again on half and a quarter of the cells per side, or on three times as many, for
// discretisation_error.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/contact/plan.hpp"
#include "engine/contact/scene/press_request.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/contact/solver.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// One or two coarser grids (finer first) or one finer grid.
class CompanionGrids {
 public:
  struct Level {
    State state;
    double ratio = 2;  // of cell widths to the next finer grid; below 1: finer
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

// Half and a quarter of the cells per side, at least 8; sides below 16 cells stay. Odd numbers round up.
std::vector<Grid> coarser_grids(const Grid& grid);

// From a coarser grid if this saves transforms; equal within the tolerance.
State press_from_coarser(const Solver& solver, const State* coarser, const PressRequest& request,
                         Monitor& monitor);

// Coarser grids with the history in `geometry` and `plan`, to 1e-5 or the looser tolerance of the scene.
// Samples every second node; interpolates for odd cells. For a requested error, each grid starts from the
// coarser one. Costs 1/4 + 1/16 of the press. Throws errors of a press, and Error{bad_value} naming
// `estimate` for too few cells.
std::shared_ptr<const CompanionGrids> solve_coarser(const Scene& scene, const ContactGeometry& geometry,
                                                    const Plan& plan, const PressRequest& request,
                                                    Monitor& monitor = Monitor::silent());

// Three times the cells per side (finer_heights.hpp), to 1e-6 or the looser tolerance of the scene. Costs
// nine to twelve presses; throws errors of finer_grid.
std::shared_ptr<const CompanionGrids> solve_finer(const Scene& scene, const ContactGeometry& geometry,
                                                  const Plan& plan, const PressRequest& request,
                                                  Monitor& monitor = Monitor::silent());

// Including companion grids.
std::int64_t bytes_held_with_other_grids(const State& state);

// The press on `grid` with combined `heights`, NaN without an opposite surface, to the looser of `tolerance`
// and the scene's tolerance, or the best reached; `coarser` may be null. The cost counts transforms of the
// grid of `geometry`, the state those of `grid`.
State press_on(const Grid& grid, Field heights, double tolerance, const Scene& scene,
               const ContactGeometry& geometry, const Plan& plan, const PressRequest& request,
               Monitor& monitor = Monitor::silent(), const State* coarser = nullptr);

// Throws Error{bad_value} naming `estimate` for too few cells.
void check_estimate(const Grid& grid);

// Relative to the press.
double estimate_work(const ContactGeometry& geometry, const Accuracy& accuracy);
// n log n.
double transform_work(const Grid& grid);

void plan_estimate(const ContactGeometry& geometry, Plan& plan);
// make_plan plus plan_estimate.
Plan plan_with_estimate(const Scene& scene, const ContactGeometry& geometry);

// `plan` with transforms, time and sentence of this press, from a trial on up to about 128² nodes: transforms
// hardly depend on the nodes. Leaves cost counters, laws and contacts unchanged. Throws as check(request).
Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request);

}  // namespace asperity
