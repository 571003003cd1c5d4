// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/contact/elasticity/slabs/slab_solve.hpp"
#include "engine/contact/scene/elastic_model.hpp"
#include "engine/contact/scene/known_effects.hpp"
#include "engine/contact/scene/press_request.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

struct spread_SceneKeys {
  std::optional<SlabSurface> lower;
  std::optional<Material> upper;
  Boundary boundary = Boundary::periodic;
  bool elastic = false;
  Effects effects;
  Accuracy accuracy;
};

const Block<Accuracy> spread_accuracy_block{
    {number("tolerance", &Accuracy::tolerance, {1e-15, 1, false, true, false},
            "bound on every relative entry of the certificate"),
     choice("on_failure", &Accuracy::on_failure,
            {{"error", Accuracy::OnFailure::error}, {"best", Accuracy::OnFailure::best}},
            "a solve that misses its tolerance: raise an error, or return the best result")}};

void read_effect(const std::string& name, const Argument& given, spread_SceneKeys& keys, Problems& problems) {
  const Effect* effect = require_effect(name);
  if (effect == nullptr) {
    std::string model(given.is_text() ? given.text() : "");
    if (given.is_table())
      with_key(given, "model", [&](const Argument& named) {
        if (named.is_text()) model = named.text();
      });
    if (model.empty())
      problems.push_back("`effects.elasticity` is " + given.describe() +
                         "; over ranks it is \"half_space\", and lab.contact computes the others");
    else if (const ElasticModel& known = require_elastic_model(model); !known.over_ranks)
      problems.push_back("`effects.elasticity` names " + std::string(known.noun) +
                         ", not computed over ranks; give \"half_space\", or use lab.contact");
    else
      keys.elastic = true;
  } else if (!effect->over_ranks) {
    std::vector<std::string> computed{std::string(elasticity_effect)};
    for (const Effect* known : known_effects())
      if (known->over_ranks) computed.emplace_back(known->name);
    problems.push_back("`effects." + name + "` is not computed over ranks, which know " +
                       joined(computed, " and ") + "; leave it out, or use lab.contact");
  } else if (given.is_table()) {
    keys.effects.set(*effect, effect_block(*effect).read(given, "`effects." + name + "`"));
  } else {
    problems.push_back("`effects." + name + "` is " + given.describe() +
                       "; give a table such as { hardness=\"1 GPa\" }, {} for its defaults");
  }
}

void spread_read_effects(const Argument& value, const OptionInfo& info, spread_SceneKeys& keys,
                         Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { elasticity=\"half_space\" }", problems);
  const std::vector<std::string> names = effects_named(value, "", problems);
  for (const std::string& name : names)
    detail::collect(problems, [&] {
      with_key(value, name, [&](const Argument& given) { read_effect(name, given, keys, problems); });
    });
  if (std::find(names.begin(), names.end(), elasticity_effect) == names.end())
    problems.push_back("`effects` names no elasticity; give elasticity=\"half_space\"");
}

const Block<spread_SceneKeys> spread_scene_block{
    {custom<spread_SceneKeys>(
         "lower", "SpreadSurface", "the lower body, rough side up, from lab.spread",
         [](const Argument& value, const OptionInfo& info, spread_SceneKeys& keys, Problems& problems) {
           if (const SlabSurface* surface = value.as<SlabSurface>())
             keys.lower = *surface;
           else if (const Object* other = value.as_any_object();
                    other != nullptr && other->type == &class_of<Surface>())
             problems.push_back(
                 "`lower` is a surface that every rank holds; make it with lab.spread, or press it with "
                 "lab.contact");
           else if (!value.is_unknown())
             detail::wrong_type(value, info, "a surface from lab.spread", problems);
         })
         .required(),
     custom<spread_SceneKeys>(
         "upper", "Material", "a flat of a material, or lab.rigid",
         [](const Argument& value, const OptionInfo& info, spread_SceneKeys& keys, Problems& problems) {
           if (const Material* material = value.as<Material>())
             keys.upper = *material;
           else if (!value.is_unknown())
             detail::wrong_type(value, info, "a material or lab.rigid; over ranks the upper body is flat",
                                problems);
         })
         .required(),
     custom<spread_SceneKeys>(
         "boundary", "\"periodic\"", "the tile goes on beyond its rim",
         [](const Argument& value, const OptionInfo& info, spread_SceneKeys&, Problems& problems) {
           if (value.is_text() && value.text() == "free")
             problems.push_back(
                 "`boundary` is \"free\", which is not computed over ranks; give \"periodic\", or use "
                 "lab.contact");
           else if (!value.is_text() || value.text() != "periodic")
             detail::wrong_type(value, info, "\"periodic\"", problems);
         })
         .required(),
     custom<spread_SceneKeys>("effects", "table",
                              "computed effects: { elasticity=\"half_space\" }, and plasticity={ hardness= } "
                              "if pressure is limited",
                              spread_read_effects)
         .required(),
     table_of("accuracy", &spread_SceneKeys::accuracy, spread_accuracy_block,
              "required accuracy of a solve, and the action on failure")}};

Values spread_make_contact(Call& call) {
  const spread_SceneKeys keys = call.options(spread_scene_block);
  const SlabTerms terms = slab_terms(keys.lower->material, *keys.upper, keys.effects);
  SpreadContact contact;
  contact.problem.surface = *keys.lower;
  contact.problem.modulus = terms.modulus;
  contact.problem.cap = terms.cap;
  contact.problem.tolerance = keys.accuracy.tolerance;
  contact.problem.best_effort = keys.accuracy.on_failure == Accuracy::OnFailure::best;
  contact.plastic = keys.effects.any_that(Effect::Acts::bounds_pressure);
  return {object(std::move(contact))};
}

