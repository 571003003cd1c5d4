// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the load of a prescribed approach or flattening: a bracketed secant with inexact solves, each
// started from earlier pressures. Also the last checks of both displacement controls.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"

namespace asperity {

// Loads below and above the target and their measures, found by a search in the approach.
struct LoadsMet {
  // An error this many times the residual's effect is on its side for certain.
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
  // Steps from the second answer, in units of their difference, at which the line through two answers has
  // the wanted measure; empty if unknown. If set, the search stores two answers and starts solves on their
  // line.
  std::function<std::optional<double>(const HalfSpaceAnswer& last, const HalfSpaceAnswer& before)>
      on_the_line{};
  double wanted = 0;  // > 0, of the measure
  // Upper limit of the measure at any load; reached under the cap on all nodes.
  double most = std::numeric_limits<double>::infinity();
  double length = 0;  // m: a gap error of this length is about the whole measure
  // A load [Pa] known to be too large and its measure.
  BracketedSecant::Point above = {BracketedSecant::unknown, BracketedSecant::unknown};
  LoadsMet met{};
  // Alternative search from the answer under a load, with about `most_applications`. Called once after many
  // applications and again before failure. If this fails too, the search continues from its last iterate.
  std::function<HalfSpaceAnswer(HalfSpaceAnswer found, int most_applications)> other_way{};
};

// `begun`: start pressures with their mean pressure, or a mean pressure alone. Does not throw if the search
// fails.
HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor);

// If all nodes with a counterpart are at the cap: the greatest approach at which they are, m.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// Contact under the least load of full contact; if rounding hides full contact there, under at most twice
// the least load that passes. `missed`: relative error of the prescribed quantity.
HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor);

// Returns the answer if it converged or best_effort is set. Throws Error{infeasible} if all nodes are at the
// cap, else {not_converged}; `what` names the prescribed quantity.
HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what);

}  // namespace asperity
