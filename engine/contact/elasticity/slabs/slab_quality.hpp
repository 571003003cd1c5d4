// SPDX-License-Identifier: GPL-3.0-or-later
// Residual and load projection of a contact in slabs: the formulas of half_space/contact_quality.hpp and
// half_space/load_projection.hpp, summed over the processes.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

struct SlabQuality {
  double residual = 0;      // greatest relative penetration or complementarity
  double offset = 0;        // of the residual
  double interior_gap = 0;  // mean of g strictly between the bounds
  double interior = 0;      // nodes there
  double load = 0;          // Σ p, clipped to the bounds
  bool within = true;       // nothing clipped
};

SlabQuality slab_quality(SlabLevel& level, std::span<const double> p, std::span<const double> g);

// target = clip(y + λ), λ on marked nodes, or on all if `marks` is null. False, `target` unchanged, if the
// marked nodes cannot carry the load. `target` may be `y`.
bool project_slabs_to_load(SlabLevel& level, std::span<const double> y, const std::uint8_t* marks,
                           std::span<double> target);

}  // namespace asperity
