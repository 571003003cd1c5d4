// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds on the distance d = p − p* to the exact solution p* of the same discrete contact, the minimum of
// E = ½ p·Kp − h·p (+ Σ φ(p)) over 0 <= p <= H. Split the gap g = Kp − h − δ (+ φ') = r + s with s >= 0
// where p > 0 and s <= 0 where p < H. Then
//   ‖d‖²_K <= r·d + Σ p s⁺ + Σ (H − p) s⁻,   r·d <= ‖r‖_{K⁻¹} ‖d‖_K,
// so one application of K⁻¹ bounds ‖d‖_K; the duality gap is a second bound. The other bounds follow from
// ‖d‖_K, from E(p) − E(p*) <= ½‖r‖² + Σ…, and from the approach, the slope of a convex function of the load.
#pragma once

#include "engine/contact/certificate.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

enum class Prescribed {
  load,       // the mean pressure
  approach,   // the requested approach
  flattening  // the load found; its error is unknown
};

struct Reported {
  Prescribed prescribed = Prescribed::load;
  double asked_approach = 0;  // m
  double mean_gap = 0;        // m
  double energy = 0;          // J
  double plastic_volume = 0;  // m³
};

// Costs an application of K, one of K⁻¹ and, with yield or a prescribed approach, a few more; five fields.
// Under an approach Σ d <= ‖f‖_{K⁻¹}‖d‖_K bounds the load, for any f = 1 on both contacts; K(0) of a layer
// enters only there.
SolutionError half_space_error(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer,
                               const Reported& reported);

}  // namespace asperity
