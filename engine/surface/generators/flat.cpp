// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/flat.hpp"

#include <utility>

namespace asperity {

Surface flat_surface(const FlatOptions& options, Monitor&) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  SurfaceTraits traits;
  traits.periodic = true;
  return Surface(grid, Field(grid.nx, grid.ny), std::move(traits))
      .made_by([grid](int nx, int ny, Monitor& monitor) {
        return flat_surface({Grid{nx, ny, grid.size_x, grid.size_y}}, monitor);
      });
}

}  // namespace asperity
