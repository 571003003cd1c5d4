// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/surface.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/digest.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

std::string at_node(std::size_t k, const Grid& grid) {
  const auto nx = static_cast<std::size_t>(grid.nx);
  return "(" + std::to_string(k % nx) + ", " + std::to_string(k / nx) + ")";
}

}  // namespace

struct Surface::Heights {
  Grid grid;
  Field field;
  std::size_t measured;
  mutable Lazy<std::string> digest;
  mutable Lazy<Range> range;

  Heights(const Grid& g, Field f, std::size_t m) : grid(g), field(std::move(f)), measured(m) {}
};

Surface::Surface(const Grid& grid, Field heights, SurfaceTraits traits)
    : Surface(grid, std::move(heights), std::move(traits), false) {}

Surface Surface::with_holes(const Grid& grid, Field heights, SurfaceTraits traits) {
  return Surface(grid, std::move(heights), std::move(traits), true);
}

Surface::Surface(const Grid& grid, Field heights, SurfaceTraits traits, bool holes)
    : traits_(std::move(traits)) {
  if (heights.nx() != grid.nx || heights.ny() != grid.ny)
    throw Error(ErrorCode::internal, "a surface of " + std::to_string(grid.nx) + " x " +
                                         std::to_string(grid.ny) + " cells was given " +
                                         std::to_string(heights.nx()) + " x " + std::to_string(heights.ny()) +
                                         " heights");
  std::size_t missing = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (std::isfinite(heights[k])) continue;
    if (!holes || !std::isnan(heights[k]))
      refuse("the height at node " + at_node(k, grid) + " is " + format_short(heights[k]),
             "every height must be a finite number of metres");
    heights[k] = std::numeric_limits<double>::quiet_NaN();  // one bit pattern
    ++missing;
  }
  if (missing == heights.size()) refuse("no point of the surface was measured", "give at least one height");
  const std::size_t measured = heights.size() - missing;
  data_ = std::make_shared<const Heights>(grid, std::move(heights), measured);
}

Surface::Surface(std::shared_ptr<const Heights> heights, SurfaceTraits traits)
    : data_(std::move(heights)), traits_(std::move(traits)) {}

const Grid& Surface::grid() const { return data_->grid; }
const Field& Surface::measured_heights() const { return data_->field; }
std::size_t Surface::measured() const { return data_->measured; }

const Field& Surface::heights() const {
  if (complete()) return data_->field;
  const std::span<const double> values = data_->field.values();
  const auto first = std::find_if(values.begin(), values.end(), [](double z) { return std::isnan(z); });
  refuse(std::to_string(values.size() - measured()) + " of the " + std::to_string(values.size()) +
             " points of the surface were not measured, the first at node " +
             at_node(static_cast<std::size_t>(first - values.begin()), grid()) +
             ", and this needs every point",
         "fill them first, `surface:filled{ by=\"interpolate\" }`, or crop to a part without holes");
}

double Surface::height(double i, double j) const { return node_value(measured_heights(), i, j); }

Range Surface::height_range() const {
  return data_->range.get([&] { return known_range(data_->field.values()); });
}

Surface Surface::with_material(Material material) const {
  SurfaceTraits traits = traits_;
  traits.material = std::move(material);
  Surface result(data_, std::move(traits));
  result.recipe_ = recipe_;
  return result;
}

Surface Surface::made_by(SurfaceRecipe recipe) const {
  Surface result = *this;
  result.recipe_ = std::make_shared<const SurfaceRecipe>(std::move(recipe));
  return result;
}

std::optional<Surface> Surface::remade(int nx, int ny, Monitor& monitor) const {
  if (!recipe_) return {};
  try {
    Surface result = (*recipe_)(nx, ny, monitor);
    result.traits_.material = traits_.material;
    result.recipe_ = recipe_;
    return result;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_value) throw;
    return {};
  }
}

const std::string& Surface::digest() const {
  return data_->digest.get([&] {
    const Grid& g = data_->grid;
    Digester digester;
    digester.add("surface").add(g.nx).add(g.ny).add(g.size_x).add(g.size_y).add(data_->field.values());
    return digester.hex();
  });
}

}  // namespace asperity
