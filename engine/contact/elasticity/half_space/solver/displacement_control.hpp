// SPDX-License-Identifier: GPL-3.0-or-later
// Contact at a prescribed approach (offset_descent.cpp) or flattening (flattening.cpp), if these stall by a
// search of the load (load_search.hpp). The certificate's load entry is the relative error of the prescribed
// quantity. Periodic half-space: full elastic contact at the approach max h − mean h; the least load is one
// exact filter, p = (E*|q|/2) h. A layer is compressed further, by K(0) p̄. A cap on all nodes ends the
// range.
#pragma once

#include <optional>

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// approach in m from first touch, >= 0. Throws as solve_at_pressure, and Error{infeasible} with every node at
// the cap or beyond periodic full contact: max h − mean h without yield; with hardening, where rounding hides
// the heights.
HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor);

// `fraction`: share of the peak-to-valley pressed away, 0 … 1: 1 − span(h − u − w)/span(h). At 1: the least
// load of full contact (slightly more, as `solver` reports, if a large hardness hides it in rounding). With
// hardening or on a free tile: any sufficient load.
HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor);

// 0 for flat heights. O(n), or one application for approaches below 1e-4 of the heights.
double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer);

// max h − mean h, m; without a layer's compression.
double approach_of_full_contact(const HalfSpaceProblem& problem);

// Least mean pressure [Pa] of periodic full contact without yield, or empty. One application.
std::optional<double> pressure_of_full_contact(const HalfSpaceProblem& problem);

// A load [Pa] that flattens a periodic tile completely, ignoring a cap: elastic full contact or, if smaller,
// the least load with yield at all nodes, (K + 1/K_h) p = h + Y/K_h + δ. Estimated on a free tile. Empty if
// none. One or two applications.
std::optional<double> load_of_all(const HalfSpaceProblem& problem);

}  // namespace asperity
