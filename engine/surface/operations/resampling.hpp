// SPDX-License-Identifier: GPL-3.0-or-later
// The same surface on other cells. Size, material and the place of node (0, 0) stay. A periodic
// surface goes through its spectrum: more cells add waves of height zero and pass exactly through
// the old nodes where they coincide; fewer drop the waves that the new grid cannot carry. Any other
// surface is interpolated (Keys' cubic) along an axis that gets more cells and averaged over one new
// cell about each new node along an axis that gets fewer; in the last cell, past the last node, the
// line through the last two nodes goes on. One with holes is interpolated so even if it is periodic, which
// it then is no more, and where a new node touches a point that was not measured there is none.
#pragma once

#include "engine/surface/surface.hpp"

namespace asperity {

// O(n log n) periodic, O(n) otherwise; peak three grids of the larger kind. Deterministic. The aliased
// share is dropped unless nothing changes. Throws Error{bad_value} for `cells` outside 1 … 65536.
Surface resampled(const Surface& surface, double nx, double ny);

// The same continuous surface sampled on other cells of its tile, as well as it is known.
struct AtCells {
  Surface surface;
  enum class How {
    unchanged,
    sampled,       // cells that divide the old ones: the heights of these nodes, to the bit
    made_again,    // by the generator, with all its waves and features
    interpolated,  // as `resampled` does: nothing is known between the nodes
  } how = How::unchanged;
};
// Unlike `resampled`, sampling drops no wave: those that the new cells cannot carry alias, as they do in a
// surface generated there. The result keeps recipe and material. Costs a copy, what the generator costs, or
// what `resampled` costs. Throws Error{bad_value} for `cells` outside 1 … 65536.
AtCells at_cells(const Surface& surface, int nx, int ny, Monitor& monitor = Monitor::silent());

}  // namespace asperity
