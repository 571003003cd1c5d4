// SPDX-License-Identifier: GPL-3.0-or-later
// Where one map lies on another, or that the maps cannot tell: candidates of the coarse search are refined on
// coarse maps and judged by how much of the heights they explain, the best one is refined on finer and finer
// maps, and its uncertainty is taken there. Refused is what does not explain the heights, what another place
// explains as well, and ground on which the map could slide or turn.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/refinement.hpp"

namespace asperity::registration {

inline constexpr int least_cells_of_map = 32;  // along each side

struct PlacementLimits {
  double greatest_turn;   // rad, to either side
  double greatest_shift;  // cells, both maps' first nodes having lain on each other; may be infinite
  double cell;            // m
};

struct Placement {
  Refined found;
  PoseUncertainty u;
  double second_best = 0;  // share of the variance of the heights that the best placement elsewhere explains
};

// Maps of like roughness; heights of any unit. Throws Error{bad_value} where they cannot tell.
Placement find_placement(const HeightMap& before, const HeightMap& after, const PlacementLimits& limits,
                         Monitor& monitor);

}  // namespace asperity::registration
