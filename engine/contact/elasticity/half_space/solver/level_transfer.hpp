// SPDX-License-Identifier: GPL-3.0-or-later
// Between nested grids. Down: heights at the nodes of a coarser grid, injected where its nodes are nodes
// of the finer one, interpolated linearly otherwise. Up: a field interpolated bilinearly, round the rim on
// a periodic tile. Sides are not halved below 32 cells.
#pragma once

#include <optional>
#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// The next coarser grid with its pitches in cells of the finer one; none where no side can be halved.
struct CoarserGrid {
  LevelShape shape;  // weight not set
  double pitch_x = 2, pitch_y = 2;
};
std::optional<CoarserGrid> coarser(const LevelShape& fine);

Array<double> restrict_to(const LevelShape& fine, const CoarserGrid& coarse, std::span<const double> field);

// values on `coarse` -> `target` on `fine`, times `factor`.
void prolong(const CoarserGrid& coarse, std::span<const double> values, double factor, const LevelShape& fine,
             std::span<double> target);

}  // namespace asperity