struct SpreadPress {
  std::optional<double> pressure, load, approach, indentation;
};

const Block<SpreadPress> spread_press_block{
    {quantity("pressure", &SpreadPress::pressure, dimension::pressure, any(), "mean pressure over the tile"),
     quantity("load", &SpreadPress::load, dimension::force, any(), "force on the whole tile"),
     quantity("approach", &SpreadPress::approach, dimension::length, any(), "from first touch"),
     quantity("indentation", &SpreadPress::indentation, dimension::number, any(),
              "approach over the peak-to-valley of the heights")},
    [](SpreadPress& keys, Problems& problems) {
      const int given = int{keys.pressure.has_value()} + int{keys.load.has_value()} +
                        int{keys.approach.has_value()} + int{keys.indentation.has_value()};
      if (given != 1)
        problems.push_back("give exactly one of `pressure`, `load`, `approach` and `indentation`; " +
                           std::to_string(given) + " are given");
    }};

std::string digest_of(const SpreadState& state) {
  const SlabContactAnswer& a = *state.answer;
  Digester digester;
  digester.add(state.surface.digest);
  for (const double number :
       {a.mean_pressure, a.approach, a.peak_pressure, a.mean_gap, a.energy, a.plastic_volume,
        static_cast<double>(a.contacts), static_cast<double>(a.yielded), static_cast<double>(a.iterations),
        a.certificate.worst()})
    digester.add(number);
  return digester.hex();
}

Values spread_press(Call& call) {
  const SpreadContact& contact = call.self<SpreadContact>();
  const SpreadPress keys = call.options(spread_press_block);
  const SlabSurface& surface = contact.problem.surface;
  if (keys.indentation && surface.peak == surface.valley)
    refuse("`indentation` is a fraction of a peak-to-valley that is zero",
           "give `pressure`, `load` or `approach`");
  SpreadState state;
  state.problem = contact.problem;
  if (keys.approach || keys.indentation)
    state.request = {true,
                     keys.approach ? *keys.approach : *keys.indentation * (surface.peak - surface.valley)};
  else
    state.request = {false, keys.pressure ? *keys.pressure : *keys.load / surface.grid.area()};
  Team& team = team_of(call);
  Monitor& monitor = call.session().monitor();
  state.surface = surface;
  state.plastic = contact.plastic;
  state.ranks = team.size();
  if (auto recalled = recalled_press(call, team, contact.problem, state.request)) {
    state.has_fields = false;
    state.cost = recalled->cost;
    state.answer = std::make_shared<const SlabContactAnswer>(std::move(recalled->result));
  } else {
    const CostScope scope;
    Costed<SlabContactAnswer> fresh;
    fresh.result = solve(team, contact.problem, state.request, monitor);
    fresh.cost = scope.so_far();
    const auto held = fresh.cost.bytes + static_cast<std::int64_t>(surface.heights->size() * sizeof(double));
    fresh.cost.bytes = static_cast<std::int64_t>(-team.reduce<0, 1>({-static_cast<double>(held)})[0]);
    keep_press(call, contact.problem, state.request, fresh);
    state.cost = fresh.cost;
    state.answer = std::make_shared<const SlabContactAnswer>(std::move(fresh.result));
  }
  state.digest = digest_of(state);
  return {object(std::move(state))};
}

}  // namespace

SlabContactAnswer solve(Team& team, const SlabContactProblem& problem, const SpreadRequest& request,
                        Monitor& monitor) {
  return request.by_approach ? solve_slabs_at_approach(team, problem, request.value, monitor)
                             : solve_slabs_at_pressure(team, problem, request.value, nullptr, monitor);
}

Function spread_contact_function() {
  return {.name = "contact",
          .body = spread_make_contact,
          .sentence =
              "A periodic half-space contact over the ranks, under a flat: the problem, the certificates and "
              "the units of lab.contact. Nothing stays on the surface after a press.",
          .options = &spread_scene_block,
          .returns = "SpreadContact",
          .example =
              "local c = lab.spread.contact{ lower=tile, upper=lab.rigid, boundary=\"periodic\", effects={ "
              "elasticity=\"half_space\" } }"};
}

Class make_class(For<SpreadContact>) {
  Class c{"SpreadContact", "a contact over ranks",
          "A surface in slabs under a flat, ready to be pressed by all ranks together."};
  c.shareable = false;
  c.describe = from_value([](const SpreadContact& of) -> std::string {
    const auto& s = of.problem.surface;
    return "contact of " + std::to_string(s.grid.nx) + " x " + std::to_string(s.grid.ny) + " cells over " +
           std::to_string(s.slab.ranks) + (s.slab.ranks == 1 ? " rank" : " ranks");
  });
  c.digest = from_value([](const SpreadContact& of) { return of.problem.surface.digest; });
  c.methods = {{.name = "press",
                .body = spread_press,
                .sentence = "The state under a load, found by all ranks together, each with its rows.",
                .options = &spread_press_block,
                .returns = "SpreadState",
                .example = "local st = spread:press{ pressure=\"10 MPa\" }",
                .heavy = true}};
  return c;
}

}  // namespace asperity::lua
