// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential compliance: shear and partial slip inside a contact, by how much more the bodies give sideways
// than normally. Half-spaces: Mindlin's ratio, C = Σ (2−ν)/(4G) / Σ (1−ν)/(2G) over both bodies with G =
// E/(2(1+ν)), which for like bodies is (2−ν)/(2(1−ν)) and 1 at ν = 0 (Mindlin 1949; Johnson, Contact
// Mechanics, eq. 7.43). In Fourier space the compliance along the shear is (1 − ν cos²θ)/(G|q|); C is its
// mean over the directions of q, so for ν other than 0 the ratio is exact for a circular contact and a mean
// for any other. That shear moves the bodies normally, and pressure sideways, is left out: it vanishes for
// like bodies and at ν = ½, and grows with Dundurs' β. What partial slip does is in
// friction/partial_slip.hpp.
#pragma once

#include "engine/contact/effect.hpp"

namespace asperity {

struct TangentialOptions {
  // Tangential over normal compliance, > 0; by default Mindlin's for half-spaces, none for boxes.
  std::optional<double> compliance_ratio;
  static const Effect& effect();
};

// Mindlin's ratio; materials as elasticity needs them, not both rigid.
double mindlin_ratio(const ContactGeometry& geometry);
// Dundurs' β of the two bodies, −½ … ½: 0 where shear and pressure do not mix.
double dundurs_beta(const ContactGeometry& geometry);

}  // namespace asperity
