// SPDX-License-Identifier: GPL-3.0-or-later
// The options table of lab.contact and how it becomes a Scene. One block of keys for each effect.
#include "bindings/lua/specimen/contact_scene.hpp"

#include <algorithm>

#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/refinement.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/surface/grid_keys.hpp"
#include "bindings/lua/surface/known_body.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/contact/effects/catalogue.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

namespace {

struct ElasticityKeys {
  std::string model;
  std::optional<double> stiffness;
  std::optional<double> thickness;
  std::optional<LayerBase> base;
};
const Block<ElasticityKeys>& elasticity_block() {
  using K = ElasticityKeys;
  static const Block<K> block{
      "elasticity",
      {text("model", &K::model, "how the bodies give way").required(),
       quantity("stiffness", &K::stiffness, dimension::stiffness, above(0),
                "pressure per shortening of a box element; of model=\"box\" alone")
           .defaults_to("E*/peak-to-valley"),
       quantity("thickness", &K::thickness, dimension::length, above(0),
                "of the layer, the lower body; model=\"layer\" needs it. Approach and "
                "energy hold its uniform compression, "
                "K(0) = t (1+nu)(1-2nu)/(E (1-nu)) per mean pressure")
           .defaults_to("none"),
       choice("base", &K::base, {{"bonded", LayerBase::bonded}, {"frictionless", LayerBase::frictionless}},
              "how the layer lies on its rigid base; of model=\"layer\" alone")
           .defaults_to("\"bonded\"")}};
  return block;
}

const Block<PlasticityOptions>& plasticity_block() {
  using O = PlasticityOptions;
  static const Block<O> block{
      "plasticity",
      {quantity(
           "hardness", &O::hardness, dimension::pressure, above(0).or_never(),
           "greatest pressure a body carries before it yields. Of two bodies the softer one limits the "
           "pressure and takes nearly all of what yields: a body r times as hard as the other takes the "
           "share 1/(1 + exp(1.5 (r^2 - 1/r^2)) young/young of the other), half of like bodies, .25 at "
           "r = 1.2, .06 at 1.5, .004 at 2, as J2 plasticity below the surface has it; r is that of each "
           "node, with what hardening has made of it")
           .defaults_to("each body's own"),
       quantity("hardening", &O::hardening, dimension::stiffness, above(0).or_never(),
                "growth of the pressure with the plastic part of the approach; math.huge leaves it out: the "
                "pressure stays at the hardness")}};
  return block;
}

const Block<CreepOptions>& creep_block() {
  using O = CreepOptions;
  static const Block<O> block{
      "creep",
      {number("rate", &O::rate, at_least(0),
              "b of the law H = hardness (1 + b ln(1 + reference/onset)) / (1 + b ln(1 + dwell/onset))"),
       quantity("onset", &O::onset, dimension::time, above(0), "time from which creep counts"),
       quantity("reference", &O::reference, dimension::time, above(0),
                "dwell at which the hardness is the stated one, and of a press that names no dwell")}};
  return block;
}

const Block<CapillarityOptions>& capillarity_block() {
  using O = CapillarityOptions;
  static const Block<O> block{
      "capillarity",
      {quantity("pressure", &O::pressure, dimension::pressure, at_least(0),
                "how far the liquid is below the air; sets the radius of the meniscus"),
       number("humidity", &O::humidity, {0, 1, false, true, false},
              "relative; sets the radius and with it the pressure"),
       quantity("surface_tension", &O::surface_tension, dimension::energy_per_area, above(0),
                "of the liquid; that of water unless given"),
       quantity("contact_angle", &O::contact_angle, dimension::angle, at_least(0),
                "of the liquid on both bodies, below 90 deg"),
       number("temperature", &O::temperature, above(100), "in kelvins, 293.15 in a room; of `humidity`"),
       number("molar_volume", &O::molar_volume, above(0), "of the liquid in m^3/mol; of `humidity`")}};
  return block;
}

const Block<AdhesionOptions>& adhesion_block() {
  using O = AdhesionOptions;
  static const Block<O> block{
      "adhesion",
      {quantity("work", &O::work, dimension::energy_per_area, at_least(0), "of parting a unit of area")
           .required(),
       quantity("range", &O::range, dimension::length, above(0), "gap over which the attraction falls")
           .required(),
       choice("model", &O::model, {{"exponential", GapLaw::exponential}, {"dugdale", GapLaw::dugdale}},
              "work/range e^(-gap/range), or work/range up to a gap of the range; the end is smoothed over "
              "gaps of "
              "0.5 to 1.5 ranges, so pull-off is 0.1 to 0.5 % above Maugis's")}};
  return block;
}

const Block<InterlockingOptions>& interlocking_block() {
  using O = InterlockingOptions;
  static const Block<O> block{
      "interlocking",
      {quantity("direction", &O::direction, dimension::angle, any(),
                "the way the upper body is pushed over the lower one, counter-clockwise from x")}};
  return block;
}

const Block<AgeingOptions>& ageing_block() {
  using O = AgeingOptions;
  static const Block<O> block{
      "ageing",
      {number("rate", &O::rate, at_least(0), "growth of tau0 per unit of ln(1 + rest/onset)").required(),
       quantity("onset", &O::onset, dimension::time, above(0), "rest from which ageing counts").required()}};
  return block;
}

const Block<TangentialOptions>& tangential_block() {
  using O = TangentialOptions;
  static const Block<O> block{
      "tangential",
      {number("compliance_ratio", &O::compliance_ratio, above(0),
              "how much more the bodies give way sideways than normally; required for boxes")
           .defaults_to("Mindlin's, (2 - poisson)/(2(1 - poisson)) for like bodies")}};
  return block;
}

struct AccuracyKeys : Accuracy {
  std::optional<double> given_tolerance;
  std::optional<Precision> given_precision;
  std::optional<double> error;
  std::vector<std::string> of;
};

std::string_view estimate_text(Accuracy::Estimate estimate) {
  switch (estimate) {
    case Accuracy::Estimate::coarser:
      return "true";
    case Accuracy::Estimate::finer:
      return "\"finer\"";
    default:
      return "false";
  }
}

void read_estimate(const Argument& value, const OptionInfo& info, AccuracyKeys& keys, Problems& problems) {
  if (value.is_boolean())
    keys.estimate = value.boolean() ? Accuracy::Estimate::coarser : Accuracy::Estimate::none;
  else if (value.is_text() && value.text() == "finer")
    keys.estimate = Accuracy::Estimate::finer;
  else
    detail::wrong_type(value, info, "true, false or \"finer\"", problems);
}

// One name or a list of them.
void read_effect_names(const Argument& value, const OptionInfo& info, AccuracyKeys& keys,
                       Problems& problems) {
  if (value.is_text()) {
    keys.of = {std::string(value.text())};
    return;
  }
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(value, info, "a name such as \"approach\", or a list of them", problems);
  for (std::int64_t k = 1; k <= value.length(); ++k)
    value.element(k, [&](const Argument& name) {
      if (name.is_text())
        keys.of.emplace_back(name.text());
      else
        detail::wrong_type(name, info, "a list of names", problems);
    });
}

void finish_accuracy(AccuracyKeys& keys, Problems& problems) {
  if (keys.error && keys.given_tolerance)
    problems.push_back(
        "`error` and `tolerance` are both given; with `error` the tolerance is chosen, so leave `tolerance` "
        "out");
  if (keys.error && keys.estimate == Accuracy::Estimate::finer)
    problems.push_back(
        "`error` and `estimate`=\"finer\" are both given; cells chosen for an `error` are compared with the "
        "coarser ones tried before, so leave one of both out");
  if (!keys.of.empty() && !keys.error)
    problems.push_back("`of` is given without `error`; give the relative error as well, such as error=0.01");
  if (keys.given_tolerance) keys.tolerance = *keys.given_tolerance;
  keys.precision_named = keys.given_precision.has_value();
  if (keys.given_precision) keys.precision = *keys.given_precision;
  if (!keys.error) return;
  if (keys.of.empty()) keys.of = {"corrected_area_fraction"};
  keys.asked = AskedError{*keys.error, keys.of};
}

const Block<AccuracyKeys>& accuracy_block() {
  using O = Accuracy;
  using K = AccuracyKeys;
  static const Block<K> block{
      "accuracy",
      {number("tolerance", &K::given_tolerance, {1e-15, 1, false, true, false},
              "bound on every relative entry of the certificate")
           .defaults_to("1e-06"),
       choice(
           "precision", &K::given_precision,
           {{"double", O::Precision::double_}, {"single", O::Precision::single}},
           "of the transforms inside a half-space solve. In \"double\" those of a step may be rounded to "
           "single precision on 256 x 256 nodes and more, where that saves time and gaps computed afresh "
           "later take it back; \"single\" rounds them on any grid and saves memory on a periodic tile. The "
           "certificate is double always. A periodic tile of odd `nx`, or of a side with a prime factor over "
           "7, stays in "
           "double; boxes refuse it; with `error` it is chosen where it is not named")
           .shown_by([](const K& keys) {
             return std::string(keys.precision == O::Precision::single ? "\"single\"" : "\"double\"");
           })
           .defaults_to("\"double\""),
       choice("on_failure", &O::on_failure, {{"error", O::OnFailure::error}, {"best", O::OnFailure::best}},
              "what a solve that misses its tolerance or `error` does: raise an error, or return the best it "
              "got"),
       custom<K>(
           "estimate", "boolean|\"finer\"",
           "solves each press on other cells too, for st.error.discretisation: true on half and a "
           "quarter of them, which costs about a third of the press and mostly bounds the error; \"finer\" "
           "on thrice the cells a side, which costs about eleven times the press and is within a factor of "
           "three of the "
           "true error, above and below, in nine cases of ten",
           read_estimate)
           .shown_by([](const K& keys) { return std::string(estimate_text(keys.estimate)); })
           .defaults_to("false"),
       number("error", &K::error, {1e-6, 1, false, true, false},
              "relative error to be met instead of a tolerance: the first press chooses cells, tolerance and "
              "precision"),
       custom<K>("of", "string|string[]", "quantities of a state whose error that is", read_effect_names)
           .defaults_to("\"corrected_area_fraction\"")},
      finish_accuracy};
  return block;
}

struct SceneKeys {
  std::optional<Surface> lower;
  std::optional<UpperBody> upper;
  std::optional<Boundary> boundary;
  std::optional<Elasticity> elasticity;
  std::optional<PlasticityOptions> plasticity;
  std::optional<CreepOptions> creep;
  std::optional<CapillarityOptions> capillarity;
  std::optional<AdhesionOptions> adhesion;
  std::optional<InterlockingOptions> interlocking;
  std::optional<AgeingOptions> ageing;
  std::optional<TangentialOptions> tangential;
  AccuracyKeys accuracy;
};

// Appends what `act` throws.
template <class Act>
void collect(Problems& problems, Act act) {
  try {
    act();
  } catch (const Error& error) {
    problems.push_back(error.what());
  }
}

void read_elasticity(const Argument& value, SceneKeys& keys, Problems& problems) {
  ElasticityKeys given;
  if (value.is_text()) {
    given.model = value.text();
  } else if (value.is_table()) {
    bool read = false;
    collect(problems, [&] {
      given = elasticity_block().read(value, "`effects.elasticity`");
      read = true;
    });
    if (!read) return;
  } else {
    problems.push_back("`effects.elasticity` is " + value.describe() +
                       "; give \"half_space\", \"box\", \"rigid\", { model=\"box\", stiffness= } or "
                       "{ model=\"layer\", thickness= }");
    return;
  }
  collect(problems, [&] {
    require_elasticity_model(given.model);
    if (given.model != "layer" && (given.thickness || given.base))
      problems.push_back("`effects.elasticity." + std::string(given.thickness ? "thickness" : "base") +
                         "` is of a layer; give model=\"layer\" beside it, or leave it out");
    if (given.model == "layer") {
      if (given.stiffness)
        problems.push_back(
            "`effects.elasticity.stiffness` is of box elements; the stiffness of a layer follows "
            "from its material and `thickness`");
      if (!given.thickness)
        problems.push_back(
            "`effects.elasticity` is a layer without `thickness`; give { model=\"layer\", "
            "thickness= }");
      keys.elasticity = LayerOptions{given.thickness.value_or(0), given.base.value_or(LayerBase::bonded)};
      return;
    }
    if (given.model == "box") {
      keys.elasticity = BoxOptions{given.stiffness};
      return;
    }
    const bool rigid = given.model == "rigid";
    keys.elasticity = rigid ? Elasticity(RigidOptions{}) : Elasticity(HalfSpaceOptions{});
    if (given.stiffness)
      problems.push_back(rigid ? "`effects.elasticity.stiffness` is of box elements; rigid bodies have none"
                               : "`effects.elasticity.stiffness` is of box elements; the stiffness of a "
                                 "half-space follows from the materials");
  });
}

// Each effect that this build computes, by its name.
const std::vector<Option<SceneKeys>>& effect_options() {
  using K = SceneKeys;
  static const std::vector<Option<K>> options = [] {
    Option<K> elasticity = custom<K>("elasticity", "\"half_space\"|\"box\"|\"rigid\"|table",
                                     "how the bodies give way and recover",
                                     [](const Argument& value, const OptionInfo&, K& keys,
                                        Problems& problems) { read_elasticity(value, keys, problems); });
    elasticity.info.inner = &elasticity_block();
    elasticity.info.required = true;
    return std::vector<Option<K>>{
        std::move(elasticity),
        table_of("plasticity", &K::plasticity, plasticity_block(),
                 "pressure is limited by hardness, and what yields stays flattened; {} for its defaults"),
        table_of("creep", &K::creep, creep_block(),
                 "hardness falls with the dwell of the load; needs plasticity; {} for its defaults"),
        table_of("capillarity", &K::capillarity, capillarity_block(),
                 "liquid in narrow gaps pulls the bodies together, and the junctions carry that too"),
        table_of(
            "adhesion", &K::adhesion, adhesion_block(),
            "the surfaces attract each other across the gap; loads and approaches may be below zero. A press "
            "takes many transforms: of 60 contacts, balls and rough ground on 64 x 64 cells, 55 to 3628 by "
            "approach, 161 in the middle, and 73 to 1588 by pressure, 228 in the middle; contact:explain "
            "tells those of one"),
        table_of("ageing", &K::ageing, ageing_block(),
                 "tau0 of the friction law grows with the time the junctions rest"),
        table_of("interlocking", &K::interlocking, interlocking_block(),
                 "slopes of two rough bodies add to the angle of friction; {} for its defaults"),
        table_of("tangential", &K::tangential, tangential_block(),
                 "shear and partial slip, for contact:shear and stage:slip_growth; {} for its defaults")};
  }();
  return options;
}
const Block<SceneKeys>& effects_block() {
  static const Block<SceneKeys> block{"effects", effect_options()};
  return block;
}

// Every key of the table is an effect by name; those this build does not compute are refused.
void read_effects(const Argument& value, const OptionInfo& info, SceneKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { elasticity=\"box\" }", problems);
  std::vector<std::string> names;
  value.each([&](const Argument& key, const Argument&) {
    if (key.is_text())
      names.emplace_back(key.text());
    else
      problems.push_back("`effects` holds " + key.describe() + " as a key; write { elasticity=\"box\" }");
  });
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    collect(problems, [&] {
      require_effect(name);
      for (const Option<SceneKeys>& option : effect_options())
        if (option.info.name == name)
          with_key(value, name,
                   [&](const Argument& given) { option.read(given, option.info, keys, problems); });
    });
  }
  if (std::find(names.begin(), names.end(), "elasticity") == names.end())
    problems.push_back("`effects` names no elasticity; give elasticity=\"half_space\", \"box\" or \"rigid\"");
}

