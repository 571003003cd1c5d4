// SPDX-License-Identifier: GPL-3.0-or-later
// Static friction of a contact: sum over its junctions of τ = min(τ0 + α P, τ_max), eq. (1) of Hanaor, Gan &
// Einav (2013). All junctions slide at once. P includes the load of an attraction across the gap; μ refers
// to the applied load alone. Without a cap T = τ0 A + α F for any contact. Reads the effects `ageing` and
// `interlocking`.
#pragma once

#include <optional>
#include <string>

#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/state.hpp"

namespace asperity {

struct FrictionOptions {
  double tau0 = 0;                         // Pa, >= 0
  double alpha = 0;                        // >= 0
  std::optional<double> tau_max{};         // Pa, > 0; infinite: no cap
  std::optional<double> yield_pressure{};  // Pa, > 0: τ_max = τ0 + α P_y; not together with tau_max
};

struct FrictionResult {
  double force = 0;            // N on the tile
  std::optional<double> mu;    // force / applied load; none without load
  double adhesive_force = 0;   // N, from τ0 (or from a lower cap)
  double load_force = 0;       // N, from the pressure
  double capped_fraction = 0;  // share of the contact area; 0 without contact
  // N, relative to level junctions; none without `interlocking`.
  std::optional<double> interlocking_force{};
  // τ0 after the rest over τ0; none without `ageing`.
  std::optional<double> strengthening{};
};

// Throws Error{bad_value} for a negative or non-finite rest, {bad_state} without `ageing`.
void check_rest(std::optional<double> rest, const Effects& effects);
// τ0 after the rest over τ0; 1 without ageing.
double strengthening(const Effects& effects, std::optional<double> rest);

class JunctionLaw {
 public:
  // Throws Error{bad_value} naming the key.
  explicit JunctionLaw(const FrictionOptions& options);

  double tau0() const { return tau0_; }
  double alpha() const { return alpha_; }
  // Pa; none without cap.
  std::optional<double> tau_max() const { return tau_max_; }

  // Pa, at P >= 0.
  double strength(double pressure) const;
  // O(n) if some junction reaches the cap, else O(1). `rest`: s >= 0 under load. Throws Error{bad_state} for
  // a rest without `ageing`, and as interlock().
  FrictionResult on(const State& state, std::optional<double> rest = {}) const;
  // "tau = min(1 MPa + 0.2 P, 3 MPa)".
  std::string text() const;

 private:
  FrictionResult fresh(const State& state) const;
  double tau0_, alpha_;
  std::optional<double> tau_max_;
};

// Interlocking: an inclined junction also resists by its slope, a along the push d (positive: upward) and c
// across. With the vertical load P per projected area, normal stress s and shear t in the plane along d,
//   vertical    s − a q t = P      q = sqrt(1 + c²/(1 + a²)), the area factor of the slope across
//   horizontal  T = a s + q t = a P + (1 + a²) q t
// T is the greatest for t <= τ0 + α s, t <= τ_max, s >= 0. Without a cap t = (τ0 + α P)/(1 − a q α); with τ0
// = c = 0 T = P tan(φ + b), tan φ = α, tan b = a (Patton 1966). Level junctions: T = τ0 + α P. For
// a q α >= 1 a junction locks unless capped. On a steep descent (τ0 |a| q > P) shear alone carries the load
// without tension: t = P/(|a| q). T < 0 if the junction slides by itself.
//
// Slopes: central differences midway between the loaded bodies. Nodes keep the load of the normal problem.
// Σ a P, the change of elastic energy, is zero on average over placements; the remaining extra force grows
// with α and the mean square slope.
struct InclinedJunction {
  double force = 0;     // T, Pa of projected area
  bool capped = false;  // t is τ_max
  bool locks = false;   // no cap; `force` is infinite
};
// P >= 0; slopes finite.
InclinedJunction inclined_junction(const JunctionLaw& law, double pressure, double along, double across);

struct InterlockedJunctions {
  double extra_force = 0;      // N on the tile, relative to level junctions; may be negative
  double capped_fraction = 0;  // share of the contact area; 0 without contact
};
// Over contact nodes; O(n), three temporary fields. Throws Error{bad_state} naming `tau_max` if junctions
// lock.
InterlockedJunctions interlock(const JunctionLaw& law, const State& state,
                               const InterlockingOptions& options);

// Midway between the bodies; one-sided at a free rim, 0 along a single node.
struct Slopes {
  Field x, y;
};
Slopes junction_slopes(const State& state);

}  // namespace asperity
