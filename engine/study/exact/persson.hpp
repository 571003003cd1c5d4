// SPDX-License-Identifier: GPL-3.0-or-later
// Real contact area of a rough half-space by Persson's theory (Persson 2001, J. Chem. Phys. 115, 3840, with
// its absorbing edge at the hardness): pressures diffuse from p̄ over a variance (E* h')²/4 between edges at
// 0 and H, with h' the rms slope. A theory, exact at full contact and some 20 % below simulations of light
// loads; what it is here for is its limits.
#pragma once

namespace asperity::exact {

struct PerssonArea {
  double elastic = 0;  // share of the tile in contact below the hardness
  double capped = 0;   // share at the hardness; 0 without one
};

// `modulus` E*, `pressure` p̄ and `hardness` H in Pa, `rms_slope` h'; all > 0, H > p̄, infinite for none:
// then elastic = erf(√2 p̄/(E* h')). Otherwise the sine series of the diffusion, summed to the last bit.
// Throws Error{infeasible} for p̄ >= H.
PerssonArea persson_area(double modulus, double rms_slope, double pressure, double hardness);

}  // namespace asperity::exact
