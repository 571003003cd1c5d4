// SPDX-License-Identifier: GPL-3.0-or-later
// Operations that keep the grid. Holes remain holes. Pure; O(n). Recipes are kept, with the factors and
// levels found here.
#pragma once

#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class ScaleTo {
  amplitude,  // peak to valley
  rms,        // Rq
  ra,         // Ra
};
enum class ScaleAbout {
  mean,
  base,  // lowest point
};

// Makes `measure` equal `target` (m, >= 0; 0: flat). Keeps periodicity, material and aliased share. Throws
// Error{bad_value} for a negative or non-finite target, and for a flat surface unless the target is 0.
Surface scaled(const Surface& surface, ScaleTo measure, double target, ScaleAbout about = ScaleAbout::mean);

// Material of the first; periodic if both are. Throws Error{bad_value} for different grids (to 1e-9).
Surface plus(const Surface& first, const Surface& second);
// plus() and minus() throw Error{bad_value} without a common measured point.
Surface minus(const Surface& first, const Surface& second);

// Finite factor; finite, nonzero divisor. Keeps material and periodicity.
Surface times(const Surface& surface, double factor);
Surface over(const Surface& surface, double divisor);

// min(height, max - fraction · peak to valley); 1 gives a flat at the lowest point. Throws Error{bad_value}
// for a fraction outside [0, 1].
Surface cut(const Surface& surface, double fraction);
Profile cut(const Profile& profile, double fraction);

}  // namespace asperity
