// SPDX-License-Identifier: GPL-3.0-or-later
// Harmonic interpolation of missing points: Laplace's equation in each hole, with measured heights as
// boundary values and zero slope across the rim of the map. Filled heights stay within the range of their
// neighbours and have no roughness: a map with large holes becomes too smooth.
#pragma once

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Replaces every NaN; cells are hx by hy metres. Error: about 1e-12 of the height range. Returns the number
// of iterations: 1 for at most 60,000 missing points, 25 to 60 for millions in one hole. About 220 bytes and
// 3 µs for each missing point. Throws Error{bad_value} if all heights are missing or their range overflows,
// Error{out_of_memory} and Error{not_converged}.
int fill_harmonic(Field& heights, double hx, double hy, Monitor& monitor);

}  // namespace asperity
