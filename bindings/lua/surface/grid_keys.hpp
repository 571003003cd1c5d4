// SPDX-License-Identifier: GPL-3.0-or-later
// Materials as native values, and the keys shared by surface generators: `cells`, `size`, `material`.
#pragma once

#include <optional>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/core/grid.hpp"
#include "engine/surface/material.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Material>();

// Defined in material.cpp.
Function material_function();
Value materials_list();
Value rigid_value();

struct GridKeys {
  int nx = 0, ny = 0;
  double size_x = 0, size_y = 0;
  std::optional<Material> body_material;
  Grid make() const { return make_grid(nx, ny, size_x, size_y); }
};

inline Option<GridKeys> size_key() {
  return pair_option("size", &GridKeys::size_x, &GridKeys::size_y, dimension::length, above(0),
                     "length of the sides: one value, or {along x, along y}");
}
inline Option<GridKeys> cells_key() { return cells_option(&GridKeys::nx, &GridKeys::ny); }
template <class O>
Option<O> material_key(std::optional<Material> O::*member) {
  return native<Material>("material", member, "Material", "a material, from lab.material",
                          "what the body is made of");
}
inline Option<GridKeys> material_key() { return material_key(&GridKeys::body_material); }

}  // namespace asperity::lua
