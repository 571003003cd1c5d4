// SPDX-License-Identifier: GPL-3.0-or-later
// Refines candidates on coarse maps, selects by explained variance, then refines on finer maps.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/refinement.hpp"

namespace asperity::registration {

inline constexpr int least_cells_of_map = 32;  // along each side

struct PlacementLimits {
  double greatest_turn;   // rad, to either side
  double greatest_shift;  // cells, from coinciding first nodes; may be infinite
  double cell;            // m
};

struct Placement {
  Refined found;
  PoseUncertainty u;
  double second_best = 0;  // explained by the best placement elsewhere
};

// Maps of similar roughness, any height unit. Throws Error{bad_value} for unexplained heights, equally good
// alternatives, and surfaces that allow sliding or turning.
Placement find_placement(const HeightMap& before, const HeightMap& after, const PlacementLimits& limits,
                         Monitor& monitor);

}  // namespace asperity::registration
