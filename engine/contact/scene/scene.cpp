// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

std::string tile(const Grid& g) {
  return std::to_string(g.nx) + " x " + std::to_string(g.ny) + " cells on " +
         format_quantity(g.size_x, dimension::length, 6) + " x " +
         format_quantity(g.size_y, dimension::length, 6);
}

// Up to rounding (3 · 50 against 150).
bool same_length(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(a, b); }

void require_complete(const Surface& body, const std::string& which) {
  if (body.complete()) return;
  const std::size_t all = body.grid().nodes();
  refuse(std::to_string(all - body.measured()) + " of the " + std::to_string(all) + " points of the " +
             which + " body were not measured, and a contact needs every point",
         "fill them first, `" + which +
             " = surface:filled{ by=\"interpolate\" }`, or crop the surface to a part without holes");
}

}  // namespace

std::string_view name(Boundary boundary) { return boundary == Boundary::periodic ? "periodic" : "free"; }

void check_tiles(const Grid& lower, const Grid& upper) {
  if (lower.nx == upper.nx && lower.ny == upper.ny && same_length(lower.size_x, upper.size_x) &&
      same_length(lower.size_y, upper.size_y))
    return;
  refuse("the lower body has " + tile(lower) + ", the upper body " + tile(upper),
         "both need the same `cells` and `size`: bring one to the other with `:resampled{cells=}` or "
         "`:cropped{...}`");
}

void check(const Scene& scene) {
  const Grid& grid = scene.lower.grid();
  if (!std::isnormal(grid.cell_area()) || !std::isnormal(grid.area()))
    refuse("the lower body is " + format_short(grid.size_x) + " m by " + format_short(grid.size_y) +
               " m, an area outside the range of a double",
           "check the unit of `size`");
  if (const auto* rough = std::get_if<Surface>(&scene.upper)) check_tiles(scene.lower.grid(), rough->grid());
  if (const auto* flat = std::get_if<Material>(&scene.upper)) check(*flat);
  require_complete(scene.lower, "lower");
  if (const auto* rough = std::get_if<Surface>(&scene.upper)) require_complete(*rough, "upper");
  const double tolerance = scene.accuracy.tolerance;
  if (!(tolerance >= 1e-15 && tolerance < 1))
    refuse("`tolerance` is " + format_short(tolerance), "give a number from 1e-15 to below 1");
  const ElasticModel& model = scene.elasticity.model();
  check_options(model.options, scene.elasticity.options(), "elasticity=\"" + std::string(model.name) + "\"");
  if (model.is_local && scene.accuracy.precision == Accuracy::Precision::single)
    refuse("`precision` is \"single\" for " + std::string(model.noun),
           "leave `precision` out: they have a closed form in double precision");
  if (model.check != nullptr) model.check(scene.elasticity.options(), scene);
  for (const Effect* effect : known_effects())
    if (const std::any* options = scene.effects.options_of(*effect)) {
      check_options(effect->options, *options, "the effect " + quoted(effect->name));
      if (effect->check != nullptr) effect->check(*options, scene);
    }
}

}  // namespace asperity
