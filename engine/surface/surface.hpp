// SPDX-License-Identifier: GPL-3.0-or-later
// A rough surface: heights in metres on a regular grid, z pointing up out of the body. An immutable
// value, cheap to copy: copies share the heights. What a generator or a file knows beyond the
// heights (material, periodicity, variance past Nyquist) travels with it. A generated surface also knows
// how to be made again on other cells: it is one continuous surface, and the heights are samples.
// A measured map may have holes, points that were not measured: nothing fills them unless asked. Whoever
// needs every point asks for heights(), which refuses a map with holes; whoever knows what to do with
// holes asks for measured_heights(), where they are NaN.
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
  std::optional<Material> material;
  bool periodic = false;                // the heights continue smoothly across the rim by construction
  std::optional<double> aliased_share;  // share of the variance that lies past Nyquist, 0 … 1
};

class Surface;
// Makes the same surface on nx by ny cells of the same tile, for any number of threads at once. Keeps a few
// options, never heights. Throws Error{bad_value} for cells that cannot carry it.
using SurfaceRecipe = std::function<Surface(int nx, int ny, Monitor& monitor)>;

class Surface {
 public:
  // Throws Error{bad_value} naming the first node whose height is not finite, or when the field does
  // not fit the grid.
  Surface(const Grid& grid, Field heights, SurfaceTraits traits = {});
  // A map with missing points: NaN is a point without a measurement. A map without NaN equals the surface
  // that the constructor makes, also in its digest. Throws Error{bad_value} for infinite heights and if every
  // point is missing.
  static Surface with_holes(const Grid& grid, Field heights, SurfaceTraits traits = {});

  const Grid& grid() const;
  // Throws Error{bad_value} for a surface with holes: how many, the first, and the cure.
  const Field& heights() const;
  // NaN at the nodes that were not measured, and only there.
  const Field& measured_heights() const;
  std::size_t measured() const;  // nodes
  bool complete() const { return measured() == measured_heights().size(); }
  const SurfaceTraits& traits() const { return traits_; }
  const std::optional<Material>& material() const { return traits_.material; }

  // Height of node (i, j), m; NaN where it was not measured. Throws Error{bad_value} outside the grid.
  double height(double i, double j) const;
  Range height_range() const;  // of the measured nodes, m; computed once
  double peak_to_valley() const { return height_range().span(); }

  // The same heights with another material.
  Surface with_material(Material material) const;

  // The same surface, which `recipe` makes again on other cells: nodes that two grids share agree to rounding
  // or as the generator documents. The recipe is no part of digest or equality. A surface made anew from
  // heights has no recipe, so a change of heights drops the recipe unless its comment says otherwise.
  Surface made_by(SurfaceRecipe recipe) const;
  const std::shared_ptr<const SurfaceRecipe>& recipe() const { return recipe_; }  // null: none
  // Made again by its recipe, with this material; none without a recipe, or where these cells cannot carry
  // the surface.
  std::optional<Surface> remade(int nx, int ny, Monitor& monitor = Monitor::silent()) const;

  // Digest of grid, heights and holes; material and traits do not enter. Computed once, thread-safe.
  const std::string& digest() const;

 private:
  struct Heights;  // grid, field and the facts computed once from them
  Surface(std::shared_ptr<const Heights> heights, SurfaceTraits traits);
  Surface(const Grid& grid, Field heights, SurfaceTraits traits, bool holes);

  std::shared_ptr<const Heights> data_;
  SurfaceTraits traits_;
  std::shared_ptr<const SurfaceRecipe> recipe_;
};

}  // namespace asperity
