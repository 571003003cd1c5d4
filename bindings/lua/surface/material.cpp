// SPDX-License-Identifier: GPL-3.0-or-later
// lab.material: a known name or a table of properties.
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/surface/grid_keys.hpp"

namespace asperity::lua {

namespace {

const Block<Material>& material_block() {
  static const Block<Material> block{
      "lab.material",
      {
          quantity("young", &Material::young, dimension::pressure, above(0), "Young's modulus"),
          number("poisson", &Material::poisson, {-1, 0.5, true, false, false}, "Poisson's ratio"),
          quantity("hardness", &Material::hardness, dimension::pressure, above(0).or_never(),
                   "indentation hardness; effects.plasticity tells how two bodies share what yields"),
          quantity("density", &Material::density, dimension::density, above(0), "mass per volume"),
          text("name", &Material::name, "what to call it"),
      }};
  return block;
}

Values make_material(Call& call) {
  const Argument first = call.argument(1);
  if (first.is_text()) return {object(named_material(first.text()))};
  if (first.is_nil())
    throw Error(ErrorCode::bad_value, "lab.material was given nothing (nil)",
                "give a name, such as lab.material \"Al-2011\", or a table of properties");
  Material material = call.options(material_block());
  if (material.name.empty()) material.name = "unnamed";
  check(material);
  return {object(std::move(material))};
}

std::string describe_material(const void* self) {
  const auto& m = *static_cast<const Material*>(self);
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
  Function f;
  f.name = "material";
  f.body = make_material;
  f.sentence = "A material by name (lab.materials lists them), or from a table of properties.";
  f.options = &material_block();
  f.returns = "Material";
  f.example = "local al = lab.material \"Al-2011\"";
  return f;
}

Value materials_list() {
  List list;
  for (const Material& material : named_materials()) list.items.push_back(object(material));
  return list;
}

Value rigid_value() { return object(rigid_material()); }

template <>
const Class& class_of<Material>() {
  static const Class type = {
      .name = "Material",
      .article_name = "a material",
      .sentence =
          "What a body is made of; an effect reads the properties it needs and names any that is missing.",
      .fields = {getter<&Material::name>("name", "string", "what it is called"),
                 getter<&Material::young>("young", "number", "Young's modulus", dimension::pressure),
                 getter<&Material::poisson>("poisson", "number", "Poisson's ratio"),
                 getter<&Material::hardness>("hardness", "number", "indentation hardness",
                                             dimension::pressure),
                 getter<&Material::density>("density", "number", "mass per volume", dimension::density),
                 getter<&Material::source>("source", "string", "where the numbers come from")},
      .describe = describe_material,
      .equal = equal_materials,
  };
  return type;
}

}  // namespace asperity::lua
