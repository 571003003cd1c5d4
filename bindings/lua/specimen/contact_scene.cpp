// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/contact.hpp"

#include <algorithm>
#include <map>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/variation.hpp"
#include "bindings/lua/surface/known_body.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/accuracy/accuracy_choice.hpp"
#include "engine/contact/scene/elastic_model.hpp"
#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/require.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

namespace {

// `elasticity` as a table: the model and its options.
class ElasticityBlock final : public BlockInfo {
 public:
  ElasticityBlock() {
    std::string type, sentence = "how the bodies give way";
    for (const ElasticModel* model : elastic_models()) {
      const std::string word = "\"" + std::string(model->name) + "\"";
      type += (type.empty() ? "" : "|") + word;
      sentence += (type == word ? ": " : "; ") + word + ", " + model->sentence;
    }
    infos_.push_back({"model", type, {}, "", "", sentence, true});
    for (const ElasticModel* model : elastic_models())
      for (std::size_t k = 0; k < model->options.size(); ++k) {
        infos_.push_back(row_info(model->options[k], model->defaults));
        infos_.back().required = false;  // by model
        places_.push_back({model, k});
      }
  }

  std::vector<const OptionInfo*> options() const override { return pointers_to(infos_); }
  Elasticity read(const Argument& table, const std::string& caller) const {
    const ElasticModel* model = nullptr;
    std::any options;
    std::vector<bool> given(infos_.size(), false);
    detail::read_table(
        table, caller, this->options(),
        [&](std::size_t k, const Argument& value, Problems& problems) {
          given[k] = true;
          if (k > 0) return read_option(k, value, model, options, problems);
          if (!value.is_text()) return detail::wrong_type(value, infos_[k], "a string", problems);
          model = &require_elastic_model(value.text());
          options = model->defaults;
        },
        [&](Problems& problems) {
          for (std::size_t k = 1; k < infos_.size(); ++k)
            if (places_[k - 1].model == model && row(k).required && !given[k])
              problems.push_back(quoted(infos_[k].name) + " is missing: " + infos_[k].sentence);
        });
    return model == nullptr ? Elasticity() : Elasticity(*model, std::move(options));
  }
  void check(const Argument& table, const std::string& caller) const override { (void)read(table, caller); }

 private:
  struct Place {
    const ElasticModel* model;
    std::size_t row;
  };
  const OptionRow& row(std::size_t k) const { return places_[k - 1].model->options[places_[k - 1].row]; }
  void read_option(std::size_t k, const Argument& value, const ElasticModel* model, std::any& options,
                   Problems& problems) const {
    if (model == nullptr) return;  // already reported
    if (places_[k - 1].model == model) return read_row(row(k), infos_[k], value, options, problems);
    problems.push_back(quoted(infos_[k].name) + " is of model=\"" + std::string(places_[k - 1].model->name) +
                       "\", and the model is \"" + std::string(model->name) + "\"; leave one out");
  }

