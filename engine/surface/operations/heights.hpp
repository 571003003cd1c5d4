// SPDX-License-Identifier: GPL-3.0-or-later
// Operations that change heights and leave the grid: scaling to a given amplitude, sums, differences and
// multiples, and the cutting off of peaks. Points that were not measured stay so. Pure; O(n); throw nothing
// but Error. A surface that can be made again on other cells still can afterwards, with the factors and
// levels found here.
#pragma once

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class ScaleTo {
  amplitude,  // peak to valley
  rms,        // root mean square deviation from the mean (Rq)
  ra,         // mean absolute deviation from the mean (Ra)
};
enum class ScaleAbout {
  mean,  // deviations from the mean are scaled, the mean stays
  base,  // heights above the lowest point are scaled, the lowest point stays
};

// The surface stretched so that `measure` becomes `target` (m, >= 0; 0 gives a flat). Periodicity,
// material and the aliased share stay. Throws Error{bad_value} for a target below zero or not
// finite, and for a flat surface unless the target is 0.
Surface scaled(const Surface& surface, ScaleTo measure, double target, ScaleAbout about = ScaleAbout::mean);

// Heights added node by node. Material of the first; periodic if both are. Throws Error{bad_value}
// unless cells and sizes are equal (sizes to 1e-9), proposing `resampled` or `cropped`.
Surface plus(const Surface& first, const Surface& second);
// The same of first - second. A point that was not measured on either surface is one of the result; throws
// Error{bad_value} where no point was measured on both.
Surface minus(const Surface& first, const Surface& second);

// Heights times a finite number, and heights divided by one that is not 0. Material and periodicity stay.
Surface times(const Surface& surface, double factor);
Surface over(const Surface& surface, double divisor);

// min(height, max - fraction * peak to valley); 0 changes nothing, 1 leaves a flat at the lowest
// point. Throws Error{bad_value} for a fraction outside [0, 1].
Surface cut(const Surface& surface, double fraction);
Profile cut(const Profile& profile, double fraction);

}  // namespace asperity
