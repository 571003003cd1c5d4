// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"

namespace asperity {

namespace {
// Σx, the result, is in error by the square of this.
constexpr double residual_reduction = 1e-5;
constexpr int most_solver_steps = 400;
}  // namespace

double contact_stiffness(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, Monitor& monitor) {
  const Grid& grid = problem.grid;
  const std::size_t nodes = grid.nodes();
  const YieldLaw& law = problem.yield;
  const double cap = law.caps() ? law.cap : std::numeric_limits<double>::infinity();
  // 1/K_h in cell units, where u = K p with K(q) = 2/|q|.
  const double give = law.hardens() ? problem.modulus / law.hardening / grid.hx() : 0;

  Array<std::uint8_t> elastic(nodes), yields(law.hardens() ? nodes : 0);
  const auto counts = over_nodes<2>(nodes, [&](std::size_t k, double* v) {
    const double p = answer.pressure[k];
    const bool past = law.hardens() && p > law.yields_at(k);
    elastic[k] = p > 0 && p < cap && !past ? 1 : 0;
    if (law.hardens()) yields[k] = past ? 1 : 0;
    v[0] = elastic[k];
    v[1] = past ? 1.0 : 0.0;
  });
  const double free = counts[0] + counts[1], n = static_cast<double>(nodes);
  if (free == 0) return 0;
  // K(0) of a layer is in series with what the rest of K gives.
  const double uniform = uniform_compliance(problem);
  if (problem.boundary == Boundary::periodic && counts[0] == n)
    return uniform > 0 ? 1 / uniform : std::numeric_limits<double>::infinity();
  const auto in = [&](std::size_t k) { return elastic[k] || (!yields.empty() && yields[k]); };

  const double aspect = grid.hy() / grid.hx(), longest = std::max<double>(grid.nx, grid.ny);
  const ComplianceMultiplier multiplier = multiplier_of(problem);
  HalfSpaceCompliance compliance(grid.nx, grid.ny, aspect, problem.boundary, 1, false, multiplier);
  ContactPreconditioner preconditioner(grid.nx, grid.ny, aspect, problem.boundary, 1, 4, multiplier);
  preconditioner.set_free(elastic);
  // The pyramid sees nothing of a constant; the longest wave does for it.
  const double of_longest = multiplier.shares() ? 1 / multiplier.greatest_from(2 * std::numbers::pi / longest)
                                                : std::numbers::pi / longest;
  const double constant = of_longest / std::max(counts[0], 1.0);
  const double yielded_factor = 1 / (give + 4 / std::numbers::pi);

  Array<double> x(nodes), r(nodes), z(nodes), d(nodes), image(nodes);
  for_nodes(nodes, [&](std::size_t k) { r[k] = in(k) ? 1.0 : 0.0; });
  double squares = free, old_rz = 0;
  Task task(monitor, "stiffness", most_solver_steps);
  for (int step = 0; step < most_solver_steps && squares > residual_reduction * residual_reduction * free;
       ++step) {
    task.advance();
    preconditioner.apply(r, z);
    const double level =
        constant * over_nodes<1>(nodes, [&](std::size_t k, double* v) { v[0] = elastic[k] ? r[k] : 0.0; })[0];
    const double rz = over_nodes<1>(nodes, [&](std::size_t k, double* v) {
      if (elastic[k])
        z[k] += level;
      else
        z[k] = in(k) ? yielded_factor * r[k] : 0.0;
      v[0] = r[k] * z[k];
    })[0];
    const double keep = old_rz > 0 ? rz / old_rz : 0;
    old_rz = rz;
    for_nodes(nodes, [&](std::size_t k) { d[k] = z[k] + keep * d[k]; });
    compliance.apply(d, image);
    const double curvature = over_nodes<1>(nodes, [&](std::size_t k, double* v) {
      if (!yields.empty() && yields[k]) image[k] += give * d[k];
      v[0] = d[k] * image[k];
    })[0];
    if (!(curvature > 0) || !(rz > 0)) break;
    const double length = rz / curvature;
    squares = over_nodes<1>(nodes, [&](std::size_t k, double* v) {
      x[k] += length * d[k];
      if (in(k)) r[k] -= length * image[k];
      v[0] = r[k] * r[k];
    })[0];
  }
  const double sum = over_nodes<1>(nodes, [&](std::size_t k, double* v) { v[0] = x[k]; })[0];
  const double stiffness = sum / n * (problem.modulus / grid.hx());
  return uniform > 0 ? stiffness / (1 + uniform * stiffness) : stiffness;
}

}  // namespace asperity
