// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/specimen/contact.hpp"

namespace asperity::lua {

namespace {

struct ShearKeys {
  std::optional<double> force, ratio;
  double friction = 0;
  std::shared_ptr<JunctionLaw> law;
};

// A coefficient or a friction law.
void read_friction(const Argument& value, const OptionInfo& info, ShearKeys& keys, Problems& problems) {
  Object* object = value.as_object(class_of<JunctionLaw>());
  if (object == nullptr) {
    if (value.as_any_object() != nullptr || value.is_table())
      return detail::wrong_type(value, info, "a number, or a law from lab.friction", problems);
    if (auto number = detail::read_quantity(value, info, above(0), problems)) keys.friction = *number;
  } else if (object->closed) {
    problems.push_back("`friction` was closed");
  } else if (object->pointer != nullptr) {
    keys.law = std::static_pointer_cast<JunctionLaw>(object->pointer);
  }
}

const Block<ShearKeys> shear_block{
    {quantity("force", &ShearKeys::force, dimension::force, at_least(0),
              "that pulls the whole tile sideways"),
     number("ratio", &ShearKeys::ratio, between(0, 1),
            "of that force over the one that slides, friction times load"),
     custom<ShearKeys>("friction", "number|Law",
                       "Coulomb's coefficient; a law gives its mean coefficient on the contact",
                       read_friction)
         .shown_by(
             [](const ShearKeys& keys) { return keys.law ? keys.law->text() : format_exact(keys.friction); })
         .required()},
    [](ShearKeys& keys, Problems& problems) {
      if (keys.force.has_value() == keys.ratio.has_value())
        problems.push_back(std::string("give exactly one of `force` and `ratio`; ") +
                           (keys.force ? "both are" : "none is") + " given");
    }};

Values shear(Call& call) {
  const ShearKeys keys = call.options(shear_block);
  auto& pair = call.self<SpecimenPair>();
  require_tangential(pair.scene().effects);
  ShearRequest request{keys.force, keys.ratio, keys.friction};
  if (keys.law && pair.pressed() != nullptr) request.friction = keys.law->on(*pair.pressed()).mu.value_or(0);
  PartialSlip slip = pair.shear(request, call.session().monitor());
  call.session().ledger->add_effects(slip.cost().by_effect);
  return {object(std::move(slip))};
}

Values slip_field(Call& call) {
  const auto& slip = call.self<PartialSlip>();
  const std::string name = call.text(1, "name");
  return {object(NamedField{name, slip.normal().geometry().grid(),
                            std::make_shared<const Field>(slip.field(name)),
                            name == "shear" ? dimension::pressure : dimension::number})};
}

}  // namespace

Function shear_method() {
  return {.name = "shear",
          .body = shear,
          .sentence =
              "Pulls the contact under its present load sideways, with less than the sliding force, and "
              "finds the slipping part (Cattaneo and Mindlin for spheres; by Jaeger and Ciavarella the "
              "difference of two normal contacts). Nothing of the contact changes; needs tangential.",
          .options = &shear_block,
          .returns = "Shear",
          .example = "local q = c:shear{ ratio=0.5, friction=0.3 }",
          .heavy = true};
}

Class make_class(For<PartialSlip>) {
  using S = PartialSlip;
  Class c{"Shear", "a shear", "A contact under load, pulled sideways: one part sticks, the rest slips."};
  c.describe = text_of<&PartialSlip::text>;
  c.digest = from_value([](const PartialSlip& slip) {
    return slip.normal().digest() + "+" + format_exact(slip.friction()) + "+" + format_exact(slip.ratio());
  });
  c.fields = {
      getter<&S::load>("load", "number", "force that presses the whole tile", dimension::force),
      getter<&S::force>("force", "number", "force that pulls the whole tile sideways", dimension::force),
      getter<&S::ratio>("ratio", "number", "of that force over the one that slides"),
      getter<&S::friction>("friction", "number", "Coulomb's coefficient"),
      getter<&S::slides>("slides", "boolean", "whether all of the contact slips"),
      getter<&S::stick_area>("stick_area", "number", "area that sticks", dimension::area),
      getter<&S::stick_fraction>("stick_fraction", "number", "of the contact area that sticks"),
      getter<&S::slip_fraction>("slip_fraction", "number", "of the contact area that slips"),
      getter<&S::displacement>("displacement", "number", "of the bodies over each other, along the force",
                               dimension::length),
      getter<&S::stiffness>(
          "stiffness", "number",
          "d shear stress / d displacement at this force, over the nominal area; 0 where all slips",
          dimension::stiffness),
      getter<S>("cost", "Cost", "seconds, transforms and bytes of the second normal solve",
                [](const S& of) { return cost_type()(of.cost().total); }),
  };
  c.methods = {
      {.name = "field",
       .body = slip_field,
       .sentence = "A field over the tile: the shear traction along the force, or 1 where it sticks.",
       .parameters = {{"name", "\"shear\"|\"stick\"", "which"}},
       .returns = "Field",
       .example = "q:field \"shear\":picture \"shear.png\""}};
  return c;
}

}  // namespace asperity::lua
