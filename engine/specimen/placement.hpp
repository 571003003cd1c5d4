// SPDX-License-Identifier: GPL-3.0-or-later
// Putting the upper specimen down afresh: a turn and a shift drawn by chance, exact on the lattice, so
// that turning a specimen never resamples it. Off the axis of a disc a turn brings statistically
// fresh ground, which on one tile a shift stands for.
#pragma once

#include <cstdint>

#include "engine/contact/bodies/pose.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

// Where the stream "placement" of `seed` puts the upper body: turned by 0, 90, 180 or 270 deg (0 or 180
// when cells or sizes differ in x and y), then shifted by whole cells along x and y; on a free boundary
// not shifted at all, for a body moved past the rim would meet nothing there.
LatticeIsometry draw_placement(const Grid& grid, Boundary boundary, std::uint64_t seed);

}  // namespace asperity
