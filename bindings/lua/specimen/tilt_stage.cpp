// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/tilt_stage.hpp"

#include <numbers>
#include <optional>

#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/specimen/contact.hpp"

namespace asperity::lua {

namespace {

struct StageKeys : TiltTrialOptions, TiltOptions {
  std::shared_ptr<SpecimenPair> contact;
  std::shared_ptr<JunctionLaw> law;
  bool probe_given = false;
};
const Block<StageKeys> stage_block{
    {native<SpecimenPair>("contact", &StageKeys::contact, "Contact", "a contact, from lab.contact",
                          "the contact on the stage")
         .required(),
     native<JunctionLaw>("friction", &StageKeys::law, "Law", "a law, from lab.friction",
                         "strength of its junctions")
         .required(),
     quantity("mass", &TiltOptions::mass, dimension::mass, above(0), "of the specimen").required(),
     quantity("specimen_area", &TiltTrialOptions::specimen_area, dimension::area, above(0),
              "nominal area over which the weight spreads")
         .defaults_to("the tile"),
     quantity("step", &TiltOptions::step, dimension::angle, above(0), "the stage is raised in"),
     quantity("limit", &TiltOptions::limit, dimension::angle, {0, std::numbers::pi / 2, true, false, false},
              "greatest angle of the stage"),
     quantity("gravity", &TiltOptions::gravity, dimension::acceleration, above(0),
              "acceleration of free fall"),
     custom<StageKeys>(
         "probe_pressure", "a pressure[]",
         "at which a half-space contact is solved, each raised until enough nodes touch; a box contact is "
         "solved at its weight, and so is a half-space whose weight presses harder than the least of these",
         [](const Argument& value, const OptionInfo& info, StageKeys& keys, Problems& problems) {
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
             return problems.push_back("`probe_pressure` is an empty list; give one pressure or more");
           value.elements(read);
         })
         .defaults_to("{\"1 MPa\", \"3 MPa\"}"),
     number("scatter", &TiltTrialOptions::scatter, at_least(0),
            "relative standard deviation of the friction force from trial to trial")}};

Values make_stage(Call& call) {
  const StageKeys keys = call.options(stage_block);
  const bool half_space = keys.contact && !keys.contact->scene().elasticity.model().is_local;
  if (keys.probe_given && !half_space)
    call.session().monitor().warn(
        "`probe_pressure` is for half-space contacts; a box contact is solved at its weight");
  TiltStage stage{keys.contact, keys.law, keys};
  stage.options.stage = keys;
  check(stage.options.stage);
  return {object(std::move(stage))};
}

struct RaiseKeys : OnKeys {
  int repeats = TiltTrialOptions{}.repeats;
  std::uint64_t seed = 1;
};
const Block<RaiseKeys> raise_block{
    {integer("repeats", &RaiseKeys::repeats, between(1, 100000), "number of trials"),
     integer("seed", &RaiseKeys::seed, at_least(0), "of placements and scatter"), rest_option()}};

struct GrowthKeys : OnKeys {
  int steps = 10;
  std::uint64_t seed = 1;
};
const Block<GrowthKeys> growth_block{
    {integer("steps", &GrowthKeys::steps, between(1, 10000), "equal steps of the angle up to the slip"),
     integer("seed", &GrowthKeys::seed, at_least(0), "of the placement"), rest_option()}};

const RecordType<SlipShare> slip_share_type{
    "SlipShare",
    "slip",
    "Slip inside a contact at an angle of the stage.",
    {{"angle", &SlipShare::angle, dimension::angle, "of the stage"},
     {"ratio", &SlipShare::ratio, "of the pull over the one that slides, from 0 to 1"},
     {"slip_fraction", &SlipShare::slip_fraction, "of the contact area that slips"},
     {"displacement", &SlipShare::displacement, dimension::length,
      "of the bodies over each other; nil on a half-space"}}};

Values grow_slip(Call& call) {
  const GrowthKeys keys = call.options(growth_block);
  const TiltStage& stage = call.self<TiltStage>();
  TiltTrialOptions options = stage.options;
  options.seed = keys.seed;
  options.rest = keys.rest;
  return {slip_share_type.list(
      slip_growth(*stage.contact, *stage.law, options, keys.steps, call.session().monitor()))};
}

constexpr Dimension area_per_force = dimension::number / dimension::pressure;

const RecordType<SlipAngle> tilt_trial_type{
    "TiltTrial",
    "trial",
    "One trial of a tilt stage.",
    {{"angle", &SlipAngle::angle, dimension::angle,
      "at which the specimen slides; the limit if it never does"},
     {"held", &SlipAngle::held, dimension::angle, "of the last step that held"},
     {"slipped", &SlipAngle::slipped, "whether it slid before the limit"}}};

const RecordType<TiltProbe> tilt_probe_type{
    "TiltProbe",
    "probe",
    "A pressure at which a trial solved a half-space contact.",
    {{"pressure", &TiltProbe::pressure, dimension::pressure, "at which it was solved, level"},
     {"nodes_in_contact", &TiltProbe::contacts, "nodes in contact"},
     {"area_per_load", &TiltProbe::area_per_load, area_per_force,
      "corrected real contact area over the load"},
     {"mu", &TiltProbe::mu, "friction over load, its adhesive part on the corrected area"}}};

const RecordType<TiltResult> tilt_type =
    RecordType<TiltResult>{
        "Tilt",
        "tilt",
        "Result of raising a stage until its specimen slid, over all trials.",
        {{"angle", &TiltResult::angle, dimension::angle,
          "at which the specimen slides, exactly: mean over the trials"},
         {"held", &TiltResult::held, dimension::angle, "the last step that held: mean over the trials"},
         {"mu", &TiltResult::mu, "tan(held); infinite at 90 deg"},
         {"spread", &TiltResult::spread, "standard deviation of tan(held) over the trials; 0 for one trial"},
         {"slipped", &TiltResult::slipped,
          "whether every trial slid; otherwise angle, held and mu are lower bounds"},
         {"trials", &TiltResult::trials, tilt_trial_type, "each event, in order"},
         {"area_per_load", &TiltResult::area_per_load, area_per_force,
          "corrected real contact area over the load: mean over the trials; nil but on a half-space"},
         {"probe_spread", &TiltResult::probe_spread,
          "greatest relative distance of mu at one probe from the mean of its trial: the possible error of "
          "the extrapolation to the weight; nil if the weight was solved, with one probe, and for boxes"},
         {"solved_at_weight", [](const TiltResult& t) { return !t.at_weight.empty(); },
          "whether a half-space was solved under the weight itself"},
         {"probes", &TiltResult::probes, tilt_probe_type, "those of all trials that solved anew"},
         {"note", [](const TiltResult& t) { return t.note.empty() ? std::nullopt : std::optional(t.note); },
          "a note on these numbers, in a sentence; nil without one"}}}
        .titled(
            [](const TiltResult& t) -> std::string { return t.slipped ? "tilt" : "tilt (does not slip)"; });

Values raise_stage(Call& call) {
  const RaiseKeys keys = call.options(raise_block);
  const TiltStage& stage = call.self<TiltStage>();
  TiltTrialOptions options = stage.options;
  options.repeats = keys.repeats;
  options.seed = keys.seed;
  options.rest = keys.rest;
  return {tilt_type(raise(*stage.contact, *stage.law, options, call.session().monitor()))};
}

}  // namespace

Function tilt_stage_function() {
  return {
      .name = "tilt_stage",
      .body = make_stage,
      .sentence = "The friction angle: a stage is raised until the specimen slides, T(W cos a) = W sin a.",
      .options = &stage_block,
      .returns = "TiltStage",
      .example = "local stage = lab.tilt_stage{ contact=c, friction=law, mass=\"4.3 g\" }"};
}

Class make_class(For<TiltStage>) {
  Class c{"TiltStage", "a tilt stage", "A tilt stage with a specimen on it."};
  c.shareable = false;
  c.describe = from_value([](const TiltStage& stage) -> std::string {
    return "tilt stage: mass " + format_quantity(stage.options.stage.mass, dimension::mass) + ", " +
           stage.law->text();
  });
  c.methods = {
      {.name = "raise",
       .body = raise_stage,
       .sentence = "Raises the stage until the specimen slides, several times. angle is exact; held is the "
                   "last step that held, the source paper's measure; mu = tan(held), so mu changes in the "
                   "steps of the stage and tan(angle) does not.",
       .options = optional(raise_block),
       .returns = "Tilt",
       .example = "local t = stage:raise{ repeats=5, seed=1 }",
       .heavy = true},
      {.name = "slip_growth",
       .body = grow_slip,
       .sentence =
           "Which part of the contact slips at each angle before the specimen slides; needs tangential.",
       .options = optional(growth_block),
       .returns = "SlipShare[]",
       .example =
           "for _, at in ipairs(stage:slip_growth{ steps=10 }) do print(at.angle, at.slip_fraction) end",
       .heavy = true}};
  c.results = {&tilt_type, &tilt_trial_type, &tilt_probe_type, &slip_share_type};
  return c;
}

}  // namespace asperity::lua
