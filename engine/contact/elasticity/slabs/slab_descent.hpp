// SPDX-License-Identifier: GPL-3.0-or-later
// Descents of a contact in slabs, as half_space/active_set_descent.cpp and half_space/descent.hpp. Decisions
// follow sums over all processes: all processes decide alike.
#pragma once

#include <cstdint>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

// 34 bytes a node of this process; 16 more while a cycle is broken.
struct SlabFields {
  SlabFields(Team& team, std::size_t nodes);
  Array<double> pressure;  // feasible between stages
  Array<double> gap;       // K p − h
  Array<double> direction, image;
  Array<double> old_pressure, old_gap;
  Array<std::uint8_t> free, old_free;
};

// Starts from fields.pressure, feasible.
DescentEnd descend_in_slabs(SlabLevel& level, SlabFields& fields, double tolerance, ChainEffort effort);

}  // namespace asperity
