// SPDX-License-Identifier: GPL-3.0-or-later
// Interlocking: a junction that is inclined resists sliding with its slope too. The upper body is pushed
// along d and leaves along the junction. There the slope is a along d (positive: it must climb) and c across;
// the normal problem gives the vertical load P of a unit of projected area, and with s the stress normal to
// the junction and t the shear on it, in the upright plane along d,
//   vertical    s − a q t = P      q = sqrt(1 + c²/(1 + a²)), what the slope across adds to the area
//   horizontal  T = a s + q t = a P + (1 + a²) q t
// T is the greatest that the law allows: t as large as t <= τ0 + α s, t <= τ_max and s >= 0 leave it. So
// without a cap t = (τ0 + α P)/(1 − a q α), and with τ0 = c = 0 it is T = P tan(φ + b), with tan φ = α and
// tan b = a: the slope adds to the angle of friction (Patton 1966). A level junction has T = τ0 + α P. A
// junction with a q α >= 1 locks: only a cap gives way. On a steep way down (τ0 |a| q > P) shear alone would
// carry the load; the junction pulls nothing, so t = P/(|a| q). T is negative where it would slide by itself.
//
// Slopes are central differences of the surface midway between the bodies as they lie on each other under the
// load: where they touch the junction itself, the mean of both bodies' slopes where they part. Each node
// keeps the load of the normal problem: the push does not shift it from slope to slope. The sum of a P is
// what the elastic energy gains on the way: of either sign, and nothing on average over placements; what is
// left then grows with α and the mean square of the slopes.
#pragma once

#include "engine/contact/effects/interlocking.hpp"
#include "engine/friction/junction_law.hpp"

namespace asperity {

struct InclinedJunction {
  double force = 0;     // T, Pa of projected area
  bool capped = false;  // t is τ_max
  bool locks = false;   // no force moves it: the law has no cap; `force` is infinite
};
// P >= 0; slopes finite.
InclinedJunction inclined_junction(const JunctionLaw& law, double pressure, double along, double across);

struct InterlockedJunctions {
  double extra_force = 0;      // N on the tile, beyond the same junctions lying level; may be negative
  double capped_fraction = 0;  // share of the contact area at the cap; 0 without contact
};
// The sum over the nodes in contact; O(n), three fields for a moment. Throws Error{bad_state} that names
// `tau_max` where junctions lock.
InterlockedJunctions interlock(const JunctionLaw& law, const State& state,
                               const InterlockingOptions& options);

// The slopes of the surface between the bodies; one-sided at the rim of a free tile, 0 along a side of one
// node.
struct Slopes {
  Field x, y;
};
Slopes junction_slopes(const State& state);

}  // namespace asperity
