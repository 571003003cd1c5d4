// SPDX-License-Identifier: GPL-3.0-or-later
// Combined heights of a contact on three times its cells per side; its nodes are every third node. Bodies
// with a generator are generated again, others interpolated. Two rough bodies face each other at the same
// places, turned about the same centre. Beyond a rim without wrap, the last heights of the upper body
// continue.
#pragma once

#include "engine/contact/bodies/geometry.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Median energy error of 150 scenes: a quarter on twice the cells, a ninth on three times.
inline constexpr int times_finer = 3;

// Sides of one cell stay. Throws Error{bad_value} naming `estimate` for one cell or more than 65536 per side.
Grid finer_grid(const Grid& grid);

// Upper heights at lower nodes, finer by whole factors than `lattice`.
Field over_lower(const Field& upper, const LatticeIsometry& lattice, Boundary boundary);

// h on finer_grid(geometry.grid()), m, after all events. No solve.
Field finer_heights(const Scene& scene, const ContactGeometry& geometry,
                    Monitor& monitor = Monitor::silent());

}  // namespace asperity
