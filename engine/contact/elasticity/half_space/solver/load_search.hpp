// SPDX-License-Identifier: GPL-3.0-or-later
// The load that brings a contact to what is prescribed of it, its approach or how much it flattens: a
// bracketed secant in the load, whose solves are only as exact as the error that is left asks for and begin
// from the pressures of the one before (an inexact Newton method, Dembo, Eisenstat and Steihaug, SIAM J.
// Numer. Anal. 19, 1982). Near full contact of a periodic tile this is the well-posed way: there the deepest
// gap goes as a power below one of what the approach lacks, and above one of what the load does.
#pragma once

#include <functional>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"

namespace asperity {

struct SoughtByLoad {
  // Never falls as the load grows.
  std::function<double(const HalfSpaceAnswer&)> measure;
  double wanted = 0;  // > 0, of the measure
  double length = 0;  // m: an error of so much in a gap is about all that is wanted
  // A load, Pa, under which more is known to be measured, and how much.
  BracketedSecant::Point above = {BracketedSecant::unknown, BracketedSecant::unknown};
};

// `begun`: what was found on the way, from whose pressures and mean pressure the search begins if they are
// any good; or a mean pressure alone. The certificate's load entry is the relative error of the measure. Does
// not throw for lack of convergence.
HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor);

}  // namespace asperity
