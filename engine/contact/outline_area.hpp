// SPDX-License-Identifier: GPL-3.0-or-later
// Real contact area within an outline that runs between the nodes. Half-spaces: at distance d from the edge
// of a contact
//   p = K sqrt(d) inside,   g = 4/3 (K/E*) d^(3/2) outside,
// so pressures and gaps near an edge locate the outline between two nodes, h apart; effects of the grid and
// of curved outlines are fitted. Boxes: pressure and gap are linear between nodes. Not for layers or
// attracting bodies.
#pragma once

#include <optional>

#include "engine/core/grid.hpp"

namespace asperity {

enum class OutlineLaw {
  elastic,  // half-spaces
  capped,   // half-spaces with a pressure limit
  boxes
};

struct OutlineArea {
  double fraction = 0;  // of the tile
  // Bounds |fraction − limit on ever finer cells| / fraction in nine scenes of ten, for waves of about seven
  // cells or more.
  double doubt = 0;
};

// `pressure` in Pa, above 0 on touching nodes; `gap` in m; `modulus`: E* in Pa, or the stiffness of boxes in
// Pa/m. Without `wraps` the rim is no outline. None if nothing or everything touches, for cell aspects over
// 1.25, under 8 cells along a side, or if most pressures rise towards the outline, as under a flat punch.
// O(n).
std::optional<OutlineArea> outline_area(const Field& pressure, const Field& gap, const Grid& grid,
                                        double modulus, bool wraps, OutlineLaw law = OutlineLaw::elastic);

}  // namespace asperity
