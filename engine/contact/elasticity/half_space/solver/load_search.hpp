// SPDX-License-Identifier: GPL-3.0-or-later
// The load that brings a contact to what is prescribed of it, an approach or a flattening: a bracketed secant
// in the load whose solves are only as exact as the error that is left asks for, and begin from what the
// solves before found. And what both controls make of the answer in the end.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"

namespace asperity {

// Loads on either side of the one that is sought, and what was measured under them, as a search in the
// approach has met them.
struct LoadsMet {
  // An error so many times what a residual may leave is of the side that it seems to be of.
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
  // Where what is wanted is measured on the straight line of pressures and gaps through two answers: how
  // often their difference past the second. None where that cannot be told. If it is given, two answers are
  // kept, and solves begin on the line through them.
  std::function<std::optional<double>(const HalfSpaceAnswer& last, const HalfSpaceAnswer& before)>
      on_the_line{};
  double wanted = 0;  // > 0, of the measure
  // Of the measure, however much the load; under the cap on all nodes it comes to that.
  double most = std::numeric_limits<double>::infinity();
  double length = 0;  // m: an error of so much in a gap is about all that is wanted
  // A load, Pa, under which more is known to be measured, and how much.
  BracketedSecant::Point above = {BracketedSecant::unknown, BracketedSecant::unknown};
  LoadsMet met{};
  // Another way to what is wanted, from what was found under a load, of about so many applications: gone once
  // where many have gone into loads, and once more before the search ends in vain. Where it did not converge
  // either, what it ended with is gone on from.
  std::function<HalfSpaceAnswer(HalfSpaceAnswer found, int most_applications)> other_way{};
};

// `begun`: what was found on the way, from whose pressures and mean pressure the search begins if they are
// any good; or a mean pressure alone. Does not throw for lack of convergence.
HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor);

// Where all nodes that something faces are at the cap: the greatest approach that is theirs, m, the last of
// them just touching.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// The contact under the least load of full contact, or where rounding hides it there under at most twice a
// load at which it still does. `missed`: of what was prescribed, relative to it.
HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor);

// The answer if it converged or the best will do. Throws Error{infeasible} where all nodes are at the cap and
// {not_converged} otherwise; `what` was prescribed.
HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what);

}  // namespace asperity
