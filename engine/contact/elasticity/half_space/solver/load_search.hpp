// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the load of a prescribed approach or flattening: a bracketed secant with inexact solves, each
// started from earlier pressures. Also the last checks of both controls.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"

namespace asperity {

// Shared by the searches in the load and in the approach.
namespace search_rules {

inline constexpr int most_solves = 60;
inline constexpr double good_start = 0.1;  // certificate of a warm start
inline constexpr double near_start = 0.3;  // relative change of load or approach for a warm start
inline constexpr double least_tolerance = 1e-13;
inline constexpr double near_enough_share = 0.9;  // of the tolerance, for the sought quantity
inline constexpr double much_tighter = 0.01;      // factor of a tolerance that chose the wrong side
// Gap error: complementarity averages over the load; penetration ignores open nodes. Seen: 20.
inline constexpr double gap_per_residual = 20;

// Beyond full contact measures are constant: within a tenth of the limit a value misleads the secant.
inline bool nearly_all(double found, double wanted, double most) {
  return found > wanted && most - found < 0.1 * (most - wanted);
}

}  // namespace search_rules

// On both sides of the target, from a search in the approach.
struct LoadsMet {
  std::optional<BracketedSecant::Point> below, above;

  void take(BracketedSecant::Point found, double wanted) {
    if (found.value < wanted && (!below || found.at > below->at)) below = found;
    if (found.value > wanted && (!above || found.at < above->at)) above = found;
  }
};

struct SoughtByLoad {
  // Never falls as the load grows.
  std::function<double(const HalfSpaceAnswer&)> measure;
  // Gaps determine the measure: their error can be much larger than the tolerance.
  bool of_gaps = false;
  double wanted = 0;  // > 0, of the measure
  // Limit of the measure at any load.
  double most = std::numeric_limits<double>::infinity();
  double length = 0;  // m: gap error as large as the measure
  // A load [Pa] certainly too large, and its measure.
  BracketedSecant::Point above = {BracketedSecant::unknown, BracketedSecant::unknown};
  LoadsMet met{};
};

// `begun`: pressures, or a mean pressure alone. Failure does not throw.
HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor);

// Greatest approach [m] with all nodes at the cap, or empty.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// Contact under the least load of full contact or, if rounding hides it, more: at most twice a failing load.
// `missed`: relative error of the prescribed quantity.
HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor);

// `answer` if converged or best_effort. Throws Error{infeasible} with all nodes at the cap, else
// {not_converged}. `what`: the prescribed quantity.
HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what);

}  // namespace asperity
