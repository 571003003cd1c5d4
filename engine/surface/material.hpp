// SPDX-License-Identifier: GPL-3.0-or-later
// A material: what an effect may ask of a body. Every property but the name is optional; an effect
// that reads a missing one refuses and names itself, the body and the property.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace asperity {

struct Material {
  std::string name;
  std::optional<double> young;     // Pa, Young's modulus, > 0
  std::optional<double> poisson;   // Poisson's ratio, in (-1, 0.5]
  std::optional<double> hardness;  // Pa, indentation hardness, > 0
  std::optional<double> density;   // kg/m³, > 0
  std::string source;              // where the numbers of a named material come from
  bool rigid = false;
};

// The materials known by name, in the order they are listed.
std::span<const Material> named_materials();
// Throws Error{unknown_name} with the nearest name.
const Material& named_material(std::string_view name);
// Infinitely stiff and hard.
const Material& rigid_material();
// Throws Error{bad_value} for the first property out of its range.
void check(const Material& material);

// E/(1-ν²) of one body, Pa; infinite for a rigid one. Throws Error{bad_state} naming what is missing.
double plane_strain_modulus(const Material& material);

}  // namespace asperity
