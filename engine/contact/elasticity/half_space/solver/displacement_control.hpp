// SPDX-License-Identifier: GPL-3.0-or-later
// Contact at a prescribed approach or flattening. At an approach the problem is convex without a load
// constraint (offset_descent.cpp); if this descent stalls, for example on long cells, the load is searched
// (load_search.hpp). A flattening (flattening.cpp) is searched in the approach or, near full contact, in the
// load. The certificate's load entry is the relative error of the prescribed quantity. A periodic half-space
// is in full elastic contact at the approach max h − mean h; the least load is one exact filter, p =
// (E*|q|/2) h. A layer is compressed further, by K(0) p̄. Without hardening the limit is the cap on all
// nodes.
#pragma once

#include <optional>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// approach in m from first touch, >= 0. Throws as solve_at_pressure, and Error{infeasible} if no load
// reaches it: beyond full contact of a periodic half-space (max h − mean h without yield; with hardening, at
// pressures that hide all heights in rounding), or with every node at the cap.
HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor);

// `fraction`: share of the peak-to-valley of h pressed away, 0 … 1: 1 − span(h − u − w)/span(h), w the
// plastic displacement. At 1 the load is the least load of full contact; slightly more, as `solver` reports,
// if a large hardness lets rounding hide full contact; with hardening or on a free tile, any sufficient
// load.
HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor);

// The flattened share of an answer; 0 for flat heights. O(n), or one application of K if the approach is
// below 1e-4 of the heights.
double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// max h − mean h, m, without the compression of a layer.
double approach_of_full_contact(const HalfSpaceProblem& problem);

// Least mean pressure [Pa] of full contact of a periodic tile without yield; empty if there is none. One
// application.
std::optional<double> pressure_of_full_contact(const HalfSpaceProblem& problem);

// A load [Pa] that flattens a periodic tile completely, ignoring a cap: the load of elastic full contact or,
// with hardening, the least load at which all nodes yield if that is smaller, (K + 1/K_h) p = h + Y/K_h + δ.
// On a free tile an estimate without the rims. Empty if there is no such load. One or two applications.
std::optional<double> load_of_all(const HalfSpaceProblem& problem);

}  // namespace asperity
