// SPDX-License-Identifier: GPL-3.0-or-later
// Whole cells and quarter turns copy heights; other moves interpolate, and a touched hole gives a hole.
// Material is kept.
#pragma once

#include "engine/surface/surface.hpp"

namespace asperity {

// Cyclic: result(x) = original(x - shift), in metres. Whole cells, to 1e-9, are exact. A fraction is exact
// for all resolved waves if periodic, cubic if holes are present, else an Error{bad_value}.
Surface shifted(const Surface& surface, double x, double y);

// `angle` in radians counter-clockwise, seen from +z, about the centre of the nodes. Quarter turns, to
// 1e-9, are exact; odd ones swap cells and sizes. Other angles interpolate (cubic) on cells of the same size.
// A periodic surface keeps its grid, filled from neighbour tiles, but not its periodicity; otherwise the
// largest centred part of the same proportions remains. Throws Error{bad_value} for a non-finite angle or if
// no measured point remains.
Surface rotated(const Surface& surface, double angle);

// Node i becomes nx-1-i.
Surface mirrored(const Surface& surface);

// nx by ny cells from node (i, j). Periodic only if whole. Throws Error{bad_value} for an empty part,
// fractional cells, a part past the rim or without measured points.
Surface cropped(const Surface& surface, double i, double j, double nx, double ny);
// Lower corner (x, y) and size in metres, rounded to nodes.
Surface cropped_to(const Surface& surface, double x, double y, double size_x, double size_y);

}  // namespace asperity
