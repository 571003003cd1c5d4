// SPDX-License-Identifier: GPL-3.0-or-later
// Sorting many non-negative doubles. Their bit patterns sort as integers, so a radix sort on eleven
// bits at a time (M. Herf, "Radix tricks") does it in at most six passes over memory. Sorted doubles
// without NaN are one sequence whatever the method, so the choice of method never shows in a result.
#pragma once

#include "engine/core/memory.hpp"

namespace asperity {

// Ascending, in place. Every value must be >= +0.0 (no -0.0) and not NaN. O(n); a second array of the
// same length is held while it runs. Looks at the stop flag between passes.
void sort_ascending(Array<double>& values);

}  // namespace asperity
