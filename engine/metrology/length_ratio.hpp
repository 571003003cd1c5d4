// SPDX-License-Identifier: GPL-3.0-or-later
// What the length method (fractal_dimension.hpp) sees on a Gaussian profile. Where height
// differences over a spacing have the rms slope s, the expected length of the profile over its base is
//
//   E[L/L0] = E√(1 + s²g²) = eˣ [K0(x) + K1(x)] / (2 √(2π) s),   x = 1/(4 s²),  g standard normal,
//
// with K the modified Bessel functions. It rises as s itself only on steep profiles; on flat ones as
// s²/2, and then the slope of ln L against ln spacing says little about the dimension.
#pragma once

namespace asperity {

// E[L/L0] for rms slope s >= 0; 1 at 0, and s√(2/π) for large s. To 1e-14 relative.
double expected_length_ratio(double rms_slope);

// d ln E[L/L0] / d ln s = (K1 - K0)/(K1 + K0): the share of D - 1 that shows in the length at that
// steepness. From s² (flat) to 1 (steep); one half at s = 1.22, nine tenths at s = 4.67.
double length_sensitivity(double rms_slope);

}  // namespace asperity
