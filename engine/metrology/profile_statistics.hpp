// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of one profile per step.
#pragma once

#include <span>

namespace asperity {

// Explained in fractal_dimension.hpp.
enum class DimensionMethod { length, psd, structure, box, madogram };

struct Stepping {
  DimensionMethod method = DimensionMethod::length;
  std::span<const int> steps;  // samples
  bool wrap = false;
  bool offsets = false;
  bool holes = false;  // NaN samples: skips such steps (not for `box`)
};

// length: L/L0 - 1, to keep digits; structure, madogram: of heights/`unit`; box: for heights spanning `unit`.
// `unit` > 0 in m. NaN without valid steps. `mean_square_slopes` (or empty): mean (Δz/(s·spacing))², length
// only.
void step_statistics(std::span<const double> heights, double spacing, double unit, const Stepping& stepping,
                     std::span<double> statistics, std::span<double> mean_square_slopes);

// The length method on a Gaussian profile. With rms slope s of height differences, the expected length over
// base is
//
//   E[L/L0] = E√(1 + s²g²) = eˣ [K0(x) + K1(x)] / (2 √(2π) s),   x = 1/(4 s²),  g standard normal,
//
// with modified Bessel functions K.

// For s >= 0, to 1e-14 relative; 1 at 0, s√(2/π) for large s.
double expected_length_ratio(double rms_slope);

// d ln E[L/L0] / d ln s = (K1 - K0)/(K1 + K0), the visible share of D - 1: s² (flat) to 1; 0.5 at s = 1.22,
// 0.9 at 4.67.
double length_sensitivity(double rms_slope);

}  // namespace asperity
