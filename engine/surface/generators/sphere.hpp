// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical cap, z = √(R² - r²) - R, or Hertz's (1882) paraboloid, z = -r²/2R. Apex: height 0, node (nx/2,
// ny/2), rounded down.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Height 0 at every node.
struct FlatOptions {
  Grid grid;
};

// Periodic. O(nodes). Throws Error{bad_value} naming `cells` or `size`.
Surface flat_surface(const FlatOptions& options, Monitor& monitor = Monitor::silent());

enum class SphereShape { sphere, paraboloid };

struct SphereOptions {
  Grid grid;
  double radius = 0;  // m, > 0
  SphereShape shape = SphereShape::sphere;
};

// The recipe keeps the apex, possibly between nodes. O(nodes). Throws Error{bad_value} for a non-positive
// `radius`, or one too small for the corners (sphere).
Surface sphere_surface(const SphereOptions& options, Monitor& monitor = Monitor::silent());

// Throws as sphere_surface().
void require_makeable(const SphereOptions& options);

}  // namespace asperity
