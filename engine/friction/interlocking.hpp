// SPDX-License-Identifier: GPL-3.0-or-later
// Interlocking: an inclined junction also resists sliding by its slope. The upper body is pushed along d;
// the slope is a along d (positive: upward) and c across. With the vertical load P per projected area,
// normal stress s and shear t of the junction in the vertical plane along d,
//   vertical    s − a q t = P      q = sqrt(1 + c²/(1 + a²)), the area factor of the slope across
//   horizontal  T = a s + q t = a P + (1 + a²) q t
// T is the greatest for t <= τ0 + α s, t <= τ_max, s >= 0. Without a cap t = (τ0 + α P)/(1 − a q α); with τ0
// = c = 0 T = P tan(φ + b), tan φ = α, tan b = a (Patton 1966). A level junction has T = τ0 + α P. A
// junction with a q α >= 1 locks unless capped. On a steep descent (τ0 |a| q > P) shear alone carries the
// load: no tension, so t = P/(|a| q). T < 0 if the junction slides by itself.
//
// Slopes: central differences of the surface midway between the loaded bodies. Each node keeps its load of
// the normal problem. The sum of a P is the change of elastic energy, zero on average over placements; the
// remaining extra force grows with α and the mean square slope.
#pragma once

#include "engine/contact/effects/interlocking.hpp"
#include "engine/friction/junction_law.hpp"

namespace asperity {

struct InclinedJunction {
  double force = 0;     // T, Pa of projected area
  bool capped = false;  // t is τ_max
  bool locks = false;   // no cap; `force` is infinite
};
// P >= 0; slopes finite.
InclinedJunction inclined_junction(const JunctionLaw& law, double pressure, double along, double across);

struct InterlockedJunctions {
  double extra_force = 0;      // N on the tile, relative to level junctions; may be negative
  double capped_fraction = 0;  // share of the contact area at the cap; 0 without contact
};
// Sums over contact nodes; O(n), three temporary fields. Throws Error{bad_state} naming `tau_max` if
// junctions lock.
InterlockedJunctions interlock(const JunctionLaw& law, const State& state,
                               const InterlockingOptions& options);

// Slopes of the surface midway between the bodies; one-sided at a free rim, 0 along a side of one node.
struct Slopes {
  Field x, y;
};
Slopes junction_slopes(const State& state);

}  // namespace asperity
