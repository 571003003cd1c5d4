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

// Loads on both sides of the target, found by a search in the approach.
struct LoadsMet {
  // Error, in units of the residual's effect, whose side is certain.
  static constexpr double certain = 10;
  struct Met : BracketedSecant::Point {
    bool certainly = false;
  };
  std::optional<Met> below, above;

  void take(Met found, double wanted) {
    if (found.value < wanted && (!below || found.at > below->at)) below = found;
    if (found.value > wanted && (!above || found.at < above->at)) above = found;
  }
};

struct SoughtByLoad {
  // Never falls as the load grows.
  std::function<double(const HalfSpaceAnswer&)> measure;
  // Multiple of the difference from `before` to `last` at which their line has the wanted measure; empty if
  // unknown. If set, solves start on this line.
  std::function<std::optional<double>(const HalfSpaceAnswer& last, const HalfSpaceAnswer& before)>
      on_the_line{};
  double wanted = 0;  // > 0, of the measure
  // Limit of the measure at any load.
  double most = std::numeric_limits<double>::infinity();
  double length = 0;  // m: gap error as large as the measure
  // A load [Pa] known to be too large, and its measure.
  BracketedSecant::Point above = {BracketedSecant::unknown, BracketedSecant::unknown};
  LoadsMet met{};
  // Alternative search from an answer, called after many applications and before failure. If this fails too,
  // the search continues from its last iterate.
  std::function<HalfSpaceAnswer(HalfSpaceAnswer found, int most_applications)> other_way{};
};

// `begun`: pressures with their mean, or a mean pressure alone. Does not throw if the search fails.
HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor);

// Greatest approach [m] with all nodes at the cap; empty if some node is not.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// Contact under the least load of full contact or, if rounding hides full contact, under more: at most twice
// a load that fails. `missed`: relative error of the prescribed quantity.
HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor);

// The answer if converged or best_effort. Throws Error{infeasible} if all nodes are at the cap, else
// {not_converged}. `what`: the prescribed quantity.
HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what);

}  // namespace asperity
