// SPDX-License-Identifier: GPL-3.0-or-later
// A contact pressed by how much it flattens, the share of the peak-to-valley of h that is pressed away. That
// never falls as the approach or the load grows: a bracketed secant in the approach, each solve starting from
// the line through the two before, or near full contact of a periodic tile in the load (load_search.hpp);
// begun where a coarser grid ends. The certificate's load entry is the relative error of the share.
#pragma once

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// The share of the peak-to-valley of h pressed away, 0 … 1: 1 − span(h − u − w)/span(h), w what yielded.
HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor);

// That share for an answer; 0 for flat heights. One application of K where the approach is less than a
// ten-thousandth of the heights, and O(n) elsewhere.
double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

}  // namespace asperity
