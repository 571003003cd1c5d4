// SPDX-License-Identifier: GPL-3.0-or-later
// A contact pressed by its approach. At a given approach the problem is convex without a load to keep, and is
// solved as such (offset_descent.cpp): no load is sought, which soft ground hardly lets tell approaches
// apart. Where that descent does not end, as on some cells much longer than wide, the load is sought after
// all (load_search.hpp). The certificate's load entry is the relative error of what was prescribed.
#pragma once

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// approach in m from first touch, >= 0. Besides what solve_at_pressure throws: Error{infeasible} where no
// load gives it: past full contact of a periodic half-space (max h − mean h without yield; where it hardens,
// once the pressure would hide all heights), or where every node is at the cap.
HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor);

}  // namespace asperity
