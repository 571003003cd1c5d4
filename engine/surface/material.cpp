// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/material.hpp"

#include <limits>
#include <vector>

#include "engine/core/require.hpp"

namespace asperity {

std::span<const Material> named_materials() {
  // Representative values.
  static const std::vector<Material> materials = {
      {"Al-2011", 70e9, 0.33, 1.1e9, 2830.0,
       "the alloy of the source paper; hardness from its Brinell number"},
      {"quartz", 95e9, 0.08, {}, 2650.0, "alpha quartz, average of directions; touched elastically"},
      {"steel", 210e9, 0.30, 2.0e9, 7850.0, "mild to medium carbon steel"},
      {"copper", 120e9, 0.34, 0.9e9, 8960.0, "half-hard copper"},
      {"gold", 79e9, 0.42, 0.6e9, 19300.0, "soft bulk gold"},
      {"silicon", 160e9, 0.22, 12.0e9, 2330.0, "single crystal, average of directions"},
      {"glass", 70e9, 0.22, 5.5e9, 2500.0, "soda-lime glass"},
      {"PMMA", 3.0e9, 0.37, 0.25e9, 1180.0, "acrylic at room temperature"},
      {"rubber", 3.0e6, 0.49, {}, 1100.0, "filled elastomer, small strain"},
  };
  return materials;
}

const Material& named_material(std::string_view name) {
  std::vector<std::string> names;
  for (const Material& material : named_materials()) {
    if (material.name == name) return material;
    names.push_back(material.name);
  }
  refuse_name(
      "there is no material " + quoted(name) + did_you_mean(name, names),
      "named materials are " + joined(names, " and ") + "; or give a table with `young` and `poisson`");
}

const Material& rigid_material() {
  static const Material rigid{.name = "rigid", .rigid = true};
  return rigid;
}

void check(const Material& m) {
  require_positive("young", m.young);
  require_positive("density", m.density);
  if (m.hardness) require(*m.hardness > 0, "hardness", *m.hardness, "", "give a value above zero");
  if (m.poisson)
    require(*m.poisson > -1 && *m.poisson <= 0.5, "poisson", *m.poisson, "",
            "give a number above -1 and at most 0.5");
}

double plane_strain_modulus(const Material& m) {
  if (m.rigid) return std::numeric_limits<double>::infinity();
  for (const auto& [value, key] : {std::pair{m.young, "young"}, std::pair{m.poisson, "poisson"}})
    if (!value)
      refuse_state("the material " + (m.name.empty() ? std::string("given") : quoted(m.name)) + " has no " +
                       quoted(key),
                   "give it in lab.material{...}");
  return *m.young / ((1.0 - *m.poisson) * (1.0 + *m.poisson));  // exact to rounding near -1
}

}  // namespace asperity