Option<SceneKeys> effects() {
  Option<SceneKeys> option = custom<SceneKeys>(
      "effects", "table", "what the scene computes, by name, e.g. { elasticity=\"box\" }; nothing else is",
      read_effects);
  option.info.inner = &effects_block();
  return std::move(option).required();
}

void require_boundary(SceneKeys& keys, Problems& problems) {
  if (keys.elasticity && std::holds_alternative<HalfSpaceOptions>(*keys.elasticity) && !keys.boundary)
    problems.push_back(
        "a half-space needs `boundary`: \"periodic\" where the tile goes on beyond its "
        "rim, or \"free\"");
  if (keys.elasticity && std::holds_alternative<LayerOptions>(*keys.elasticity) && !keys.boundary)
    problems.push_back("a layer needs boundary=\"periodic\": the tile goes on beyond its rim");
}

const Block<SceneKeys>& scene_block() {
  using K = SceneKeys;
  static const Block<K> block{
      "lab.contact",
      {native<Surface>("lower", &K::lower, "Surface", "a surface", "the lower body, rough side up")
           .required(),
       custom<K>("upper", "Surface|Material",
                 "the upper body: a rough surface that is turned over to face down, a flat of a "
                 "material, or lab.rigid",
                 [](const Argument& value, const OptionInfo& info, K& keys, Problems& problems) {
                   if (const Surface* surface = value.as<Surface>())
                     keys.upper = *surface;
                   else if (const Material* material = value.as<Material>())
                     keys.upper = *material;
                   else if (const Object* object = value.as_any_object(); object != nullptr && object->closed)
                     problems.push_back("`upper` was closed");
                   else if (value.is_text())
                     problems.push_back("`upper` is the string \"" + std::string(value.text().substr(0, 40)) +
                                        "\"; a flat of a material is lab.material \"" +
                                        std::string(value.text().substr(0, 40)) + "\"");
                   else if (!value.is_unknown())
                     detail::wrong_type(value, info, "a surface, a material or lab.rigid", problems);
                 })
           .required(),
       choice("boundary", &K::boundary, {{"free", Boundary::free}, {"periodic", Boundary::periodic}},
              "whether the tile goes on beyond its rim; required for a half-space")
           .defaults_to("\"free\" for boxes"),
       effects(),
       table_of("accuracy", &K::accuracy, accuracy_block(),
                "how close a solve must come, and what if it does not")},
      require_boundary};
  return block;
}

