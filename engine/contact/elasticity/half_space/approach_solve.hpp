// SPDX-License-Identifier: GPL-3.0-or-later
// A contact pressed by its approach or by how much it flattens. At a given approach the problem is convex
// without a load to keep, and is solved as such (offset_descent.hpp): no load is sought, which soft ground
// hardly lets tell approaches apart. How much flattens never falls as the approach grows: a bracketed secant
// in the approach, each solve starting from the line through the two before. Where a descent does not end, as
// on some cells much longer than wide, the load is sought after all. The certificate's load entry is the
// relative error of what was prescribed.
#pragma once

#include "engine/contact/elasticity/half_space/half_space_solve.hpp"

namespace asperity {

// approach in m from first touch, >= 0. Besides what solve_at_pressure throws: Error{infeasible} where no
// load gives it: past full contact of a periodic tile (max h − mean h without yield; where it hardens, once
// the pressure would hide all heights), or where every node is at the cap.
HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor);

// The share of the peak-to-valley of h pressed away, 0 … 1: 1 − span(h − u − w)/span(h), w what yielded.
HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor);

// That share for an answer; 0 for flat heights. One application of K where the approach is less than a
// ten-thousandth of the heights, and O(n) elsewhere.
double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

}  // namespace asperity
