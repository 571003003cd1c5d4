// SPDX-License-Identifier: GPL-3.0-or-later
// Static friction of a contact as the sum over its junctions of τ = min(τ0 + α P, τ_max), eq. (1) of the
// source paper (Hanaor, Gan & Einav 2013): an adhesive strength, a part in proportion to the local
// pressure, and a cap. The force is the one at which everything slides at once; partial slip and the
// history of sliding are not part of it. P is the pressure that a junction carries, so what an attraction
// across the gap adds to the load rubs too, while μ is over the applied load alone. Without a cap T = τ0 A +
// α F exactly, whatever the contact. Two effects of the scene are read here: `ageing` lets τ0 grow with a
// rest, `interlocking` adds what the slopes of the junctions resist.
#pragma once

#include <optional>
#include <string>

#include "engine/contact/state.hpp"

namespace asperity {

struct FrictionOptions {
  double tau0 = 0;                         // Pa, >= 0
  double alpha = 0;                        // >= 0
  std::optional<double> tau_max{};         // Pa, > 0; infinite means never
  std::optional<double> yield_pressure{};  // Pa, > 0: τ_max = τ0 + α P_y; not together with tau_max
};

struct FrictionResult {
  double force = 0;            // N on the tile
  std::optional<double> mu;    // force / applied load; none without load
  double adhesive_force = 0;   // N, the part of τ0 (or of the cap where that is lower)
  double load_force = 0;       // N, the part that comes with pressure
  double capped_fraction = 0;  // share of the real contact area at the cap; 0 without contact
  // N, beyond the same junctions lying level; none without the effect `interlocking`.
  std::optional<double> interlocking_force{};
  // τ0 after the rest over τ0 without one; none without the effect `ageing`.
  std::optional<double> strengthening{};
};

// Throws Error{bad_value} for a rest that is negative or not finite, and Error{bad_state} for one without
// the effect `ageing`.
void check_rest(std::optional<double> rest, const Effects& effects);
// τ0 after the rest over τ0 without one; 1 where junctions do not age.
double strengthening(const Effects& effects, std::optional<double> rest);

class JunctionLaw {
 public:
  // Throws Error{bad_value} naming the key.
  explicit JunctionLaw(const FrictionOptions& options);

  double tau0() const { return tau0_; }
  double alpha() const { return alpha_; }
  // Pa; none when there is no cap.
  std::optional<double> tau_max() const { return tau_max_; }

  // Strength at a pressure P >= 0, Pa.
  double strength(double pressure) const;
  // O(1) where no junction reaches the cap; otherwise the junctions below it are summed, and with
  // `interlocking` all of them. `rest`: s >= 0 that the junctions stood still under the load. Throws
  // Error{bad_state} for a rest without the effect `ageing`, and what interlock() throws.
  FrictionResult on(const State& state, std::optional<double> rest = {}) const;
  // The same law after a rest: τ0 strengthened, the cap as it was.
  JunctionLaw rested(double strengthening) const;
  // "tau = min(1 MPa + 0.2 P, 3 MPa)".
  std::string text() const;

 private:
  FrictionResult fresh(const State& state) const;
  double tau0_, alpha_;
  std::optional<double> tau_max_;
};

}  // namespace asperity
