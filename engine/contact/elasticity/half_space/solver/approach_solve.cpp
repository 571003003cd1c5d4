// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/approach_solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/full_contact.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/elasticity/half_space/solver/load_search.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {
// The mean pressure that brings a layer to an approach past full contact, in which it is linear there; none
// short of that, where anything may yield, and on a half-space.
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
    throw Error(ErrorCode::bad_value, "`approach` is " + metres(approach),
                "an approach is finite and not negative, measured from first touch");
  if (approach == 0) return solve_at_pressure(problem, 0, nullptr, monitor);
  if (approach < 1e-280 * std::max(problem.grid.size_x, problem.grid.size_y))
    throw Error(ErrorCode::bad_value,
                "`approach` is " + format_short(approach) +
                    " m, less than 1e-280 of the tile: no double holds the pressures it takes",
                "give a larger approach, or none");
  check_approach_within_full_contact(problem, approach);
  if (const auto pressure = pressure_past_full_contact(problem, approach)) {
    HalfSpaceAnswer answer = solve_at_pressure(problem, *pressure, nullptr, monitor);
    answer.approach = approach;  // but for rounding
    return answer;
  }
  // Within rounding of full contact: any load from the least on has this approach.
  const double full = approach_of_full_contact(problem);
  const double apart = std::abs(approach - full) / std::min(full, problem.rms);
  const bool rough = known_range(problem.heights->values()).span() > 0;
  if (problem.boundary == Boundary::periodic && uniform_compliance(problem) == 0 && rough &&
      apart <= 0.5 * problem.tolerance)
    if (const auto pressure = pressure_of_full_contact(problem))
      return solve_at_full_contact(problem, *pressure, std::abs(full / approach - 1), monitor);
  HalfSpaceAnswer answer = solve_at_offset(problem, approach, infinity, nullptr, true, monitor);
  if (!answer.converged) {
    SoughtByLoad sought;
    sought.measure = [](const HalfSpaceAnswer& found) { return found.approach; };
    sought.wanted = sought.length = approach;
    answer = solve_by_load(problem, sought, std::move(answer), monitor);
  }
  return met(problem, std::move(answer), "an approach of " + metres(approach));
}

}  // namespace asperity
