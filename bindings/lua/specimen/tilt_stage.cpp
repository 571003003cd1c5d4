// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/tilt_stage.hpp"

#include <numbers>

#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "engine/specimen/slip_growth.hpp"

namespace asperity::lua {

namespace {

struct StageKeys : TiltTrialOptions {
  std::shared_ptr<SpecimenPair> contact;
  std::shared_ptr<JunctionLaw> law;
  double mass = 0, gravity = TiltOptions{}.gravity, step = TiltOptions{}.step, limit = TiltOptions{}.limit;
  bool probe_given = false;
};
const Block<StageKeys>& stage_block() {
  using K = StageKeys;
  static const Block<K> block{
      "lab.tilt_stage",
      {native<SpecimenPair>("contact", &K::contact, "Contact", "a contact, from lab.contact",
                            "what lies on the stage")
           .required(),
       native<JunctionLaw>("friction", &K::law, "Law", "a law, from lab.friction",
                           "strength of its junctions")
           .required(),
       quantity("mass", &K::mass, dimension::mass, above(0), "of the specimen").required(),
       Option<K>(quantity("specimen_area", &TiltTrialOptions::specimen_area, dimension::area, above(0),
                          "nominal area over which the weight spreads"))
           .defaults_to("the tile"),
       quantity("step", &K::step, dimension::angle, above(0), "the stage is raised in"),
       quantity("limit", &K::limit, dimension::angle, {0, std::numbers::pi / 2, true, false, false},
                "greatest angle of the stage"),
       quantity("gravity", &K::gravity, dimension::acceleration, above(0), "acceleration of free fall"),
       custom<K>("probe_pressure", "a pressure[]",
                 "at which a half-space contact is solved, each raised until enough nodes touch; a box "
                 "contact is solved at its weight, and so is a half-space whose weight presses harder than "
                 "the least of these",
                 [](const Argument& value, const OptionInfo& info, K& keys, Problems& problems) {
                   OptionInfo pressure = info;
                   pressure.dimension = dimension::pressure;
                   keys.probe_given = true;
                   keys.probe_pressures.clear();
                   const auto read = [&](const Argument& part) {
                     if (auto p = detail::read_quantity(part, pressure, above(0), problems))
                       keys.probe_pressures.push_back(*p);
                   };
                   if (!value.is_table()) return read(value);
                   if (value.length() == 0)
                     return problems.push_back(
                         "`probe_pressure` is an empty list; give one pressure or more");
                   for (std::int64_t k = 1; k <= value.length(); ++k) value.element(k, read);
                 })
           .defaults_to("{\"1 MPa\", \"3 MPa\"}"),
       number("scatter", &TiltTrialOptions::scatter, at_least(0),
              "relative standard deviation of the friction force from trial to trial")}};
  return block;
}

Values make_stage(Call& call) {
  const StageKeys keys = call.options(stage_block());
  const bool half_space = keys.contact && keys.contact->scene().elasticity.model().moves_every_node;
  if (keys.probe_given && !half_space)
    call.session().monitor().warn(
        "`probe_pressure` is for half-space contacts; a box contact is solved at its weight");
  TiltStage stage{keys.contact, keys.law, keys};
  stage.options.stage = {keys.mass, keys.gravity, keys.step, keys.limit};
  check(stage.options.stage);
  return {object(std::move(stage))};
}

struct RaiseKeys : OnKeys {
  int repeats = TiltTrialOptions{}.repeats;
  std::uint64_t seed = 1;
};
const Block<RaiseKeys>& raise_block() {
  static const Block<RaiseKeys> block{
      "raise",
      {integer("repeats", &RaiseKeys::repeats, between(1, 100000), "number of trials"),
       integer("seed", &RaiseKeys::seed, at_least(0), "of placements and scatter"), rest_option()}};
  return block;
}

struct GrowthKeys : OnKeys {
  int steps = 10;
  std::uint64_t seed = 1;
};
const Block<GrowthKeys>& growth_block() {
  static const Block<GrowthKeys> block{
      "slip_growth",
      {integer("steps", &GrowthKeys::steps, between(1, 10000), "equal steps of the angle up to the slip"),
       integer("seed", &GrowthKeys::seed, at_least(0), "of the placement"), rest_option()}};
  return block;
}

Values grow_slip(Call& call) {
  const GrowthKeys keys = call.options(growth_block());
  const TiltStage& stage = call.self<TiltStage>();
  TiltTrialOptions options = stage.options;
  options.seed = keys.seed;
  options.rest = keys.rest;
  List list;
  for (const SlipShare& share :
       slip_growth(*stage.contact, *stage.law, options, keys.steps, call.session().monitor())) {
    Record record;
    record.name = "slip";
    record.add("angle", share.angle, dimension::angle)
        .add("ratio", share.ratio)
        .add("slip_fraction", share.slip_fraction)
        .add("displacement", share.displacement, dimension::length);
    list.items.emplace_back(std::move(record));
  }
  return {std::move(list)};
}

Values raise_stage(Call& call) {
  const RaiseKeys keys = call.options(raise_block());
  const TiltStage& stage = call.self<TiltStage>();
  TiltTrialOptions options = stage.options;
  options.repeats = keys.repeats;
  options.seed = keys.seed;
  options.rest = keys.rest;
  const TiltResult result = raise(*stage.contact, *stage.law, options, call.session().monitor());
  List trials;
  for (const SlipAngle& trial : result.trials) {
    Record record;
    record.name = "trial";
    record.add("angle", trial.angle, dimension::angle)
        .add("held", trial.held, dimension::angle)
        .add("slipped", trial.slipped);
    trials.items.emplace_back(std::move(record));
  }
  List probes;
  for (const TiltProbe& probe : result.probes) {
    Record record;
    record.name = "probe";
    record.add("pressure", probe.pressure, dimension::pressure)
        .add("contacts", probe.contacts)
        .add("area_per_load", probe.area_per_load)
        .add("mu", probe.mu);
    probes.items.emplace_back(std::move(record));
  }
  Record record;
  record.name = result.slipped ? "tilt" : "tilt (does not slip)";
  record.add("angle", result.angle, dimension::angle)
      .add("held", result.held, dimension::angle)
      .add("mu", result.mu)
      .add("spread", result.spread)
      .add("slipped", result.slipped)
      .add("trials", std::move(trials))
      .add("area_per_load", Value(result.area_per_load))
      .add("probe_spread", Value(result.probe_spread))
      .add("solved_at_weight", !result.at_weight.empty())
      .add("probes", std::move(probes))
      .add("note", result.note.empty() ? Value() : Value(result.note));
  return {std::move(record)};
}

std::string describe_stage(const void* self) {
  const auto& stage = *static_cast<const TiltStage*>(self);
  return "tilt stage: mass " + format_quantity(stage.options.stage.mass, dimension::mass) + ", " +
         stage.law->text();
}

}  // namespace

Function tilt_stage_function() {
  return {.name = "tilt_stage",
          .body = make_stage,
          .sentence = "A stage that is raised until the specimen slides, T(W cos a) = W sin a.",
          .options = &stage_block(),
          .returns = "TiltStage",
          .example = "local stage = lab.tilt_stage{ contact=c, friction=law, mass=\"4.3 g\" }"};
}

template <>
const Class& class_of<TiltStage>() {
  static const Class type = [] {
    Class c;
    c.name = "TiltStage";
    c.article_name = "a tilt stage";
    c.sentence = "A tilt stage with a specimen on it.";
    c.shareable = false;
    c.describe = describe_stage;
    c.methods = {
        {.name = "raise",
         .body = raise_stage,
         .sentence =
             "Raises the stage until the specimen slides, several times. angle is exact; "
             "held is the last step that "
             "held, the source paper's measure; mu = tan(held), so mu goes in the steps of the stage "
             "and tan(angle) does not. trials holds angle and held of each trial, spread the standard "
             "deviation of their mu.",
         .options = &raise_block(),
         .options_optional = true,
         .returns = "table",
         .example = "local t = stage:raise{ repeats=5, seed=1 }",
         .heavy = true},
        {.name = "slip_growth",
         .body = grow_slip,
         .sentence = "Which part of the contact slips at each angle before the specimen slides, as a "
                     "list of angle, ratio (the pull over the one that slides), slip_fraction and, "
                     "for boxes, displacement; needs tangential.",
         .options = &growth_block(),
         .options_optional = true,
         .returns = "table[]",
         .example = "for _, at in ipairs(stage:slip_growth{ steps=10 }) do print(at.angle, "
                    "at.slip_fraction) end",
         .heavy = true}};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
