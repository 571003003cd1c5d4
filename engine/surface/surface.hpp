// SPDX-License-Identifier: GPL-3.0-or-later
// A rough surface: heights in metres on a regular grid, z pointing up out of the body. Immutable; copies
// share the heights.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/material.hpp"

namespace asperity {

struct SurfaceTraits {
  std::optional<Material> material{};
  bool periodic = false;                  // smooth across the rim by construction
  std::optional<double> aliased_share{};  // of variance past Nyquist, 0 … 1
};

class Surface;
// Makes a generated surface on other cells. Thread-safe; stores no heights. Throws Error{bad_value} for
// unsuitable cells.
using SurfaceRecipe = std::function<Surface(int nx, int ny, Monitor& monitor)>;

class Surface {
 public:
  // Throws Error{bad_value} for the first non-finite height or a field of another size.
  Surface(const Grid& grid, Field heights, SurfaceTraits traits = {});
  // NaN is a hole. Without NaN the result equals the constructor's. Throws Error{bad_value} for infinite
  // heights or no measured point.
  static Surface with_holes(const Grid& grid, Field heights, SurfaceTraits traits = {});

  const Grid& grid() const;
  // Throws Error{bad_value} if there are holes.
  const Field& heights() const;
  // NaN in holes.
  const Field& measured_heights() const;
  std::size_t measured() const;  // nodes
  bool complete() const { return measured() == measured_heights().size(); }
  const SurfaceTraits& traits() const { return traits_; }
  const std::optional<Material>& material() const { return traits_.material; }

  // m, or NaN. Throws Error{bad_value} outside the grid.
  double height(double i, double j) const;
  Range height_range() const;  // measured nodes, m; computed once
  double peak_to_valley() const { return height_range().span(); }

  Surface with_material(Material material) const;

  // Nodes shared by two grids agree to rounding or as the generator documents. The recipe does not affect the
  // digest. Operations on heights drop it unless documented otherwise.
  Surface made_by(SurfaceRecipe recipe) const;
  const std::shared_ptr<const SurfaceRecipe>& recipe() const { return recipe_; }  // or null
  // With this material; none without a recipe or for unsuitable cells.
  std::optional<Surface> remade(int nx, int ny, Monitor& monitor = Monitor::silent()) const;

  // Digest of grid, heights and holes. Computed once, thread-safe.
  const std::string& digest() const;

 private:
  struct Heights;
  Surface(std::shared_ptr<const Heights> heights, SurfaceTraits traits);
  Surface(const Grid& grid, Field heights, SurfaceTraits traits, bool holes);

  std::shared_ptr<const Heights> data_;
  SurfaceTraits traits_;
  std::shared_ptr<const SurfaceRecipe> recipe_;
};

}  // namespace asperity
