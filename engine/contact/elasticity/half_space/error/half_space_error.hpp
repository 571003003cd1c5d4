// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds on the distance of pressures p from the exact solution p* of the same discrete contact: minimise
// E = ½ p·Kp − h·p (+ Σ φ(p)) over 0 <= p <= H. With the gap g = Kp − h − δ (+ φ'), split as g = r + s with
// s >= 0 where p is above 0 and s <= 0 where it is below H, the condition that p* is least gives, d = p − p*,
//   ‖d‖²_K <= r·d + Σ p s⁺ + Σ (H − p) s⁻,   r·d <= ‖r‖_{K⁻¹} ‖d‖_K,
// so that ‖d‖_K is bounded by one application of K⁻¹ to r, the projected residual; the duality gap bounds it
// too. Every other bound follows from ‖d‖_K, from E(p) − E(p*) <= ½‖r‖² + Σ…, and from the approach, which is
// the slope of a convex function of the load and so lies between its difference quotients.
#pragma once

#include "engine/contact/algebraic_error.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// What the exact solution shares with the answer.
enum class Prescribed {
  load,       // its mean pressure
  approach,   // an approach that was asked for
  flattening  // the load that was found: none is known
};

// What the bounds are about.
struct Reported {
  Prescribed prescribed = Prescribed::load;
  double asked_approach = 0;  // m, of Prescribed::approach
  double mean_gap = 0;        // m
  double energy = 0;          // J
  double plastic_volume = 0;  // m³
};

// K(0) of a layer takes part where the approach was asked for; under a load it is known and left out.
// A fresh application of K, one of K⁻¹ and, where ground yields or the approach was asked for, a few more;
// holds five fields besides the operator. Under a prescribed approach the load is bounded through
// Σ d <= ‖f‖_{K⁻¹}‖d‖_K, f any field that is 1 wherever either solution may touch: no sharper than the
// stiffness of that set times the error of the approach.
SolutionError half_space_error(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer,
                               const Reported& reported);

}  // namespace asperity