Scene scene_of(const SceneKeys& keys, Surface lower, UpperBody upper) {
  Scene scene{std::move(lower), std::move(upper), keys.boundary.value_or(Boundary::free), *keys.elasticity,
              keys.accuracy};
  scene.plasticity = keys.plasticity;
  scene.creep = keys.creep;
  scene.capillarity = keys.capillarity;
  scene.adhesion = keys.adhesion;
  scene.sliding = {keys.interlocking, keys.ageing, keys.tangential};
  return scene;
}

}  // namespace

Scene read_scene(Call& call) {
  const SceneKeys keys = call.options(scene_block());
  Scene scene = scene_of(keys, *keys.lower, *keys.upper);
  if (Refinement* refinement = refinement_of(call.L)) {
    scene.accuracy.tolerance = refinement->tolerance_for(scene.accuracy.tolerance);
    if (refinement->tolerance) scene.accuracy.asked.reset();  // it is what was asked for
  }
  return scene;
}

void look_at_scene(const Call& call) {
  const Argument table = call.argument(1);
  if (!table.is_table()) return;
  constexpr int nested = 3;
  for (const char* key : {"boundary", "effects", "accuracy"})
    if (with_key(table, key, [&](const Argument& value) { return holds_unknown(value, nested); })) return;
  SceneKeys keys = call.options(scene_block());
  Problems problems;
  require_boundary(keys, problems);
  if (!problems.empty()) throw Error(ErrorCode::bad_value, call.function_name() + ": " + problems.front());
  const auto body = [&](const char* key) { return with_key(table, key, known_body); };
  const auto lower = body("lower"), upper = body("upper");
  const bool flat = keys.upper && std::holds_alternative<Material>(*keys.upper);
  if (lower == nullptr || (upper == nullptr && !flat)) return;
  if (upper != nullptr && lower->grid && upper->grid) check_tiles(*lower->grid, *upper->grid);
  KnownBody same_size = upper != nullptr ? *upper : KnownBody{};
  same_size.grid = lower->grid;
  Scene scene = scene_of(keys, stand_in(*lower), flat ? *keys.upper : UpperBody(stand_in(same_size)));
  scene.accuracy.estimate = Accuracy::Estimate::none;  // needs the true cells
  (void)SpecimenPair(scene);
}

const BlockInfo& scene_keys() { return scene_block(); }

}  // namespace asperity::lua
