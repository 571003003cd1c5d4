// SPDX-License-Identifier: GPL-3.0-or-later
// Attraction across the gap g >= 0 as a falling traction. Exponential: w/ρ e^(−g/ρ); Dugdale (1960; Maugis
// 1992): w/ρ while g < ρ. The energies are concave, so descents are monotone. The repulsion is a hard wall.
#pragma once

#include <algorithm>
#include <string>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

enum class GapLaw { exponential, dugdale };

struct GapTerm {
  std::string effect;  // catalogue name
  GapLaw law = GapLaw::exponential;
  double work = 0;   // w, J/m²
  double range = 0;  // ρ, m
  // Dugdale: the traction falls to zero from (1 − edge)ρ to (1 + edge)ρ, at equal work. Nodes would stick at
  // a sharp end.
  static constexpr double edge = 0.5;

  double greatest() const { return work / range; }  // Pa, at touch
  // Pa, for g >= 0.
  double traction(double g) const {
    if (law == GapLaw::dugdale) return greatest() * std::clamp((1 + edge - g / range) / (2 * edge), 0.0, 1.0);
    return greatest() * elementary::exp(-g / range);
  }
};

}  // namespace asperity
