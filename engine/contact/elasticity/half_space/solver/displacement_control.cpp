// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/elasticity/half_space/solver/load_search.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

double approach_of_full_contact(const HalfSpaceProblem& problem) {
  return known_range(problem.heights->values()).max - known_mean(problem.heights->values());
}

std::optional<double> pressure_of_full_contact(const HalfSpaceProblem& problem) {
  if (problem.boundary != Boundary::periodic) return {};
  const Grid& grid = problem.grid;
  const Field& h = *problem.heights;
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, problem.weight,
                                 false, multiplier_of(problem));
  Array<double> p(h.size());
  const double middle = mean(h.values()), unit = problem.modulus * (problem.rms / grid.hx());
  for_nodes(h.size(), [&](std::size_t k) { p[k] = (h[k] - middle) / problem.rms; });
  compliance.apply_inverse(p, p);
  const Range ends = range(p);
  const double pressure = -ends.min * (1 + a_little) * unit;
  const YieldLaw& law = problem.yield;
  const double most = law.yield ? range(law.yield->values()).min : law.cap;
  if (law.limits() && !(pressure + ends.max * unit < most)) return {};
  return pressure > 0 && std::isfinite(pressure) ? std::optional(pressure) : std::nullopt;
}

namespace {

// Rejects pressures whose rounding hides the heights.
void check_approach(const HalfSpaceProblem& problem, double approach) {
  if (approach < least_relative * std::max(problem.grid.size_x, problem.grid.size_y))
    refuse("`approach` is " + format_short(approach) +
               " m, less than 1e-280 of the tile: its pressures are too small for doubles",
           "give a larger approach, or 0");
  if (problem.boundary != Boundary::periodic) return;
  const auto heights = problem.heights->values();
  const Range span = range(heights);
  const YieldLaw& law = problem.yield;
  const double full = approach_of_full_contact(problem), uniform = uniform_compliance(problem);
  if (uniform > 0) {
    // A layer goes further, up to its hardness.
    const double most = span.span() + uniform * law.cap;
    if (!law.caps() || approach < most) return;
    refuse_infeasible("an approach of " + metres(approach) +
                          " cannot be reached: the whole tile is at its hardness at " + metres(most),
                      "give a smaller `approach`, or press by `pressure`");
  }
  if (law.hardens()) {
    constexpr double greatest_ratio = 1e12;
    const double needed = law.hardening * (approach - full);
    const double held =
        greatest_ratio * problem.modulus * std::max(problem.rms, approach) / problem.grid.hx();
    if (needed <= held || approach <= full) return;
    refuse_infeasible("an approach of " + metres(approach) +
                          " cannot be reached: this periodic tile is in full contact at " + metres(full) +
                          ", and more would need a mean pressure of " +
                          format_quantity(needed, dimension::pressure),
                      "give a smaller `approach`, or a smaller `hardening`");
  }
  const double most = law.caps() ? span.span() : full;
  if (approach >= most)
    refuse_infeasible("an approach of " + metres(approach) +
                          " cannot be reached: this periodic tile is in full contact at " + metres(most),
                      "give a smaller `approach`, or press by `pressure`");
}

// Beyond full contact a layer is linear. Empty below full contact, with yield, on a half-space.
std::optional<double> pressure_past_full_contact(const HalfSpaceProblem& problem, double approach) {
  const double uniform = uniform_compliance(problem);
  const double compression = approach - approach_of_full_contact(problem);
  if (!(uniform > 0 && compression > 0) || problem.yield.limits()) return {};
  const double pressure = compression / uniform;
  if (!(known_range(problem.heights->values()).span() > 0)) return pressure;
  const auto full = pressure_of_full_contact(problem);
  return full && pressure >= *full ? std::optional(pressure) : std::nullopt;
}
}  // namespace

HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor) {
  if (!(approach >= 0) || !std::isfinite(approach))
    refuse("`approach` is " + metres(approach),
           "give a finite length from zero up, measured from first touch");
  if (approach == 0) return solve_at_pressure(problem, 0, nullptr, monitor);
  check_approach(problem, approach);
  if (const auto pressure = pressure_past_full_contact(problem, approach)) {
    HalfSpaceAnswer answer = solve_at_pressure(problem, *pressure, nullptr, monitor);
    answer.approach = approach;  // exact up to rounding
    return answer;
  }
  // Full contact up to rounding: all loads from the least on.
  const double full = approach_of_full_contact(problem);
  const double apart = std::abs(approach - full) / std::min(full, problem.rms);
  const bool rough = known_range(problem.heights->values()).span() > 0;
  if (problem.boundary == Boundary::periodic && uniform_compliance(problem) == 0 && rough &&
      apart <= 0.5 * problem.tolerance)
    if (const auto pressure = pressure_of_full_contact(problem))
      return solve_at_full_contact(problem, *pressure, std::abs(full / approach - 1), monitor);
  const bool long_cells = keeps_line_loads(problem.grid.hy() / problem.grid.hx());
  SoughtByLoad sought;
  sought.measure = [](const HalfSpaceAnswer& found) { return found.approach; };
  sought.wanted = sought.length = approach;
  const auto bound_by_full_contact = [&] {
    if (!(sought.above.at < infinity) && approach < full && uniform_compliance(problem) == 0)
      if (const auto pressure = pressure_of_full_contact(problem)) sought.above = {*pressure, full};
  };
  HalfSpaceAnswer answer;
  // Near full contact on long cells descents at the approach mostly stall: search the load first. Not with
  // most nodes at the cap, unless just past full contact.
  constexpr double nearly = 0.9, just_past = 1.02, begin_at = 0.35, well_below = 0.5;
  const bool past = approach > full && approach < just_past * full;
  if (problem.boundary == Boundary::periodic && long_cells && !problem.yield.hardens() &&
      approach > nearly * full && uniform_compliance(problem) == 0)
    if (const auto load = load_of_all(problem); load && (past || *load < well_below * problem.yield.cap)) {
      bound_by_full_contact();
      answer.mean_pressure =
          (approach < full ? begin_at : 1) * std::min(*load, well_below * problem.yield.cap);
      answer = solve_by_load(problem, sought, std::move(answer), monitor);
      if (answer.converged) return answer;
    }
  const auto descend = [&](ChainEffort effort) {
    const int so_far = answer.iterations;
    answer = solve_at_offset(problem, approach, infinity, nullptr, effort, monitor);
    answer.iterations += so_far;
  };
  descend(long_cells ? ChainEffort::less : ChainEffort::full);
  if (!answer.converged) {
    bound_by_full_contact();
    answer = solve_by_load(problem, sought, std::move(answer), monitor);
  }
  if (!answer.converged && long_cells) descend(ChainEffort::full);
  return met(problem, std::move(answer), "an approach of " + metres(approach));
}

}  // namespace asperity
