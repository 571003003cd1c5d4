// SPDX-License-Identifier: GPL-3.0-or-later
// A contact under displacement control: pressed by its approach, or by how much it flattens. At a given
// approach the problem is convex without a load to keep, and is solved as such (offset_descent.cpp): no load
// is sought, which soft ground hardly lets tell approaches apart. Where that descent does not end, as on some
// cells much longer than wide, the load is sought after all (load_search.hpp). A flattening (flattening.cpp)
// is sought in the approach, begun where a coarser grid ends, or near full contact in the load. The
// certificate's load entry is the relative error of what was prescribed. All of a periodic half-space
// touches, elastically, at an approach of max h − mean h, for nothing but the mean of the heights is left to
// move; the least load that brings it there follows from one exact filter, p = (E*|q|/2) h. A layer goes on
// being compressed, by K(0) p̄. Ground that does not harden comes to an end where every node is at its cap.
#pragma once

#include <optional>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// approach in m from first touch, >= 0. Besides what solve_at_pressure throws: Error{infeasible} where no
// load gives it: past full contact of a periodic half-space (max h − mean h without yield; where it hardens,
// once the pressure would hide all heights), or where every node is at the cap.
HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor);

// The share of the peak-to-valley of h pressed away, 0 … 1: 1 − span(h − u − w)/span(h), w what yielded. All
// of it: under the least load of full contact, or little more where a hardness far above it lets rounding
// hide full contact, as `solver` says then; where ground hardens or a tile is free, under one that is enough.
HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor);

// That share for an answer; 0 for flat heights. One application of K where the approach is less than a
// ten-thousandth of the heights, and O(n) elsewhere.
double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// max h − mean h, m, what K(0) of a layer adds left out.
double approach_of_full_contact(const HalfSpaceProblem& problem);

// The least mean pressure, Pa, under which all of a periodic tile touches and nothing yields. None where
// there is no such pressure. One application.
std::optional<double> pressure_of_full_contact(const HalfSpaceProblem& problem);

// A load, Pa, that presses all of the height of a periodic tile away: the least that makes all nodes yield
// where ground hardens, by one exact filter, (K + 1/K_h) p = h + Y/K_h + δ; or that of full contact without
// yield, which pressures that yield on the peaks only bring about the sooner. On a free tile about the same
// without its rims. Whatever a cap limits. None where that is no load. One application or two.
std::optional<double> load_of_all(const HalfSpaceProblem& problem);

}  // namespace asperity
