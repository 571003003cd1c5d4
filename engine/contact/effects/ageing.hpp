// SPDX-License-Identifier: GPL-3.0-or-later
// Ageing: junctions strengthen at rest, τ0(t) = τ0 (1 + rate ln(1 + t/onset)) (Dieterich 1972, Rabinowicz
// 1951). Used by friction only.
#pragma once

#include "engine/contact/scene/effect.hpp"

namespace asperity {

struct AgeingOptions {
  double rate = 0;   // >= 0, per unit of ln(1 + t/onset)
  double onset = 0;  // s, > 0
  static const Effect& effect();
};

// τ0(t)/τ0 after a rest of t >= 0 s; 1 without a rest.
double strengthening(const AgeingOptions& ageing, std::optional<double> rest);

}  // namespace asperity
