// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts in slabs so light, or on ground so soft, that the ground moves by far less than the rms height:
// taken on until they are right to a share of how far it moves, as half_space/nested_descent.cpp.
#pragma once

#include "engine/contact/elasticity/slabs/slab_descent.hpp"
#include "engine/contact/elasticity/slabs/slab_nest.hpp"

namespace asperity {

// Returns whether gaps and offset are counted from the highest node afterwards.
bool refine_light_contact_in_slabs(SlabLevel& level, SlabFields& fields, const SlabCellProblem& problem,
                                   DescentEnd& end);

}  // namespace asperity
