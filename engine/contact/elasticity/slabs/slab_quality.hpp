// SPDX-License-Identifier: GPL-3.0-or-later
// How far pressures in slabs are from the solution, as half_space/contact_quality.hpp; and the nearest
// pressures that respect their bounds and carry the load, as half_space/load_projection.hpp. The same
// formulas, summed over the processes.
#pragma once

#include <cstdint>
#include <span>

#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

struct SlabQuality {
  double residual = 0;      // greatest relative entry of penetration and complementarity
  double offset = 0;        // δ by which the residual is measured
  double interior_gap = 0;  // mean of g strictly between the bounds
  double interior = 0;      // nodes there
  double load = 0;          // Σ p, clipped to the bounds
  bool within = true;       // nothing had to be clipped
};

SlabQuality slab_quality(SlabLevel& level, std::span<const double> p, std::span<const double> g);

// target = clip(y + λ), λ for the nodes with a mark or for all where there are none. False, `target`
// untouched, where those cannot carry the load. `target` may be `y`.
bool project_slabs_to_load(SlabLevel& level, std::span<const double> y, const std::uint8_t* marks,
                           std::span<double> target);

}  // namespace asperity
