// SPDX-License-Identifier: GPL-3.0-or-later
// The effects of a contact that is pulled sideways: `interlocking`, `ageing` and `tangential`. None of
// them changes the normal contact or costs a press anything; a state carries their options to whoever
// asks it for friction (friction/) or for partial slip. One that is not a member is not computed.
#pragma once

#include <optional>

namespace asperity {

// The slopes of two rough bodies add to the angle of friction of their junctions (friction/interlocking.hpp).
struct InterlockingOptions {
  // rad, counter-clockwise from x seen from above the lower body: the way the upper body is pushed over it.
  double direction = 0;
};

// Junctions strengthen as they rest: τ0(t) = τ0 (1 + rate ln(1 + t/onset)), the logarithmic growth of static
// friction with the time of stationary contact (Dieterich 1972, Rabinowicz 1951).
struct AgeingOptions {
  double rate = 0;   // >= 0, per unit of ln(1 + t/onset)
  double onset = 0;  // s, > 0
};
// τ0(t)/τ0 after a rest of t >= 0 s; 1 without a rest.
double strengthening(const AgeingOptions& ageing, std::optional<double> rest);

// Partial slip under a shear force below the one that slides (friction/partial_slip.hpp).
struct TangentialOptions {
  // Tangential over normal compliance, > 0; by default Mindlin's for half-spaces, none for boxes.
  std::optional<double> compliance_ratio;
};

struct SlidingEffects {
  std::optional<InterlockingOptions> interlocking{};
  std::optional<AgeingOptions> ageing{};
  std::optional<TangentialOptions> tangential{};
};

// Throws Error{bad_value} naming the option out of range.
void check(const SlidingEffects& effects);

}  // namespace asperity
