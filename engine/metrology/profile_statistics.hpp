// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of one profile per step, for fractal_dimension.hpp (not `psd`).
#pragma once

#include <span>

#include "engine/core/memory.hpp"
#include "engine/metrology/fractal_dimension.hpp"

namespace asperity {

struct Stepping {
  DimensionMethod method = DimensionMethod::length;
  std::span<const int> steps;  // samples
  bool wrap = false;
  bool offsets = false;
  bool holes = false;  // samples may be NaN: such steps are skipped (not for `box`)
};

// length: L/L0 - 1, to keep digits; structure, madogram: of heights/`unit`; box: for heights spanning `unit`.
// `unit` > 0 in m. NaN without valid steps. `mean_square_slopes` (or empty): mean (Δz/(s·spacing))², length
// only.
void step_statistics(std::span<const double> heights, double spacing, double unit, const Stepping& stepping,
                     std::span<double> statistics, std::span<double> mean_square_slopes);

}  // namespace asperity
