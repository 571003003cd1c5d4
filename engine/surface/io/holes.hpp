// SPDX-License-Identifier: GPL-3.0-or-later
// Points that an instrument could not measure. They are filled with the harmonic continuation of
// the points around them: the solution of Laplace's equation in each hole with the measured heights
// as boundary values and no slope across the rim of the map. It never leaves the range of the
// neighbours and invents no roughness, so a map with large holes is too smooth there.
#pragma once

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Replaces every NaN of the field; cells are hx by hy metres. Solved by conjugate gradients to 1e-12
// of the height range: about (width of the widest hole in cells) passes over the holes. The same
// bits for any number of threads. Throws Error{bad_value} if nothing but holes is given.
void fill_harmonic(Field& heights, double hx, double hy, Monitor& monitor);

}  // namespace asperity
