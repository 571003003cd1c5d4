// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_level.hpp"

#include "engine/core/cost.hpp"

namespace asperity {

SlabLevel::SlabLevel(Team& level_team, const SlabShape& level_shape, std::span<const double> heights,
                     double origin, double factor, double level_cap, double level_mean_pressure)
    : team(level_team),
      shape(level_shape),
      cap(level_cap),
      mean_pressure(level_mean_pressure),
      short_wave_stiffness(0.25 * std::numbers::pi / std::sqrt(level_shape.aspect)),
      heights_(heights),
      origin_(origin),
      factor_(factor),
      fourier_(level_team.fourier(level_shape.slab.nx, level_shape.slab.ny)) {}

void SlabLevel::count() const { cost::count_transforms(2 * shape.weight); }

}  // namespace asperity
