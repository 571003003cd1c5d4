// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical cap, z = √(R² - r²) - R, or Hertz's (1882) paraboloid, z = -r²/2R. Apex: height 0, node (nx/2,
// ny/2), rounded down.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class SphereShape { sphere, paraboloid };

struct SphereOptions {
  Grid grid;
  double radius = 0;  // m, > 0
  SphereShape shape = SphereShape::sphere;
};

// Not periodic. The recipe keeps the position of the apex, possibly between nodes. O(nodes). Throws
// Error{bad_value} naming a non-positive `radius`, or one too small for the farthest corner (sphere).
Surface sphere_surface(const SphereOptions& options, Monitor& monitor = Monitor::silent());

// Throws as sphere_surface().
void require_makeable(const SphereOptions& options);

}  // namespace asperity
