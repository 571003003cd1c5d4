// SPDX-License-Identifier: GPL-3.0-or-later
// The same surface on other cells; size, material and node (0, 0) are kept. Periodic surfaces use the
// spectrum: refining preserves common nodes, coarsening drops unresolved waves. Others, and those with
// holes, use Keys' cubic along a refined axis and averages over one new cell along a coarsened axis; the
// last cell continues the line through the last two nodes. Holes end periodicity; a touched hole gives a
// hole.
#pragma once

#include "engine/surface/surface.hpp"

namespace asperity {

// O(n log n) periodic, else O(n); three grids of the larger kind. Deterministic. Drops the aliased share
// unless nothing changes. Throws Error{bad_value} for `cells` outside 1 … 65536.
Surface resampled(const Surface& surface, double nx, double ny);

struct AtCells {
  Surface surface;
  enum class How {
    unchanged,
    sampled,       // cells divide the old ones: the same heights, to the bit
    made_again,    // by the generator
    interpolated,  // by resampled()
  } how = How::unchanged;
};
// Unlike resampled(), sampling lets unresolved waves alias, as generation does. Keeps recipe and material.
// Throws Error{bad_value} for `cells` outside 1 … 65536, and for holes when sampling.
AtCells at_cells(const Surface& surface, int nx, int ny, Monitor& monitor = Monitor::silent());

}  // namespace asperity
