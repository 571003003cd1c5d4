// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

const Block<Material> material_block{{
    quantity("young", &Material::young, dimension::pressure, above(0), "Young's modulus"),
    number("poisson", &Material::poisson, {-1, 0.5, true, false, false}, "Poisson's ratio"),
    quantity("hardness", &Material::hardness, dimension::pressure, above(0).or_never(),
             "indentation hardness; effects.plasticity states the shares of two yielding bodies"),
    quantity("density", &Material::density, dimension::density, above(0), "mass per volume"),
    text("name", &Material::name, "its name"),
}};

Values make_material(Call& call) {
  const Argument first = call.argument(1);
  if (first.is_text()) return {object(named_material(first.text()))};
  if (first.is_nil())
    refuse("lab.material was given nothing (nil)",
           "give a name, such as lab.material \"Al-2011\", or a table of properties");
  Material material = call.options(material_block);
  if (material.name.empty()) material.name = "unnamed";
  check(material);
  return {object(std::move(material))};
}

std::string describe_material(const Material& m) {
  if (m.rigid) return "rigid body";
  std::string text = m.name;
  if (m.young) text += ": E " + format_quantity(*m.young, dimension::pressure);
  if (m.poisson) text += ", nu " + format_short(*m.poisson);
  if (m.hardness) text += ", hardness " + format_quantity(*m.hardness, dimension::pressure);
  if (m.density) text += ", density " + format_short(*m.density) + " kg/m^3";
  return text;
}

bool equal_materials(const void* a, const void* b) {
  const auto& x = *static_cast<const Material*>(a);
  const auto& y = *static_cast<const Material*>(b);
  return x.name == y.name && x.young == y.young && x.poisson == y.poisson && x.hardness == y.hardness &&
         x.density == y.density && x.rigid == y.rigid;
}

}  // namespace

Function material_function() {
  return {.name = "material",
          .body = make_material,
          .sentence = "A material by name (lab.materials lists them), or from a table of properties.",
          .options = &material_block,
          .returns = "Material",
          .example = "local al = lab.material \"Al-2011\""};
}

Class make_class(For<Material>) {
  return {
      .name = "Material",
      .article_name = "a material",
      .sentence =
          "The material of a body; an effect reads the properties it needs and names any that is missing.",
      .fields = {getter<&Material::name>("name", "string", "its name"),
                 getter<&Material::young>("young", "number", "Young's modulus", dimension::pressure),
                 getter<&Material::poisson>("poisson", "number", "Poisson's ratio"),
                 getter<&Material::hardness>("hardness", "number", "indentation hardness",
                                             dimension::pressure),
                 getter<&Material::density>("density", "number", "mass per volume", dimension::density),
                 getter<&Material::source>("source", "string", "source of the numbers")},
      .describe = text_of<describe_material>,
      .equal = equal_materials,
  };
}

}  // namespace asperity::lua
