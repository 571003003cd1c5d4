// SPDX-License-Identifier: GPL-3.0-or-later
// Ratio of tangential to normal compliance, for partial slip (friction/partial_slip.hpp). Half-spaces:
// Mindlin's C = Σ (2−ν)/(4G) / Σ (1−ν)/(2G) over both bodies, G = E/(2(1+ν)); for like bodies (2−ν)/(2(1−ν))
// (Mindlin 1949; Johnson, Contact Mechanics, eq. 7.43). In Fourier space the compliance along the shear is
// (1 − ν cos²θ)/(G|q|); C is its mean over the directions of q, exact for ν = 0 or circular contacts. Not
// included: coupling of shear and pressure, zero for like bodies or ν = ½, growing with Dundurs' β.
#pragma once

#include "engine/contact/scene/effect.hpp"

namespace asperity {

struct TangentialOptions {
  // > 0; default: Mindlin's for half-spaces; none for boxes.
  std::optional<double> compliance_ratio;
  static const Effect& effect();
};

// Not both bodies rigid; moduli as elasticity requires.
double mindlin_ratio(const ContactGeometry& geometry);
// Dundurs' β, −½ … ½; 0: shear and pressure are uncoupled.
double dundurs_beta(const ContactGeometry& geometry);

}  // namespace asperity
