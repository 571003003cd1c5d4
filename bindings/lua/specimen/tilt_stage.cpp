// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/tilt_stage.hpp"

#include <numbers>
#include <optional>

#include "bindings/lua/friction/law.hpp"
#include "bindings/lua/registry/record_type.hpp"
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
       custom<K>(
           "probe_pressure", "a pressure[]",
           "at which a half-space contact is solved, each raised until enough nodes touch; a box contact is "
           "solved at its weight, and so is a half-space whose weight presses harder than the least of these",
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
               return problems.push_back("`probe_pressure` is an empty list; give one pressure or more");
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

const RecordType<SlipShare>& slip_share_type() {
  using S = SlipShare;
  static const RecordType<S> type{"SlipShare",
                                  "slip",
                                  "How far slip has grown inside a contact at an angle of the stage.",
                                  {{"angle", &S::angle, dimension::angle, "of the stage"},
                                   {"ratio", &S::ratio, "of the pull over the one that slides, from 0 to 1"},
                                   {"slip_fraction", &S::slip_fraction, "of the contact area that slips"},
                                   {"displacement", &S::displacement, dimension::length,
                                    "of the bodies over each other; nil on a half-space"}}};
  return type;
}

Values grow_slip(Call& call) {
  const GrowthKeys keys = call.options(growth_block());
  const TiltStage& stage = call.self<TiltStage>();
  TiltTrialOptions options = stage.options;
  options.seed = keys.seed;
  options.rest = keys.rest;
  return {slip_share_type().list(
      slip_growth(*stage.contact, *stage.law, options, keys.steps, call.session().monitor()))};
}

const RecordType<SlipAngle>& tilt_trial_type() {
  using T = SlipAngle;
  static const RecordType<T> type{
      "TiltTrial",
      "trial",
      "One trial of a tilt stage.",
      {{"angle", &T::angle, dimension::angle, "at which the specimen slides; the limit if it never does"},
       {"held", &T::held, dimension::angle, "of the last step that held"},
       {"slipped", &T::slipped, "whether it slid before the limit"}}};
  return type;
}

const RecordType<TiltProbe>& tilt_probe_type() {
  using P = TiltProbe;
  static const RecordType<P> type{
      "TiltProbe",
      "probe",
      "A pressure at which a trial solved a half-space contact.",
      {{"pressure", &P::pressure, dimension::pressure, "at which it was solved, level"},
       {"contacts", &P::contacts, "nodes in contact"},
       {"area_per_load", &P::area_per_load, "corrected real contact area over the load, 1/Pa"},
       {"mu", &P::mu, "friction over load, its adhesive part on the corrected area"}}};
  return type;
}

const RecordType<TiltResult>& tilt_type() {
  using T = TiltResult;
  static const RecordType<T> type =
      RecordType<T>{
          "Tilt",
          "tilt",
          "What came of raising a stage until its specimen slid, over all trials.",
          {{"angle", &T::angle, dimension::angle,
            "at which the specimen slides, exactly: mean over the trials"},
           {"held", &T::held, dimension::angle, "the last step that held: mean over the trials"},
           {"mu", &T::mu, "tan(held); infinite at 90 deg"},
           {"spread", &T::spread, "standard deviation of tan(held) over the trials; 0 for one trial"},
           {"slipped", &T::slipped,
            "whether every trial slid; otherwise angle, held and mu are lower bounds"},
           {"trials", &T::trials, tilt_trial_type(), "each of them, in the order they were made"},
           {"area_per_load", &T::area_per_load,
            "corrected real contact area over the load, 1/Pa: mean over the trials; nil but on a half-space"},
           {"probe_spread", &T::probe_spread,
            "greatest relative distance of mu at one probe from the mean of its trial: what going down to "
            "the weight may be wrong by; nil where the weight was solved, of one probe, and of boxes"},
           {"solved_at_weight", [](const T& t) { return !t.at_weight.empty(); },
            "whether a half-space was solved under the weight itself"},
           {"probes", &T::probes, tilt_probe_type(), "those of all trials that solved anew"},
           {"note", [](const T& t) { return t.note.empty() ? std::nullopt : std::optional(t.note); },
            "what one must know of these numbers, in a sentence; nil if there is nothing"}}}
          .titled([](const T& t) -> std::string { return t.slipped ? "tilt" : "tilt (does not slip)"; });
  return type;
}

Values raise_stage(Call& call) {
  const RaiseKeys keys = call.options(raise_block());
  const TiltStage& stage = call.self<TiltStage>();
  TiltTrialOptions options = stage.options;
  options.repeats = keys.repeats;
  options.seed = keys.seed;
  options.rest = keys.rest;
  return {tilt_type()(raise(*stage.contact, *stage.law, options, call.session().monitor()))};
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
         .sentence = "Raises the stage until the specimen slides, several times. angle is exact; held is the "
                     "last step that held, the source paper's measure; mu = tan(held), so mu goes in the "
                     "steps of the stage and tan(angle) does not.",
         .options = &raise_block(),
         .options_optional = true,
         .returns = "Tilt",
         .example = "local t = stage:raise{ repeats=5, seed=1 }",
         .heavy = true},
        {.name = "slip_growth",
         .body = grow_slip,
         .sentence =
             "Which part of the contact slips at each angle before the specimen slides; needs tangential.",
         .options = &growth_block(),
         .options_optional = true,
         .returns = "SlipShare[]",
         .example =
             "for _, at in ipairs(stage:slip_growth{ steps=10 }) do print(at.angle, at.slip_fraction) end",
         .heavy = true}};
    c.results = {&tilt_type(), &tilt_trial_type(), &tilt_probe_type(), &slip_share_type()};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
