// SPDX-License-Identifier: GPL-3.0-or-later
// A spherical cap, z = √(R² - r²) - R, or the paraboloid z = -r²/2R that Hertz (1882) puts in its
// place: a single asperity of radius R with its apex, at height 0, on node (nx/2, ny/2) rounded down.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class SphereShape { sphere, paraboloid };

struct SphereOptions {
  Grid grid;
  double radius = 0;  // m, R > 0
  SphereShape shape = SphereShape::sphere;
};

// Not periodic. Made again on other cells, the apex keeps its place in the tile, on a node or between nodes.
// O(nodes). Throws Error{bad_value} naming `radius` when it is not above zero, or when
// a sphere does not reach the corner of the grid that is farthest from the apex.
Surface sphere_surface(const SphereOptions& options, Monitor& monitor = Monitor::silent());

// Throws as sphere_surface for an option out of range; makes nothing.
void require_makeable(const SphereOptions& options);

}  // namespace asperity
