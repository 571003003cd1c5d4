// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/plan.hpp"

#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string tile_text(const Grid& grid, Boundary boundary) {
  return std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " cells, " +
         format_quantity(grid.size_x, dimension::length) + " x " +
         format_quantity(grid.size_y, dimension::length) + ", " + std::string(name(boundary)) + " boundary";
}

void line(std::string& text, std::string_view label, const std::string& content) {
  constexpr std::size_t width = 14;
  text += "  ";
  text += label;
  text.append(label.size() < width ? width - label.size() : 1, ' ');
  text += content + "\n";
}

std::string of_which_press(const Plan& plan) {
  if (!plan.press.empty()) return " of the press " + plan.press;
  if (plan.transforms == 0) return {};
  return " of a press by `pressure`, a rough guess; c:explain{ approach= } takes the keys of c:press";
}

Plan planned(const Scene& scene, const ContactGeometry& geometry,
             std::shared_ptr<const ElasticOperator> elasticity) {
  Plan plan;
  plan.title = tile_text(geometry.grid(), scene.boundary);
  plan.overlap = geometry.overlap_fraction();
  plan.accuracy = scene.accuracy;
  plan.elasticity = std::move(elasticity);
  if (!geometry.upper_is_flat())
    plan.buffers.push_back(
        {"combined heights", static_cast<std::int64_t>(geometry.grid().nodes() * sizeof(double))});
  plan.terms.push_back({std::string(elasticity_effect), plan.elasticity->sentence});
  plan.elasticity->plan(geometry, plan);
  plan.effects = scene.effects;
  for (const Effect* effect : known_effects())
    if (const std::any* options = scene.effects.options_of(*effect)) effect->plan(*options, geometry, plan);
  plan.elasticity->plan_after_effects(geometry, plan);
  for (const PlannedTerm& term : plan.terms)
    if (std::find(plan.effects_run.begin(), plan.effects_run.end(), term.effect) == plan.effects_run.end())
      plan.effects_run.push_back(term.effect);
  plan.effects_off = effects_not_in(plan.effects_run);
  return plan;
}

}  // namespace

bool Plan::attracts() const {
  return std::any_of(attraction.begin(), attraction.end(), [](const GapTerm& term) { return term.work > 0; });
}

std::int64_t Plan::bytes_of(bool PlannedBuffer::*which) const {
  std::int64_t sum = 0;
  for (const PlannedBuffer& buffer : buffers) sum += which == nullptr || buffer.*which ? buffer.bytes : 0;
  return sum;
}

void hold_flattening(Plan& plan) {
  if (plan.bytes_to_flatten == 0) return;
  plan.buffers.push_back({"search for the load of a press by `flatten`", plan.bytes_to_flatten, false});
  plan.bytes_to_flatten = 0;
}

std::string Plan::text() const {
  std::string result = "contact of " + title + "\n";
  if (overlap < 1)
    line(result, "overlap",
         "the bodies face each other on " + format_short(100 * overlap, 3) +
             " % of the tile; pressure is load over all of it");
  for (const PlannedTerm& term : terms) line(result, term.effect, term.sentence);
  if (!choice.empty()) line(result, "accuracy", choice);
  line(result, "solver", solver + ", tolerance " + format_short(accuracy.tolerance));
  if (!estimate.empty()) line(result, "estimate", estimate);
  line(result, "transforms",
       (press.empty() ? format_short(transforms) : format_short(transforms, 3)) + " expected" +
           of_which_press(*this));
  for (const PlannedBuffer& buffer : buffers)
    line(result, "memory",
         format_bytes(buffer.bytes) + " " + buffer.name + (buffer.kept ? "" : ", for a moment"));
  line(result, "memory", format_bytes(bytes_kept()) + " kept, " + format_bytes(bytes_peak()) + " at most");
  if (bytes_to_flatten > 0)
    line(result, "memory", format_bytes(bytes_to_flatten) + " more for a press by `flatten`, for a moment");
  line(result, "time", "about " + format_quantity(seconds, dimension::time, 3) + " for the first press");
  for (const std::string& warning : warnings) line(result, "warning", warning);
  if (!effects_off.empty()) line(result, "off", joined(effects_off, ", ") + " (not named in the scene)");
  return result;
}

Plan make_plan(const Scene& scene, const ContactGeometry& geometry) {
  return planned(scene, geometry, scene.elasticity.model().make(scene.elasticity.options(), geometry));
}

Plan make_plan_like(const Plan& before, const Scene& scene, const ContactGeometry& geometry) {
  return planned(scene, geometry, before.elasticity);
}

Json to_json(const Plan& plan) {
  Json::List terms, buffers;
  for (const PlannedTerm& term : plan.terms)
    terms.push_back(Json::object({{"effect", term.effect}, {"sentence", term.sentence}}));
  for (const PlannedBuffer& buffer : plan.buffers)
    buffers.push_back(Json::object({{"name", buffer.name}, {"bytes", buffer.bytes}, {"kept", buffer.kept}}));
  return Json::object({{"contact", plan.title},
                       {"overlap_fraction", plan.overlap},
                       {"terms", terms},
                       {"solver", plan.solver},
                       {"tolerance", plan.accuracy.tolerance},
                       {"estimate", plan.estimate},
                       {"transforms", plan.transforms},
                       {"press", plan.press},
                       {"buffers", buffers},
                       {"bytes_kept", plan.bytes_kept()},
                       {"bytes_peak", plan.bytes_peak()},
                       {"bytes_to_flatten", plan.bytes_to_flatten},
                       {"seconds", plan.seconds},
                       {"warnings", Json::strings(plan.warnings)},
                       {"effects_run", Json::strings(plan.effects_run)},
                       {"effects_off", Json::strings(plan.effects_off)}});
}

}  // namespace asperity
