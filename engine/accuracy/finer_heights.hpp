// SPDX-License-Identifier: GPL-3.0-or-later
// The combined heights of a contact on three times its cells a side, lying as they do: the nodes of the
// contact are every third node of the finer ones. Bodies whose generator is known are made again with all
// their waves and features; others, measured or flattened by earlier events, are interpolated, which adds
// nothing that was not known. Two rough bodies meet over the same places, turned about the same centre; past
// the rim of an upper body that does not wrap, where half a cell has no node left, its last heights go on.
#pragma once

#include "engine/contact/bodies/geometry.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// What the error of the grid leaves on finer cells is mostly chance, and an estimate from them is the better
// the less of it there is: in the middle of 150 scenes a quarter of the error of the energy on twice the
// cells, a ninth on thrice.
inline constexpr int times_finer = 3;

// `times_finer` the cells along every side of more than one cell. Throws Error{bad_value} naming `estimate`
// where there is none, or more than 65536 would be needed.
Grid finer_grid(const Grid& grid);

// The upper body's heights over the nodes of a lower grid finer by whole factors, as the lattice part of a
// pose lays it on the cells of `lattice`.
Field over_lower(const Field& upper, const LatticeIsometry& lattice, Boundary boundary);

// h on finer_grid(geometry.grid()), m. `scene` has the bodies of `geometry` as events have left them. Costs
// what generating or interpolating the bodies costs, and no solve.
Field finer_heights(const Scene& scene, const ContactGeometry& geometry,
                    Monitor& monitor = Monitor::silent());

}  // namespace asperity
