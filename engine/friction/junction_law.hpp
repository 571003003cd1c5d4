// SPDX-License-Identifier: GPL-3.0-or-later
// Static friction of a contact: sum over its junctions of τ = min(τ0 + α P, τ_max), eq. (1) of Hanaor, Gan &
// Einav (2013). All junctions slide at once. P includes the load of an attraction across the gap; μ refers
// to the applied load alone. Without a cap T = τ0 A + α F for any contact. Reads the effects `ageing` and
// `interlocking`.
#pragma once

#include <optional>
#include <string>

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
  double capped_fraction = 0;  // share of the real contact area at the cap; 0 without contact
  // N, relative to level junctions; none without `interlocking`.
  std::optional<double> interlocking_force{};
  // τ0 after the rest over τ0; none without `ageing`.
  std::optional<double> strengthening{};
};

// Throws Error{bad_value} for a negative or non-finite rest, Error{bad_state} for a rest without `ageing`.
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
  // O(1) if no junction reaches the cap; otherwise O(n). `rest`: s >= 0 under load. Throws Error{bad_state}
  // for a rest without `ageing`, and as interlock().
  FrictionResult on(const State& state, std::optional<double> rest = {}) const;
  // τ0 strengthened, the cap unchanged.
  JunctionLaw rested(double strengthening) const;
  // "tau = min(1 MPa + 0.2 P, 3 MPa)".
  std::string text() const;

 private:
  FrictionResult fresh(const State& state) const;
  double tau0_, alpha_;
  std::optional<double> tau_max_;
};

}  // namespace asperity
