// SPDX-License-Identifier: GPL-3.0-or-later
// The options table of lab.contact and how it becomes a Scene. One block of keys for each effect.
#include "bindings/lua/contact_scene.hpp"

#include <algorithm>

#include "bindings/lua/catalogue.hpp"
#include "bindings/lua/contact.hpp"
#include "bindings/lua/grid_keys.hpp"
#include "bindings/lua/surface.hpp"
#include "engine/contact/effects/catalogue.hpp"

namespace asperity::lua {

namespace {

struct ElasticityKeys {
  std::string model;
  std::optional<double> stiffness;
};
const Block<ElasticityKeys>& elasticity_block() {
  using K = ElasticityKeys;
  static const Block<K> block{"elasticity",
                              {text("model", &K::model, "how the bodies give way").required(),
                               quantity("stiffness", &K::stiffness, dimension::stiffness, above(0),
                                        "pressure per shortening of a box element; of model=\"box\" alone")
                                   .defaults_to("E*/peak-to-valley")}};
  return block;
}

const Block<PlasticityOptions>& plasticity_block() {
  using O = PlasticityOptions;
  static const Block<O> block{
      "plasticity",
      {quantity("hardness", &O::hardness, dimension::pressure, above(0).or_never(),
                "greatest pressure a body carries before it yields")
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
      {number("rate", &O::rate, at_least(0), "fall of the hardness per unit of ln(1 + dwell/onset)"),
       quantity("onset", &O::onset, dimension::time, above(0), "time from which creep counts"),
       quantity("reference", &O::reference, dimension::time, above(0),
                "dwell at which the hardness is the stated one, and of a press that names no dwell")}};
  return block;
}

const Block<Accuracy>& accuracy_block() {
  using O = Accuracy;
  static const Block<O> block{
      "accuracy",
      {number("tolerance", &O::tolerance, {1e-15, 1, false, true, false},
              "bound on every relative entry of the certificate"),
       choice("precision", &O::precision,
              {{"double", O::Precision::double_}, {"single", O::Precision::single}},
              "of the fields inside a solve; this version computes \"double\" alone"),
       choice("on_failure", &O::on_failure, {{"error", O::OnFailure::error}, {"best", O::OnFailure::best}},
              "what a solve that misses its tolerance does: raise an error, or return the best it got")}};
  return block;
}

struct SceneKeys {
  std::optional<Surface> lower;
  std::optional<UpperBody> upper;
  std::optional<Boundary> boundary;
  std::optional<Elasticity> elasticity;
  std::optional<PlasticityOptions> plasticity;
  std::optional<CreepOptions> creep;
  Accuracy accuracy;
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
                       "; give \"half_space\", \"box\" or { model=\"box\", stiffness= }");
    return;
  }
  collect(problems, [&] {
    require_elasticity_model(given.model);
    if (given.model == "box") {
      keys.elasticity = BoxOptions{given.stiffness};
      return;
    }
    keys.elasticity = HalfSpaceOptions{};
    if (given.stiffness)
      problems.push_back(
          "`effects.elasticity.stiffness` is of box elements; the stiffness of a half-space "
          "follows from the materials");
  });
}

// Each effect that this build computes, by its name.
const std::vector<Option<SceneKeys>>& effect_options() {
  using K = SceneKeys;
  static const std::vector<Option<K>> options = [] {
    Option<K> elasticity =
        custom<K>("elasticity", "\"half_space\"|\"box\"|table", "how the bodies give way and recover",
                  [](const Argument& value, const OptionInfo&, K& keys, Problems& problems) {
                    read_elasticity(value, keys, problems);
                  });
    elasticity.info.inner = &elasticity_block();
    elasticity.info.required = true;
    return std::vector<Option<K>>{
        std::move(elasticity),
        table_of("plasticity", &K::plasticity, plasticity_block(),
                 "pressure is limited by hardness, and what yields stays flattened; {} for its defaults"),
        table_of("creep", &K::creep, creep_block(),
                 "hardness falls with the dwell of the load; needs plasticity; {} for its defaults")};
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
    problems.push_back("`effects` names no elasticity; give elasticity=\"half_space\" or \"box\"");
}

Option<SceneKeys> effects() {
  Option<SceneKeys> option = custom<SceneKeys>(
      "effects", "table", "what the scene computes, by name, e.g. { elasticity=\"box\" }; nothing else is",
      read_effects);
  option.info.inner = &effects_block();
  return std::move(option).required();
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
      [](K& keys, Problems& problems) {
        if (keys.elasticity && std::holds_alternative<HalfSpaceOptions>(*keys.elasticity) && !keys.boundary)
          problems.push_back(
              "a half-space needs `boundary`: \"periodic\" where the tile goes on beyond its "
              "rim, or \"free\"");
      }};
  return block;
}

}  // namespace

Scene read_scene(Call& call) {
  const SceneKeys keys = call.options(scene_block());
  Scene scene{*keys.lower, *keys.upper, keys.boundary.value_or(Boundary::free), *keys.elasticity,
              keys.accuracy};
  scene.plasticity = keys.plasticity;
  scene.creep = keys.creep;
  return scene;
}

const BlockInfo& scene_keys() { return scene_block(); }

}  // namespace asperity::lua
