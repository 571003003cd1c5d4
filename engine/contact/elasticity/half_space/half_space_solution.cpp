// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_solution.hpp"

#include <array>
#include <numbers>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"

namespace asperity {

namespace {
// The error of Σx is its square.
constexpr double residual_reduction = 1e-5;
constexpr int most_solver_steps = 400;

std::array<double, 2> mark_yielding(const YieldLaw& law, const HalfSpaceAnswer& answer,
                                    Array<std::uint8_t>& elastic, Array<std::uint8_t>& yields) {
  const double cap = law.caps() ? law.cap : std::numeric_limits<double>::infinity();
  return over_nodes<2>(elastic.size(), [&](std::size_t k, double* v) {
    const double p = answer.pressure[k];
    const bool past = law.hardens() && p > law.yields_at(k);
    elastic[k] = p > 0 && p < cap && !past ? 1 : 0;
    if (law.hardens()) yields[k] = past ? 1 : 0;
    v[0] = elastic[k];
    v[1] = past ? 1.0 : 0.0;
  });
}

// Stiffness of the longest wave over `nodes`, in cell units.
double stiffness_of_wave(const ComplianceMultiplier& multiplier, double nodes) {
  return multiplier.shares() ? 1 / multiplier.greatest_from(2 * std::numbers::pi / nodes)
                             : std::numbers::pi / nodes;
}
}  // namespace

double contact_stiffness(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, Monitor& monitor) {
  const Grid& grid = problem.grid;
  const std::size_t nodes = grid.nodes();
  const YieldLaw& law = problem.yield;
  // 1/K_h in cell units, where K(q) = 2/|q|.
  const double give = law.hardens() ? problem.modulus / law.hardening / grid.hx() : 0;
  Array<std::uint8_t> elastic(nodes), yields(law.hardens() ? nodes : 0);
  const auto counts = mark_yielding(law, answer, elastic, yields);
  const double free = counts[0] + counts[1], n = static_cast<double>(nodes);
  if (free == 0) return 0;
  // K(0) of a layer, in series with the rest of K.
  const double uniform = uniform_compliance(problem);
  if (problem.boundary == Boundary::periodic && counts[0] == n)
    return uniform > 0 ? 1 / uniform : std::numeric_limits<double>::infinity();
  const auto in = [&](std::size_t k) { return elastic[k] || (!yields.empty() && yields[k]); };

  const double aspect = grid.hy() / grid.hx(), longest = std::max<double>(grid.nx, grid.ny);
  const ComplianceMultiplier multiplier = multiplier_of(problem);
  HalfSpaceCompliance compliance(grid.nx, grid.ny, aspect, problem.boundary, 1, false, multiplier);
  ContactPreconditioner preconditioner(grid.nx, grid.ny, aspect, problem.boundary, 1, 4, multiplier);
  preconditioner.set_free(elastic);
  // The pyramid ignores constants; the longest wave approximates them.
  const double constant = stiffness_of_wave(multiplier, longest) / std::max(counts[0], 1.0);
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
    const double beta = old_rz > 0 ? rz / old_rz : 0;
    old_rz = rz;
    for_nodes(nodes, [&](std::size_t k) { d[k] = z[k] + beta * d[k]; });
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

HalfSpaceSolution::HalfSpaceSolution(PlacedContact contact, HalfSpaceProblem problem, HalfSpaceAnswer answer,
                                     double attraction, std::vector<double> preload)
    : Solution(std::move(contact), {.load = answer.mean_pressure * problem.grid.area(),
                                    .pressure = answer.mean_pressure,
                                    .approach = answer.approach,
                                    .peak_pressure = answer.peak_pressure,
                                    .contacts = answer.contacts,
                                    .yielded = answer.yielded,
                                    .iterations = answer.iterations,
                                    .solver = answer.solver,
                                    .attraction = attraction,
                                    .preload = std::move(preload)}),
      problem_(std::move(problem)),
      at_(std::move(answer)) {}

double HalfSpaceSolution::stiffness() const {
  return at_.contacts > 0 ? contact_stiffness(problem_, at_, Monitor::silent()) : 0.0;
}

double HalfSpaceSolution::mean_gap() const {
  return sum([&](std::size_t k) { return faces(k) ? std::max(0.0, at_.gap[k]) : 0.0; }) /
         static_cast<double>(geometry().facing());
}

PressureSplit HalfSpaceSolution::split(double threshold) const {
  PressureSplit result;
  for (const double p : at_.pressure.values())
    if (p > 0) ++(p >= threshold ? result.above : result.below);
  result.sum_below = sum([&](std::size_t k) {
    const double p = at_.pressure[k];
    return p > 0 && p < threshold ? p : 0.0;
  });
  return result;
}

Field HalfSpaceSolution::gap_field() const {
  return field([&](std::size_t k) { return at_.pressure[k] > 0 ? 0.0 : std::max(0.0, at_.gap[k]); });
}

Field HalfSpaceSolution::displacement_field() const {
  Field u = field([&](std::size_t k) { return displacement(k); });
  if (!problem_.overhangs) return u;
  // Nodes without a counterpart move with the rest.
  const Field all = plan().elasticity->apply(moving_pressures(), problem_.grid, problem_.boundary);
  for (std::size_t k = 0; k < u.size(); ++k)
    if (!faces(k)) u[k] = all[k];
  return u;
}

}  // namespace asperity
