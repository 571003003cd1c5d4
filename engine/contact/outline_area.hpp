// SPDX-License-Identifier: GPL-3.0-or-later
// The real contact area within an outline that runs between the nodes. Counting nodes puts the outline
// half-way between a node that touches and one that does not, wherever between them it is. Pressures and gaps
// beside it say where: at the edge of a contact of half-spaces, with d the distance from the edge,
//   p = K sqrt(d) inside,   g = 4/3 (K/E*) d^(3/2) outside,
// so that E* g/(p h) of the two nodes, h apart, and the pressure of the next node inside over p tell which
// share of h lies within. What grids make of both, and outlines that turn, is fitted (head of the source). Of
// layers and bodies that attract each other it knows nothing. Between nodes of boxes pressure and gap are
// linear.
#pragma once

#include <optional>

#include "engine/core/grid.hpp"

namespace asperity {

enum class OutlineLaw {
  elastic,  // half-spaces
  capped,   // half-spaces whose pressure is limited
  boxes
};

struct OutlineArea {
  double fraction = 0;  // of the tile
  // What |fraction - f|, f that of ever finer cells, stays within in nine scenes of ten, relative to
  // `fraction`, where the waves of the bodies have some seven cells or more.
  double doubt = 0;
};

// For bodies without attraction. `pressure` in Pa is above 0 on touching nodes; `gap` in m; `modulus` is E*
// in Pa, or for boxes the stiffness in Pa/m. With `wraps` the tile goes on past its
// rim; without, the rim is no outline. No area if nothing or everything touches, on cells more than 1.25
// times longer than wide or wider than long, on tiles of fewer than 8 cells along a side, and where most
// pressures rise towards the outline, as under a flat punch. O(n).
std::optional<OutlineArea> outline_area(const Field& pressure, const Field& gap, const Grid& grid,
                                        double modulus, bool wraps, OutlineLaw law = OutlineLaw::elastic);

}  // namespace asperity
