// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/friction/law.hpp"

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/contact/effects/interlocking.hpp"

namespace asperity::lua {

Option<OnKeys> rest_option() {
  return quantity("rest", &OnKeys::rest, dimension::time, at_least(0),
                  "how long the junctions stand still under the load first; needs ageing");
}

namespace {

const Block<FrictionOptions>& friction_block() {
  using O = FrictionOptions;
  static const Block<O> block{
      "lab.friction",
      {quantity("tau0", &O::tau0, dimension::pressure, at_least(0), "adhesive shear strength of a junction")
           .required(),
       number("alpha", &O::alpha, at_least(0), "growth of the strength with pressure").required(),
       quantity("tau_max", &O::tau_max, dimension::pressure, above(0).or_never(),
                "greatest strength of a junction"),
       quantity("yield_pressure", &O::yield_pressure, dimension::pressure, above(0).or_never(),
                "sets tau_max = tau0 + alpha * yield_pressure")}};
  return block;
}

Values make_law(Call& call) { return {object(JunctionLaw(call.options(friction_block())))}; }

const Block<OnKeys>& on_block() {
  static const Block<OnKeys> block{"on", {rest_option()}};
  return block;
}

Values law_on(Call& call) {
  const auto& state = call.object<asperity::State>(1, "st");
  const OnKeys keys = call.options(on_block(), 2);
  const CostScope scope;
  const FrictionResult r = call.self<JunctionLaw>().on(state, keys.rest);
  if (state.effects().has<InterlockingOptions>()) {
    const std::pair<std::string, Cost> cost{"interlocking", scope.so_far()};
    call.session().ledger->add_effects({&cost, 1});
  }
  Record record;
  record.name = "friction";
  record.add("force", r.force, dimension::force)
      .add("mu", Value(r.mu))
      .add("adhesive_force", r.adhesive_force, dimension::force)
      .add("load_force", r.load_force, dimension::force)
      .add("capped_fraction", r.capped_fraction);
  record.add_if("interlocking", "interlocking_force", r.interlocking_force, dimension::force)
      .add_if("ageing", "strengthening", r.strengthening);
  return {std::move(record)};
}

std::string describe_law(const void* self) { return static_cast<const JunctionLaw*>(self)->text(); }

}  // namespace

Function friction_function() {
  return {.name = "friction",
          .body = make_law,
          .sentence =
              "The strength of junctions, tau = min(tau0 + alpha P, tau_max) (Hanaor, Gan and Einav 2013, "
              "eq. 1).",
          .options = &friction_block(),
          .returns = "Law",
          .example = "local law = lab.friction{ tau0=\"500 MPa\", alpha=0.2 }"};
}

template <>
const Class& class_of<JunctionLaw>() {
  static const Class type = [] {
    Class c;
    c.name = "Law";
    c.article_name = "a law";
    c.sentence = "A friction law of junctions.";
    c.describe = describe_law;
    c.fields = {
        {"tau0", "number", "adhesive strength", dimension::pressure,
         [](Call& call) -> Values { return {call.self<JunctionLaw>().tau0()}; }},
        {"alpha",
         "number",
         "growth with pressure",
         {},
         [](Call& call) -> Values { return {call.self<JunctionLaw>().alpha()}; }},
        {"tau_max", "number", "greatest strength; nil without a cap", dimension::pressure,
         [](Call& call) -> Values { return {Value(call.self<JunctionLaw>().tau_max())}; }},
    };
    c.methods = {{.name = "on",
                  .body = law_on,
                  .sentence = "The friction of a state: force, mu, its adhesive and load parts, and the "
                              "share of the area at the cap; with interlocking also what the slopes of the "
                              "junctions add, with ageing by what tau0 grew.",
                  .parameters = {{"st", "State", "the contact under load"}},
                  .options = &on_block(),
                  .options_optional = true,
                  .returns = "table",
                  .example = "print(law:on(st).mu)"}};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
