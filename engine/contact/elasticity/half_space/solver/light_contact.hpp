// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts so light, or on ground so soft, that the ground moves by far less than the rms height. What is
// right to a share of the rms then says nothing of how the load is shared. So the solve goes on, its gaps
// counted from the height that matters, where they are sums of small terms and not small differences of large
// heights, and measured by how far the ground there moves.
#pragma once

#include <span>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"

namespace asperity {

// The heights of a level as its caller keeps them: (height − origin)·factor is in cell units.
struct RawHeights {
  std::span<const double> values;
  double origin = 0, factor = 1;
};

// From the feasible pressures and gaps in `fields`, where a chain left them; what it cannot better stays as
// it was, and ordinary contacts are left alone. `gap` belongs to the pressures again afterwards. Returns
// whether gaps and offset are counted from the highest node, so that the offset is the approach.
bool refine_light_contact(ContactLevel& level, DescentFields& fields, const RawHeights& heights,
                          double tolerance, ChainEnd& end);

}  // namespace asperity
