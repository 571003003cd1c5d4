// SPDX-License-Identifier: GPL-3.0-or-later
// Operations that move a surface: shifts, turns, mirroring, cropping. Those by whole cells or
// quarter turns move heights without touching them; the others interpolate, and where they touch a point that
// was not measured there is none. Material stays.
#pragma once

#include "engine/surface/surface.hpp"

namespace asperity {

// Moved by (x, y) metres: result(x) = original(x - shift), cyclic: what leaves at one rim enters at
// the other, also where the surface is not periodic (there it leaves a step). Whole cells, to 1e-9
// of one, are exact. A fraction of a cell is exact for the waves that the grid carries (Fourier) on a
// periodic surface, by cubic interpolation on one with holes, and an Error{bad_value} on any other.
Surface shifted(const Surface& surface, double x, double y);

// Turned by `angle` radians counter-clockwise seen from above (from +z, x to the right, y up), about
// the centre of the nodes. Quarter turns, to 1e-9 of one, are exact and swap cells and sizes for odd
// ones. Any other angle interpolates (cubic) on cells of the same size: a periodic surface keeps its
// grid, filled from its neighbour tiles, and is no longer periodic; of any other the largest centred
// part of the same proportions that lies inside the turned surface remains. Throws Error{bad_value}
// for an angle that is not finite or when nothing of the surface, or of what was measured, would remain.
Surface rotated(const Surface& surface, double angle);

// Node i becomes node nx-1-i.
Surface mirrored(const Surface& surface);

// The part of nx by ny cells whose first node is (i, j). Periodic only if it is the whole. Throws
// Error{bad_value} when it is empty, not a whole number of cells, reaches past the rim, or holds no point
// that was measured.
Surface cropped(const Surface& surface, double i, double j, double nx, double ny);
// The same in metres: lower corner (x, y) and size, each taken to the nearest node.
Surface cropped_to(const Surface& surface, double x, double y, double size_x, double size_y);

}  // namespace asperity
