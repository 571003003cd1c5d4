// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/contact/elastic_bodies.hpp"
#include "engine/contact/elasticity/half_space/adhesive_solver.hpp"
#include "engine/contact/elasticity/half_space/half_space_solver.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier_lane_filter.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Transform count of a pressure-controlled press from boundary and aspect hy/hx alone: medians of random
// scenes.
double typical_transforms(Boundary boundary, double aspect) {
  constexpr double of_periodic = 40, of_free = 60;
  constexpr double longer_than_wide = 4, times_on_long_cells = 2.2;
  const double square = boundary == Boundary::periodic ? of_periodic : of_free;
  return std::max(aspect, 1 / aspect) >= longer_than_wide ? times_on_long_cells * square : square;
}

}  // namespace

void plan_half_space(const ContactGeometry& geometry, Plan& plan) {
  HalfSpaceOperator half_space;
  half_space.modulus = contact_modulus(geometry, "the half-space needs `young` and `poisson`", "", "");
  half_space.lower_share = lower_elastic_share(geometry);
  plan.elasticity = half_space;

  const bool periodic = geometry.boundary() == Boundary::periodic;
  const bool single = plan.accuracy.precision == Accuracy::Precision::single;
  plan.solver = "preconditioned descent on nested grids";
  if (single) plan.solver += ", transforms in single precision";
  plan.terms.push_back({"elasticity", "half-space, E* " +
                                          format_quantity(half_space.modulus, dimension::pressure) +
                                          (periodic ? ", Fourier multiplier 2/(E*|q|)"
                                                    : ", Love kernel on a tile padded to twice its sides")});
  const Grid& grid = geometry.grid();
  const auto nodes = static_cast<double>(grid.nodes());
  const auto grids = [&](double count) { return static_cast<std::int64_t>(count * nodes * sizeof(double)); };
  plan.buffers.push_back({"pressures and gaps of each state", grids(2)});
  // Free tiles are padded, and periodic ones with odd sides or large prime factors.
  const bool padded = !periodic || !FourierLaneFilter<double>::possible(grid.nx, grid.ny);
  plan.buffers.push_back({"work of the solver", grids(padded ? 11 : single ? 7.5 : 8), false});
  // Measured; matters on small and narrow tiles.
  constexpr std::int64_t always = 300'000;
  constexpr std::int64_t per_row = 512;
  plan.buffers.push_back(
      {"rows and threads at work", always + per_row * (grid.nx + grid.ny) * (padded ? 2 : 1), false, false});
  // The last two answers and the next start of a flattening search.
  plan.bytes_to_flatten = grids(7.5);
  const double aspect = grid.hy() / grid.hx();
  if (keeps_line_loads(aspect)) {
    const bool along_lines = LineExtension::serves(aspect, geometry.boundary());
    plan.buffers.push_back({"lines of cells much longer than wide", grids(along_lines ? 3.5 : 1), false});
  }
  if (geometry.overhangs())
    plan.buffers.push_back({"heights, those that nothing faces out of reach", grids(1), false});
  plan.transforms = typical_transforms(geometry.boundary(), aspect);
  // Two threads: 3 ms per transform of a million nodes, 430 ms of 67 million.
  constexpr double seconds_per_node = 4e-9;
  plan.seconds = plan.transforms * seconds_per_node * nodes * (periodic ? 1 : 2.5);
}

std::shared_ptr<const Solver> half_space_solver(const Plan& plan,
                                                std::shared_ptr<const ContactGeometry> geometry) {
  const auto& half_space = std::get<HalfSpaceOperator>(plan.elasticity);
  if (plan.attracts()) return std::make_shared<const AdhesiveSolver>(plan, half_space, std::move(geometry));
  return std::make_shared<const HalfSpaceSolver>(plan, half_space, std::move(geometry));
}

const ElasticModel& half_space_model() {
  static const ElasticModel record{
      .name = "half_space",
      .noun = "a half-space",
      .called = "half-space",
      .sentence = "elastic half-spaces, on which every pressure moves every node",
      .moves_every_node = true,
      .defaults = HalfSpaceOptions{},
      .options = {},
      .boundary =
          "a half-space needs `boundary`: \"periodic\" where the tile goes on beyond its rim, or \"free\"",
      .over_ranks = true,
      .plan = [](const std::any&, const ContactGeometry& geometry,
                 Plan& plan) { plan_half_space(geometry, plan); },
      .solver = half_space_solver};
  return record;
}
const ElasticModel& HalfSpaceOptions::model() { return half_space_model(); }

}  // namespace asperity
