// SPDX-License-Identifier: GPL-3.0-or-later
// Material properties. An effect refuses a body without a property it reads, and names both.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace asperity {

struct Material {
  std::string name;
  std::optional<double> young{};     // Pa, > 0
  std::optional<double> poisson{};   // in (-1, 0.5]
  std::optional<double> hardness{};  // Pa, indentation hardness, > 0
  std::optional<double> density{};   // kg/m³, > 0
  std::string source{};
  bool rigid = false;
};

std::span<const Material> named_materials();
const Material& named_material(std::string_view name);
// Infinitely stiff and hard.
const Material& rigid_material();
// Throws Error{bad_value} for the first property out of range.
void check(const Material& material);

// E/(1-ν²), Pa; infinite if rigid. Throws Error{bad_state} for a missing property.
double plane_strain_modulus(const Material& material);

}  // namespace asperity
