// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/sphere.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

Surface flat_surface(const FlatOptions& options, Monitor&) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  return Surface(grid, Field(grid.nx, grid.ny), {.periodic = true})
      .made_by([grid](int nx, int ny, Monitor& monitor) {
        return flat_surface({Grid{nx, ny, grid.size_x, grid.size_y}}, monitor);
      });
}

namespace {

// The apex may be between nodes.
Surface cap_on(const Grid& grid, double radius, bool cap, double apex_i, double apex_j) {
  Field heights(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const double r = elementary::hypot((i - apex_i) * grid.hx(), (j - apex_j) * grid.hy());
      const double s = cap ? std::min(r / radius, 1.0) : r / radius;
      // Avoids cancellation in √(R² - r²) - R near the apex.
      heights(i, j) = cap ? -r * s / (1 + std::sqrt((1 - s) * (1 + s))) : -r * s / 2;
    }
  return Surface(grid, std::move(heights));
}

}  // namespace

void require_makeable(const SphereOptions& options) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  const double radius = options.radius;
  require_positive("radius", radius, "m", "give a finite length above zero");
  const double corner = elementary::hypot(grid.nx / 2 * grid.hx(), grid.ny / 2 * grid.hy());
  constexpr double rounding = 1e-12;
  if (options.shape == SphereShape::sphere && corner > radius * (1 + rounding))
    refuse("`radius` is " + metres(radius) + ", but the corner of the grid is " + metres(corner) +
               " from the apex",
           "give a larger radius, a smaller `size`, or shape = \"paraboloid\"");
}

Surface sphere_surface(const SphereOptions& options, Monitor&) {
  require_makeable(options);
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  const double radius = options.radius;
  const int apex_i = grid.nx / 2;
  const int apex_j = grid.ny / 2;
  const bool cap = options.shape == SphereShape::sphere;
  const Grid first = grid;
  const SurfaceRecipe recipe = [=](int nx, int ny, Monitor&) {
    return cap_on(make_grid(nx, ny, first.size_x, first.size_y), radius, cap,
                  static_cast<double>(apex_i) * nx / first.nx, static_cast<double>(apex_j) * ny / first.ny);
  };
  return cap_on(grid, radius, cap, apex_i, apex_j).made_by(recipe);
}

}  // namespace asperity
