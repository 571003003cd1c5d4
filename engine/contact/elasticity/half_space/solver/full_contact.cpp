// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/full_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string full_contact_metres(double length) { return format_quantity(length, dimension::length); }

}  // namespace

bool faces(const HalfSpaceProblem& problem, std::size_t k) {
  return !problem.overhangs || !std::isnan((*problem.heights)[k]);
}

double approach_of_full_contact(const HalfSpaceProblem& problem) {
  return known_range(problem.heights->values()).max - known_mean(problem.heights->values());
}

// Past full contact only ground that hardens gives way, and pressures so large that beside them no double
// holds those of the heights are none.
void check_approach_within_full_contact(const HalfSpaceProblem& problem, double approach) {
  if (problem.boundary != Boundary::periodic) return;
  const auto heights = problem.heights->values();
  const Range span = range(heights);
  const YieldLaw& law = problem.yield;
  const double full = approach_of_full_contact(problem), uniform = uniform_compliance(problem);
  if (uniform > 0) {
    // More load goes on compressing a layer, as far as it is borne.
    const double most = span.span() + uniform * law.cap;
    if (!law.caps() || approach < most) return;
    throw Error(ErrorCode::infeasible,
                "an approach of " + full_contact_metres(approach) +
                    " cannot be reached: all of this tile is at its hardness at " +
                    full_contact_metres(most) + ", and carries no more",
                "ask for a smaller `approach`, or press by `pressure`");
  }
  if (law.hardens()) {
    constexpr double hidden = 1e12;
    const double needed = law.hardening * (approach - full);
    const double held = hidden * problem.modulus * std::max(problem.rms, approach) / problem.grid.hx();
    if (needed <= held || approach <= full) return;
    throw Error(ErrorCode::infeasible,
                "an approach of " + full_contact_metres(approach) +
                    " cannot be reached: this periodic tile is in full contact at " +
                    full_contact_metres(full) + ", and past it `hardening` would take a mean pressure of " +
                    format_quantity(needed, dimension::pressure),
                "ask for a smaller `approach`, or give a smaller `hardening`");
  }
  const double most = law.caps() ? span.span() : full;
  if (approach >= most)
    throw Error(ErrorCode::infeasible,
                "an approach of " + full_contact_metres(approach) +
                    " cannot be reached: this periodic tile is in full contact at " +
                    full_contact_metres(most) + ", and more load brings it no nearer",
                "ask for a smaller `approach`, or press by `pressure`");
}

std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  if (!problem.yield.caps() ||
      answer.yielded != static_cast<std::int64_t>(known_count(problem.heights->values())))
    return {};
  const auto least = over_nodes<0, 1>(answer.gap.size(), [&](std::size_t k, double* v) {
    v[0] = faces(problem, k) ? -answer.gap[k] : infinity;
  });
  return answer.approach - least[0];
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
  constexpr double a_little_more = 1 + 1e-12;
  const double pressure = -ends.min * a_little_more * unit;
  const YieldLaw& law = problem.yield;
  const double most = law.yield ? range(law.yield->values()).min : law.cap;
  if (law.limits() && !(pressure + ends.max * unit < most)) return {};
  return pressure > 0 && std::isfinite(pressure) ? std::optional(pressure) : std::nullopt;
}

HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor) {
  HalfSpaceAnswer answer = solve_at_pressure(problem, mean_pressure, nullptr, monitor);
  answer.certificate.load = std::max(answer.certificate.load, missed);
  return answer;
}

HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what) {
  if (const auto most = most_at_the_cap(problem, answer))
    throw Error(ErrorCode::infeasible,
                what + " is not reached: all of the " + (problem.overhangs ? "overlap" : "tile") +
                    " is at its hardness at " + full_contact_metres(*most) + ", and no more can be had",
                "ask for less, or press by `pressure`");
  if (answer.converged || problem.best_effort) return answer;
  throw Error(ErrorCode::not_converged,
              what + " was sought to a residual of " + format_short(answer.certificate.worst(), 3) +
                  " where `tolerance` asks for " + format_short(problem.tolerance, 3) + ", in " +
                  std::to_string(answer.iterations) + " applications of the half-space",
              unconverged_hint(problem.grid));
}

}  // namespace asperity
