// SPDX-License-Identifier: GPL-3.0-or-later
// Points that an instrument could not measure. They are filled with the harmonic continuation of
// the points around them: the solution of Laplace's equation in each hole with the measured heights
// as boundary values and no slope across the rim of the map. It never leaves the range of the
// neighbours and invents no roughness, so a map with large holes is too smooth there.
#pragma once

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Replaces every NaN of the field; cells are hx by hy metres. Solved by conjugate gradients with
// multigrid to 1e-12 of the height range. Returns the number of iterations: some ten to twenty for
// holes of any width, so the cost grows as the number of missing points; about 150 bytes for each.
// The same bits for any number of threads. Reports progress and stops when asked. Throws
// Error{bad_value} if nothing but holes is given, or heights whose range is beyond any double.
int fill_harmonic(Field& heights, double hx, double hy, Monitor& monitor);

}  // namespace asperity
