// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"

#include <algorithm>

#include "engine/contact/elasticity/half_space/half_space_solver.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier_lane_filter.hpp"

namespace asperity {

namespace {

// Medians of random scenes under pressure control; aspect hy/hx.
double typical_transforms(Boundary boundary, double aspect) {
  constexpr double of_periodic = 40, of_free = 60;
  constexpr double longer_than_wide = 4, times_on_long_cells = 2.2;
  const double square = boundary == Boundary::periodic ? of_periodic : of_free;
  return std::max(aspect, 1 / aspect) >= longer_than_wide ? times_on_long_cells * square : square;
}

std::shared_ptr<const ElasticOperator> make_half_space(const std::any&, const ContactGeometry& geometry) {
  auto half_space = std::make_shared<HalfSpaceOperator>(HalfSpaceOptions::model(), geometry);
  half_space->sentence =
      "half-space, E* " + format_quantity(half_space->modulus, dimension::pressure) +
      (geometry.boundary() == Boundary::periodic ? ", Fourier multiplier 2/(E*|q|)"
                                                 : ", Love kernel on a tile padded to twice its sides");
  return half_space;
}

}  // namespace

HalfSpaceOperator::HalfSpaceOperator(const ElasticModel& of, const ContactGeometry& geometry)
    : ElasticOperator(of) {
  modulus = contact_modulus(geometry, "the half-space needs `young` and `poisson`", "", "");
  lower_share = lower_elastic_share(geometry);
}

double HalfSpaceOperator::multiplier(double q) const {
  return 2 / (modulus * q) * (share ? share->share(q * share->length) : 1);
}

double HalfSpaceOperator::compliance_of_mean() const {
  return share ? share->length * share->uniform / modulus : 0;
}

HalfSpaceCompliance HalfSpaceOperator::in_cells_of(const Grid& grid, Boundary boundary,
                                                   bool with_mean) const {
  return {grid.nx,
          grid.ny,
          grid.hy() / grid.hx(),
          boundary,
          1,
          false,
          share ? in_cells(*share, grid.hx(), with_mean) : ComplianceMultiplier{}};
}

Field HalfSpaceOperator::apply(const Field& pressure, const Grid& grid, Boundary boundary) const {
  Field u(grid.nx, grid.ny);
  in_cells_of(grid, boundary, true).apply(pressure.values(), u.values());
  const double length = grid.hx() / modulus;  // per pressure in cell units
  for (double& value : u.values()) value *= length;
  return u;
}

Field HalfSpaceOperator::inverse(const Field& displacement, const Grid& grid) const {
  Field pressure(grid.nx, grid.ny);
  in_cells_of(grid, Boundary::periodic, false).apply_inverse(displacement.values(), pressure.values());
  for (double& p : pressure.values()) p *= modulus / grid.hx();
  return pressure;
}

void HalfSpaceOperator::plan(const ContactGeometry& geometry, Plan& plan) const {
  const bool periodic = geometry.boundary() == Boundary::periodic;
  const bool single = plan.accuracy.precision == Accuracy::Precision::single;
  plan.solver = "preconditioned descent on nested grids";
  if (single) plan.solver += ", transforms in single precision";
  const Grid& grid = geometry.grid();
  const auto nodes = static_cast<double>(grid.nodes());
  const auto grids = [&](double count) { return static_cast<std::int64_t>(count * nodes * sizeof(double)); };
  plan.buffers.push_back({"pressures and gaps of each state", grids(2)});
  // Padded: free tiles, and periodic ones with odd sides or large prime factors.
  const bool padded = !periodic || !FourierLaneFilter<double>::possible(grid.nx, grid.ny);
  plan.buffers.push_back({"work of the solver", grids(padded ? 11 : single ? 7.5 : 8), false});
  // Measured; matters on small and narrow tiles.
  constexpr std::int64_t always = 300'000;
  constexpr std::int64_t per_row = 512;
  plan.buffers.push_back(
      {"rows and threads at work", always + per_row * (grid.nx + grid.ny) * (padded ? 2 : 1), false, false});
  // Two answers and the next start of a flattening search.
  plan.bytes_to_flatten = grids(7.5);
  const double aspect = grid.hy() / grid.hx();
  if (keeps_line_loads(aspect)) {
    const bool along_lines = LineExtension::serves(aspect, geometry.boundary());
    plan.buffers.push_back({"lines of cells much longer than wide", grids(along_lines ? 3.5 : 1), false});
  }
  if (geometry.overhangs())
    plan.buffers.push_back({"heights, those that nothing faces out of reach", grids(1), false});
  plan.transforms = typical_transforms(geometry.boundary(), aspect);
  // Two threads: 3 ms per transform of a million nodes.
  constexpr double seconds_per_node = 4e-9;
  plan.seconds = plan.transforms * seconds_per_node * nodes * (periodic ? 1 : 2.5);
  if (!share) return;
  // A thin layer hardly coarsens the preconditioner's grid.
  const auto preconditioner = [&](const ComplianceMultiplier& multiplier) {
    return HalfOrderPyramid::bytes(grid.nx, grid.ny, aspect, Boundary::periodic, multiplier);
  };
  const std::int64_t more = preconditioner(in_cells(*share, grid.hx(), false)) - preconditioner({});
  if (more > 0) plan.buffers.push_back({"waves that feel the base", more, false});
}

std::shared_ptr<const Solver> HalfSpaceOperator::solver(
    const Plan& plan, std::shared_ptr<const ContactGeometry> geometry) const {
  return plan.attracts() ? make_adhesive_solver(plan, std::move(geometry))
                         : make_half_space_solver(plan, std::move(geometry));
}

const ElasticModel& HalfSpaceOptions::model() {
  static const ElasticModel record{
      .name = "half_space",
      .noun = "a half-space",
      .called = "half-space",
      .sentence = "elastic half-spaces, on which every pressure moves every node",
      .defaults = HalfSpaceOptions{},
      .options = {},
      .boundary =
          "a half-space needs `boundary`: \"periodic\" where the tile goes on beyond its rim, or \"free\"",
      .over_ranks = true,
      .attraction = true,
      .make = make_half_space};
  return record;
}

}  // namespace asperity
