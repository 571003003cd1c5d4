// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/surface.hpp"

#include <cmath>
#include <mutex>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/node_value.hpp"
#include "engine/core/text.hpp"

namespace asperity {

struct Surface::Heights {
  Grid grid;
  Field field;
  mutable std::once_flag digest_once, range_once;
  mutable std::string digest;
  mutable Range range;

  Heights(const Grid& g, Field f) : grid(g), field(std::move(f)) {}
};

Surface::Surface(const Grid& grid, Field heights, SurfaceTraits traits) : traits_(std::move(traits)) {
  if (heights.nx() != grid.nx || heights.ny() != grid.ny)
    throw Error(ErrorCode::internal, "a surface of " + std::to_string(grid.nx) + " x " +
                                         std::to_string(grid.ny) + " cells was given " +
                                         std::to_string(heights.nx()) + " x " + std::to_string(heights.ny()) +
                                         " heights");
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!std::isfinite(heights[k])) {
      const auto nx = static_cast<std::size_t>(grid.nx);
      throw Error(ErrorCode::bad_value,
                  "the height at node (" + std::to_string(k % nx) + ", " + std::to_string(k / nx) + ") is " +
                      format_short(heights[k]),
                  "every height must be a finite number of metres");
    }
  }
  data_ = std::make_shared<const Heights>(grid, std::move(heights));
}

Surface::Surface(std::shared_ptr<const Heights> heights, SurfaceTraits traits)
    : data_(std::move(heights)), traits_(std::move(traits)) {}

const Grid& Surface::grid() const { return data_->grid; }
const Field& Surface::heights() const { return data_->field; }

double Surface::height(double i, double j) const { return node_value(heights(), i, j); }

Range Surface::height_range() const {
  std::call_once(data_->range_once, [&] { data_->range = range(data_->field.values()); });
  return data_->range;
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
  std::call_once(data_->digest_once, [&] {
    const Grid& g = data_->grid;
    Digester digester;
    digester.add("surface").add(g.nx).add(g.ny).add(g.size_x).add(g.size_y).add(data_->field.values());
    data_->digest = digester.hex();
  });
  return data_->digest;
}

}  // namespace asperity
