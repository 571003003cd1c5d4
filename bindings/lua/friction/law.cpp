// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/friction/law.hpp"

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/state.hpp"

namespace asperity::lua {

Option<OnKeys> rest_option() {
  return quantity("rest", &OnKeys::rest, dimension::time, at_least(0),
                  "rest of the junctions under the load before the pull; needs ageing");
}

namespace {

const Block<FrictionOptions> friction_block{
    {quantity("tau0", &FrictionOptions::tau0, dimension::pressure, at_least(0),
              "adhesive shear strength of a junction")
         .required(),
     number("alpha", &FrictionOptions::alpha, at_least(0), "growth of the strength with pressure").required(),
     quantity("tau_max", &FrictionOptions::tau_max, dimension::pressure, above(0).or_never(),
              "greatest strength of a junction"),
     quantity("yield_pressure", &FrictionOptions::yield_pressure, dimension::pressure, above(0).or_never(),
              "sets tau_max = tau0 + alpha * yield_pressure")}};

Values make_law(Call& call) {
  const JunctionLaw law(call.options(friction_block));
  if (law.tau_max() && *law.tau_max() < law.tau0())
    call.warn("`tau_max` of " + format_quantity(*law.tau_max(), dimension::pressure) +
              " is below `tau0` of " + format_quantity(law.tau0(), dimension::pressure) +
              "; every junction has the strength `tau_max`, and `alpha` has no effect");
  return {object(law)};
}

const Block<OnKeys> on_block{{rest_option()}};

const RecordType<FrictionResult> friction_type{
    "Friction",
    "friction",
    "The friction of a contact under load by a law.",
    {{"force", &FrictionResult::force, dimension::force, "that the whole tile bears before it slides"},
     {"mu", &FrictionResult::mu, "force over the applied load; nil without load"},
     {"adhesive_force", &FrictionResult::adhesive_force, dimension::force,
      "the part that tau0 gives, or the cap where that is lower"},
     {"load_force", &FrictionResult::load_force, dimension::force, "the part that comes with pressure"},
     {"capped_fraction", &FrictionResult::capped_fraction,
      "share of the real contact area at the cap; 0 without contact"},
     RecordField<FrictionResult>("interlocking_force", &FrictionResult::interlocking_force, dimension::force,
                                 "beyond that of the same junctions lying level")
         .needs("interlocking"),
     RecordField<FrictionResult>("strengthening", &FrictionResult::strengthening,
                                 "tau0 after the rest over tau0 without one")
         .needs("ageing")}};

Values law_on(Call& call) {
  const auto& state = call.object<asperity::State>(1, "st");
  const OnKeys keys = call.options(on_block, 2);
  const CostScope scope;
  const FrictionResult r = call.self<JunctionLaw>().on(state, keys.rest);
  if (state.effects().has<InterlockingOptions>()) {
    const std::pair<std::string, Cost> cost{"interlocking", scope.so_far()};
    call.session().ledger->add_effects({&cost, 1});
  }
  for (const std::string& limit : state_limits(state)) call.warn(limit);
  return {friction_type(r)};
}

}  // namespace

Function friction_function() {
  return {.name = "friction",
          .body = make_law,
          .sentence =
              "The strength of junctions, tau = min(tau0 + alpha P, tau_max) (Hanaor, Gan and Einav 2013, "
              "eq. 1).",
          .options = &friction_block,
          .returns = "Law",
          .example = "local law = lab.friction{ tau0=\"500 MPa\", alpha=0.2 }"};
}

Class make_class(For<JunctionLaw>) {
  Class c{"Law", "a law", "A friction law of junctions."};
  c.describe = text_of<&JunctionLaw::text>;
  c.fields = {
      getter<&JunctionLaw::tau0>("tau0", "number", "adhesive strength", dimension::pressure),
      getter<&JunctionLaw::alpha>("alpha", "number", "growth with pressure"),
      getter<&JunctionLaw::tau_max>("tau_max", "number", "greatest strength; nil without a cap",
                                    dimension::pressure),
  };
  c.methods = {{.name = "on",
                .body = law_on,
                .sentence = "The friction of a contact under load.",
                .parameters = {{"st", "State", "the contact under load"}},
                .options = optional(on_block),
                .returns = "Friction",
                .example = "print(law:on(st).mu)"}};
  c.results = {&friction_type};
  return c;
}

}  // namespace asperity::lua
