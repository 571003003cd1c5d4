// SPDX-License-Identifier: GPL-3.0-or-later
// The statistic of one profile at a list of steps, for each method of fractal_dimension.hpp but `psd`
// (spectral_bands.hpp). Every one is a plain function of samples; averaging and fitting are the caller's.
#pragma once

#include <span>

#include "engine/core/memory.hpp"
#include "engine/metrology/fractal_dimension.hpp"

namespace asperity {

// How one profile is stepped through.
struct Stepping {
  DimensionMethod method = DimensionMethod::length;
  std::span<const int> steps;  // samples
  bool wrap = false;
  bool offsets = false;
  bool holes = false;  // samples may be NaN: steps with such an end do not count (not of `box`)
};

// For each step: length L/L0 - 1 (not L/L0, which would lose the digits of flat profiles); structure
// and madogram of heights/`unit`; box counts for heights that span `unit`. `unit` > 0, m.
// NaN where no step counts. `mean_square_slopes`, if not empty, takes mean (Δz/(s·spacing))² per step (length
// only).
void step_statistics(std::span<const double> heights, double spacing, double unit, const Stepping& stepping,
                     std::span<double> statistics, std::span<double> mean_square_slopes);

}  // namespace asperity
