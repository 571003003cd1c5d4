// SPDX-License-Identifier: GPL-3.0-or-later
// The length method (fractal_dimension.hpp) on a Gaussian profile. With rms slope s of height differences,
// the expected length over base is
//
//   E[L/L0] = E√(1 + s²g²) = eˣ [K0(x) + K1(x)] / (2 √(2π) s),   x = 1/(4 s²),  g standard normal,
//
// with modified Bessel functions K. Flat profiles (s²/2) reveal little of D; only steep ones grow as s.
#pragma once

namespace asperity {

// For s >= 0, to 1e-14 relative; 1 at 0, s√(2/π) for large s.
double expected_length_ratio(double rms_slope);

// d ln E[L/L0] / d ln s = (K1 - K0)/(K1 + K0), the visible share of D - 1: s² (flat) to 1; 0.5 at s = 1.22,
// 0.9 at 4.67.
double length_sensitivity(double rms_slope);

}  // namespace asperity