  std::vector<OptionInfo> infos_;
  std::vector<Place> places_;  // of all but `model`
};
const ElasticityBlock& elasticity_block() {
  static const ElasticityBlock block;
  return block;
}

// "box", or { model="layer", thickness= } with required options.
std::string written(const ElasticModel& model, bool all_options) {
  std::string keys;
  for (const OptionRow& row : model.options)
    if (row.required || all_options) keys += ", " + row.name + "=";
  const std::string name = "\"" + std::string(model.name) + "\"";
  return keys.empty() ? name : "{ model=" + name + keys + " }";
}
bool needs_options(const ElasticModel& model) {
  return std::ranges::any_of(model.options, &OptionRow::required);
}
std::vector<std::string> ways_to_write() {
  std::vector<std::string> ways;
  for (const ElasticModel* model : elastic_models())
    if (!needs_options(*model)) ways.push_back(written(*model, false));
  for (const ElasticModel* model : elastic_models())
    if (!model->options.empty()) ways.push_back(written(*model, !needs_options(*model)));
  return ways;
}

struct AccuracyKeys : Accuracy {
  std::optional<double> given_tolerance;
  std::optional<Precision> given_precision;
  std::optional<double> error;
  std::vector<std::string> of;
  std::optional<AskedError> limits;
};

std::string_view estimate_text(Accuracy::Estimate estimate) {
  return estimate == Accuracy::Estimate::none      ? "false"
         : estimate == Accuracy::Estimate::coarser ? "true"
                                                   : "\"finer\"";
}

void read_estimate(const Argument& value, const OptionInfo& info, AccuracyKeys& keys, Problems& problems) {
  if (value.is_boolean())
    keys.estimate = value.boolean() ? Accuracy::Estimate::coarser : Accuracy::Estimate::none;
  else if (value.is_text() && value.text() == "finer")
    keys.estimate = Accuracy::Estimate::finer;
  else
    detail::wrong_type(value, info, "true, false or \"finer\"", problems);
}

void read_effect_names(const Argument& value, const OptionInfo& info, AccuracyKeys& keys,
                       Problems& problems) {
  if (value.is_text()) {
    keys.of = {std::string(value.text())};
    return;
  }
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(value, info, "a name such as \"approach\", or a list of them", problems);
  value.elements([&](const Argument& name) {
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
        "`error` and `estimate`=\"finer\" are both given; `error` compares with the coarser grids that it "
        "has tried, so leave one of the two out");
  if ((!keys.of.empty() || keys.limits) && !keys.error)
    problems.push_back(std::string(keys.limits ? "`at_most`" : "`of`") +
                       " is given without `error`; give the relative error as well, such as error=0.01");
  if (keys.given_tolerance) keys.tolerance = *keys.given_tolerance;
  keys.precision_named = keys.given_precision.has_value();
  if (keys.given_precision) keys.precision = *keys.given_precision;
  if (!keys.error) return;
  if (keys.of.empty()) keys.of = {"corrected_area_fraction"};
  keys.asked = keys.limits.value_or(AskedError{});
  keys.asked->error = *keys.error;
  keys.asked->of = keys.of;
}

const Block<AskedError> limits_block{
    {integer("cells", &AskedError::most_cells, between(16, max_cells), "cells a side"),
     number("memory", &AskedError::most_bytes, above(0), "bytes of memory of a press"),
     quantity("time", &AskedError::most_seconds, dimension::time, above(0),
              "expected for all grids together, by the plan of a press")}};

const Block<AccuracyKeys> accuracy_block{
    {number("tolerance", &AccuracyKeys::given_tolerance, {1e-15, 1, false, true, false},
            "bound on every relative entry of the certificate")
         .defaults_to("1e-06"),
     choice("precision", &AccuracyKeys::given_precision,
            {{"double", Accuracy::Precision::double_}, {"single", Accuracy::Precision::single}},
            "of the transforms inside a half-space solve. In \"double\" those of a step may be rounded to "
            "single precision on 256 x 256 nodes and more, where that saves time and gaps computed afresh "
            "later take it back; \"single\" rounds them on any grid and saves memory on a periodic tile. The "
            "certificate is double always. Boxes refuse it")
         .shown_by([](const AccuracyKeys& keys) {
           return std::string(keys.precision == Accuracy::Precision::single ? "\"single\"" : "\"double\"");
         })
         .defaults_to("\"double\""),
     choice("on_failure", &Accuracy::on_failure,
            {{"error", Accuracy::OnFailure::error}, {"best", Accuracy::OnFailure::best}},
            "a solve that misses its tolerance or `error`: raise an error, or return the best result"),
     custom<AccuracyKeys>(
         "estimate", "boolean|\"finer\"",
         "solves each press on other cells too, for st.error.discretisation: true on half and a quarter of "
         "them, which costs about a third of the press and mostly bounds the error; \"finer\" on thrice the "
         "cells a side, which costs about eleven times the press and is within a factor of three of the true "
         "error, above and below, in nine cases of ten",
         read_estimate)
         .shown_by([](const AccuracyKeys& keys) { return std::string(estimate_text(keys.estimate)); })
         .defaults_to("false"),
     number("error", &AccuracyKeys::error, {1e-6, 1, false, true, false},
            "relative error to be met instead of a tolerance: the first press chooses cells and tolerance"),
     custom<AccuracyKeys>("of", "string|string[]", "quantities of a state whose error that is",
                          read_effect_names)
         .defaults_to("\"corrected_area_fraction\""),
     table_of<AccuracyKeys>("at_most", &AccuracyKeys::limits, limits_block,
                            "limits of the grids for `error`")},
    finish_accuracy};

struct SceneKeys {
  std::optional<Surface> lower;
  std::optional<UpperBody> upper;
  std::optional<Boundary> boundary;
  std::optional<Elasticity> elasticity;
  Effects effects;
  AccuracyKeys accuracy;
};

void read_elasticity(const Argument& value, const OptionInfo&, SceneKeys& keys, Problems& problems) {
  detail::collect(problems, [&] {
    if (value.is_table()) {
      keys.elasticity = elasticity_block().read(value, "`effects.elasticity`");
    } else if (value.is_text()) {
      const ElasticModel& model = require_elastic_model(value.text());
      if (needs_options(model))
        refuse("`effects.elasticity` is \"" + std::string(model.name) + "\" without its options",
               "give " + written(model, false));
      keys.elasticity = Elasticity(model, model.defaults);
    } else {
      problems.push_back("`effects.elasticity` is " + value.describe() + "; give " +
                         joined(ways_to_write(), " or "));
    }
  });
}

Option<SceneKeys> effect_option(const Effect& effect) {
  const RowBlock& block = effect_block(effect);
  Option<SceneKeys> option = custom<SceneKeys>(
      std::string(effect.name), "table", effect.sentence,
      [&](const Argument& value, const OptionInfo& info, SceneKeys& keys, Problems& problems) {
        if (!value.is_table())
          return detail::wrong_type(value, info, "a table of named keys, {} for its defaults", problems);
        detail::collect(problems, [&] { keys.effects.set(effect, block.read(value, quoted(info.name))); });
      });
  option.info.inner = &block;
  return option;
}

const std::vector<Option<SceneKeys>>& effect_options() {
  using K = SceneKeys;
  static const std::vector<Option<K>> options = [] {
    std::string type;
    for (const ElasticModel* model : elastic_models())
      if (!needs_options(*model)) type += "\"" + std::string(model->name) + "\"|";
    Option<K> elasticity = custom<K>(std::string(elasticity_effect), type + "table",
                                     "elastic deformation of the bodies", read_elasticity);
    elasticity.info.inner = &elasticity_block();
    elasticity.info.required = true;
    std::vector<Option<K>> all{std::move(elasticity)};
    for (const Effect* effect : known_effects()) all.push_back(effect_option(*effect));
    return all;
  }();
  return options;
}
const Block<SceneKeys> effects_block{effect_options()};

// Effects missing from this build are refused.
void read_effects(const Argument& value, const OptionInfo& info, SceneKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { elasticity=\"box\" }", problems);
  const std::vector<std::string> names = effects_named(value, "; write { elasticity=\"box\" }", problems);
  for (const std::string& name : names) {
    detail::collect(problems, [&] {
      (void)require_effect(name);
      for (const Option<SceneKeys>& option : effect_options())
        if (option.info.name == name)
          with_key(value, name,
                   [&](const Argument& given) { option.read(given, option.info, keys, problems); });
    });
  }
  if (std::find(names.begin(), names.end(), elasticity_effect) == names.end())
    problems.push_back("`effects` names no elasticity; give elasticity=" + joined(ways_to_write(), " or "));
}

Option<SceneKeys> effects() {
  Option<SceneKeys> option = custom<SceneKeys>(
      "effects", "table",
      "computed effects by name, e.g. { elasticity=\"box\" }; no other effect is computed", read_effects);
  option.info.inner = &effects_block;
  return std::move(option).required();
}

void require_boundary(SceneKeys& keys, Problems& problems) {
  if (keys.elasticity && !keys.boundary && !keys.elasticity->model().boundary.empty())
    problems.push_back(keys.elasticity->model().boundary);
}

const Block<SceneKeys> scene_block{
    {native<Surface>("lower", &SceneKeys::lower, "Surface", "a surface", "the lower body, rough side up")
         .required(),
     custom<SceneKeys>(
         "upper", "Surface|Material",
         "the upper body: a rough surface that is turned over to face down, a flat of a material, or "
         "lab.rigid",
         [](const Argument& value, const OptionInfo& info, SceneKeys& keys, Problems& problems) {
           if (const Surface* surface = value.as<Surface>())
             keys.upper = *surface;
           else if (const Material* material = value.as<Material>())
             keys.upper = *material;
           else if (const Object* object = value.as_any_object(); object != nullptr && object->closed)
             problems.push_back("`upper` was closed");
           else if (value.is_text())
             problems.push_back("`upper` is the string \"" + std::string(value.text().substr(0, 40)) +
                                "\"; give " +
                                (value.text() == "rigid"
                                     ? std::string("lab.rigid")
                                     : "lab.material \"" + std::string(value.text().substr(0, 40)) + "\""));
           else if (!value.is_unknown())
             detail::wrong_type(value, info, "a surface, a material or lab.rigid", problems);
         })
         .required(),
     choice("boundary", &SceneKeys::boundary, {{"free", Boundary::free}, {"periodic", Boundary::periodic}},
            "whether the tile goes on beyond its rim; required for a half-space")
         .defaults_to("\"free\" for boxes"),
     effects(),
     table_of("accuracy", &SceneKeys::accuracy, accuracy_block,
              "required accuracy of a solve, and the action on failure")},
    require_boundary};

Scene scene_of(const SceneKeys& keys, Surface lower, UpperBody upper) {
  Scene scene{std::move(lower), std::move(upper), keys.boundary.value_or(Boundary::free), *keys.elasticity,
              keys.accuracy};
  scene.effects = keys.effects;
  return scene;
}

}  // namespace

std::vector<std::string> effects_named(const Argument& value, const std::string& hint, Problems& problems) {
  std::vector<std::string> names;
  value.each([&](const Argument& key, const Argument&) {
    if (key.is_text())
      names.emplace_back(key.text());
    else
      problems.push_back("`effects` holds " + key.describe() + " as a key" + hint);
  });
  std::sort(names.begin(), names.end());
  return names;
}

const RowBlock& effect_block(const Effect& effect) {
  static const std::map<const Effect*, RowBlock> blocks = [] {
    std::map<const Effect*, RowBlock> made;
    for (const Effect* known : known_effects())
      made.emplace(known, RowBlock(known->options, known->defaults));
    return made;
  }();
  return blocks.at(&effect);
}

Scene read_scene(Call& call) {
  const SceneKeys keys = call.options(scene_block);
  Scene scene = scene_of(keys, *keys.lower, *keys.upper);
  if (Refinement* refinement = refinement_of(call.L)) {
    const double tolerance = refinement->tolerance_for(scene.accuracy.tolerance);
    if (refinement->tolerance) scene.accuracy = with_tolerance(scene.accuracy, tolerance);
  }
  return scene;
}

void look_at_scene(const Call& call) {
  const Argument table = call.argument(1);
  if (!table.is_table()) return;
  constexpr int nested = 3;
  for (const char* key : {"boundary", "effects", "accuracy"})
    if (with_key(table, key, [&](const Argument& value) { return holds_unknown(value, nested); })) return;
  SceneKeys keys = call.options(scene_block);
  Problems problems;
  require_boundary(keys, problems);
  if (!problems.empty()) refuse(call.function_name() + ": " + problems.front());
  const auto body = [&](const char* key) { return with_key(table, key, known_body); };
  const auto lower = body("lower"), upper = body("upper");
  const bool flat = keys.upper && std::holds_alternative<Material>(*keys.upper);
  if (lower == nullptr || (upper == nullptr && !flat)) return;
  if (upper != nullptr && lower->grid && upper->grid) check_tiles(*lower->grid, *upper->grid);
  KnownBody same_size = upper != nullptr ? *upper : KnownBody{};
  same_size.grid = lower->grid;
  Scene scene = scene_of(keys, stand_in(*lower), flat ? *keys.upper : UpperBody(stand_in(same_size)));
  scene.accuracy = without_companion(scene.accuracy);  // needs the true cells
  (void)SpecimenPair(scene);
}

const BlockInfo& scene_keys() { return scene_block; }

}  // namespace asperity::lua
