// SPDX-License-Identifier: GPL-3.0-or-later
// The combined heights of a contact on twice its cells, lying as they do: the nodes of the contact are every
// second node of the finer ones. Bodies whose generator is known are made again with all their waves and
// features; others, measured or flattened by earlier events, are interpolated, which adds nothing that was
// not known. Two rough bodies meet over the same places, turned about the same centre; past the rim of an
// upper body that does not wrap, where half a cell has no node left, its last heights go on.
#pragma once

#include "engine/contact/geometry.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Twice the cells along every side of more than one cell. Throws Error{bad_value} naming `estimate` where
// there is none, or more than 65536 would be needed.
Grid finer_grid(const Grid& grid);

// h on finer_grid(geometry.grid()), m. `scene` has the bodies of `geometry` as events have left them. Costs
// what generating or interpolating the bodies costs, and no solve.
Field finer_heights(const Scene& scene, const ContactGeometry& geometry,
                    Monitor& monitor = Monitor::silent());

}  // namespace asperity
