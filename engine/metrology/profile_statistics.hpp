// SPDX-License-Identifier: GPL-3.0-or-later
// The statistic of one profile at a list of steps, for each method of fractal_dimension.hpp. Every
// one is a plain function of samples; averaging and fitting are the caller's.
#pragma once

#include <span>

#include "engine/core/memory.hpp"
#include "engine/metrology/fractal_dimension.hpp"

namespace asperity {

// How one profile is stepped through.
struct Stepping {
  DimensionMethod method = DimensionMethod::length;
  std::span<const int> steps;  // samples; for psd unused
  bool wrap = false;
  bool offsets = false;
};

// For each step: length L/L0 - 1 (not L/L0, which would lose the digits of flat profiles); structure
// and madogram of heights/`unit`; box counts for heights that span `unit`. `unit` > 0, m.
// `mean_square_slopes`, if not empty, takes mean (Δz/(s·spacing))² per step (length only).
void step_statistics(std::span<const double> heights, double spacing, double unit, const Stepping& stepping,
                     std::span<double> statistics, std::span<double> mean_square_slopes);

// Wavelengths, in samples, of the bands that `psd` uses for n samples: ratio √2, from half the length
// (the length, if `wrap`) to 3; empty for fewer than 16 samples.
std::vector<double> band_wavelengths(int n, bool wrap);
// Mean of ln periodogram over each band, heights in `unit`. The mean of logarithms is off by the
// same amount in every band, however few ordinates it has; the logarithm of the mean is not.
void band_log_powers(std::span<const double> heights, double unit, bool wrap, std::span<double> log_powers);

}  // namespace asperity
