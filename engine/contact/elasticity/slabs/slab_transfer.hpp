// SPDX-License-Identifier: GPL-3.0-or-later
// Between nested grids in slabs: heights down, injected or interpolated linearly, and a field up, bilinearly,
// round the rim, as half_space/contact_level.hpp. Rows change hands where the two grids are dealt out in
// other ways. All processes together.
#pragma once

#include <span>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity {

// `fine` and `coarse` in slabs of the same team. The values of this process on the coarse grid.
Array<double> restrict_slabs(Team& team, const Slab& fine, const CoarserGrid& coarse,
                             std::span<const double> field);

// values on `coarse` -> `target` on `fine`, times `factor`.
void prolong_slabs(Team& team, const CoarserGrid& coarse, std::span<const double> values, double factor,
                   const Slab& fine, std::span<double> target);

}  // namespace asperity
