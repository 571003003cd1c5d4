// SPDX-License-Identifier: GPL-3.0-or-later
// The descents of a contact in slabs: the quick one of half_space/active_set_descent.cpp (preconditioned
// conjugate gradients on the free set, what the clipping changes travelling with a fixed preconditioned step)
// and the sure one of half_space/descent.hpp, in the same turn. All decisions follow sums over the
// processes, so that every process makes the same ones.
#pragma once

#include <cstdint>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

// Of the nodes of this process: 34 bytes a node, and 16 more where a cycle has to be broken.
struct SlabFields {
  SlabFields(Team& team, std::size_t nodes);
  Array<double> pressure;  // p, feasible between stages
  Array<double> gap;       // K p − h
  Array<double> direction, image;
  Array<double> old_pressure, old_gap;
  Array<std::uint8_t> free, old_free;
};

// From fields.pressure, feasible, until a stage converges.
DescentEnd descend_in_slabs(SlabLevel& level, SlabFields& fields, double tolerance, ChainEffort effort);

}  // namespace asperity
