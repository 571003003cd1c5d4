// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/value.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"
#include "engine/metrology/parameters/areal_parameters.hpp"
#include "engine/plot/picture.hpp"
#include "engine/surface/material.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::lua {

Class make_class(For<Surface>);
Class make_class(For<Profile>);

Module surface_module();
Module profile_module();

// Methods that return surfaces and profiles.
std::vector<Function> surface_operations();
// a + b, a - b, -a, 2 * a, a / 2.
std::vector<Operator> surface_operators();

Function registered_to_method();
std::vector<const RecordInfo*> registration_types();

// s:areal_parameters{...}, s:bearing(), s:autocorrelation(), s:scale_dependence{...}, s:reliability{...} and
// their record types.
std::vector<Function> parameter_methods();
std::vector<const RecordInfo*> parameter_results();
Class make_class(For<ArealParameters>);
Class make_class(For<MaterialRatioCurve>);
Class make_class(For<Autocorrelation>);

// p:profile_parameters{...}, p:primary_parameters{...} and p:bearing().
std::vector<Function> profile_parameter_methods();
std::vector<const RecordInfo*> profile_parameter_results();

std::vector<Getter> missing_point_fields_of_surface();
std::vector<Getter> missing_point_fields_of_profile();
std::vector<Function> missing_point_methods_of_surface();
std::vector<Function> missing_point_methods_of_profile();
const RecordInfo& outliers_type(bool surface);
// ", 12 of 4096 points not measured"; "" if complete.
std::string missing_text(std::size_t measured, std::size_t points);

// Materials, and keys of surface generators: `cells`, `size`, `material`.
Class make_class(For<Material>);

// Defined in material.cpp.
Function material_function();

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
                          "material of the body");
}
inline Option<GridKeys> material_key() { return material_key(&GridKeys::body_material); }

// Fields over grid nodes: results of a state, masks.
struct NamedField {
  std::string name;
  Grid grid;
  std::shared_ptr<const Field> values;
  Dimension dimension;
};

Class make_class(For<NamedField>);

// Picture options of surfaces and fields.
extern const Block<PictureOptions> picture_block;

}  // namespace asperity::lua
