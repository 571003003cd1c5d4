// SPDX-License-Identifier: GPL-3.0-or-later
// Only named effects are computed: the tests count transforms, peak bytes, buffers, stored memory and
// operator applications for every effect and pair. Every effect of the catalogue needs a row of `effects`.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/effects/ageing.hpp"
#include "engine/contact/effects/capillarity.hpp"
#include "engine/contact/effects/creep.hpp"
#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/text.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/specimen/counted_scenes.hpp"

namespace asperity::effects_counted_test {
namespace {

using namespace counted_scenes;

struct Effect {
  const char* name;
  std::function<void(Scene&)> add;
  bool of_boxes = true;  // computed for box elements too
  const char* needs = nullptr;
  Names excludes{};
  bool changes_the_normal_contact = false;
  const char* line = nullptr;    // in the cost; none: a press does nothing for it
  bool of_the_accuracy = false;  // not of the catalogue
};

const std::vector<Effect> effects = {
    {.name = "plasticity",
     .add = [](Scene& scene) { scene.effects.set(PlasticityOptions{hardness}); },
     .excludes = {"tangential", "adhesion", "capillarity"},
     .changes_the_normal_contact = true,
     .line = "plasticity"},
    {.name = "creep",
     .add = [](Scene& scene) { scene.effects.set(CreepOptions{}); },
     .needs = "plasticity",
     .excludes = {"tangential", "adhesion", "capillarity"},
     .changes_the_normal_contact = true},
    {.name = "ageing",
     .add =
         [](Scene& scene) {
           scene.effects.set(AgeingOptions{0.1, 1});
         }},
    {.name = "interlocking", .add = [](Scene& scene) { scene.effects.set(InterlockingOptions{}); }},
    {.name = "tangential",
     .add = [](Scene& scene) { scene.effects.set(TangentialOptions{1.2}); },
     .excludes = {"plasticity", "adhesion", "capillarity"}},
    {.name = "capillarity",
     .add =
         [](Scene& scene) {
           scene.effects.set(CapillarityOptions{.pressure = 1e-3, .surface_tension = 5e-6});
         },
     .of_boxes = false,
     .excludes = {"estimate on coarser grids", "estimate on a finer grid"},
     .changes_the_normal_contact = true,
     .line = "capillarity"},
    {.name = "adhesion",
     .add =
         [](Scene& scene) {
           scene.effects.set(AdhesionOptions{1e-5, 0.01});
         },
     .of_boxes = false,
     .excludes = {"estimate on coarser grids", "estimate on a finer grid"},
     .changes_the_normal_contact = true,
     .line = "adhesion"},
    {.name = "estimate on coarser grids",
     .add = [](Scene& scene) { scene.accuracy.estimate = Accuracy::Estimate::coarser; },
     .excludes = {"estimate on a finer grid"},
     .line = "estimate",
     .of_the_accuracy = true},
    {.name = "estimate on a finer grid",
     .add = [](Scene& scene) { scene.accuracy.estimate = Accuracy::Estimate::finer; },
     .excludes = {"estimate on coarser grids"},
     .line = "estimate",
     .of_the_accuracy = true},
};

const Effect& effect_named(std::string_view name) {
  return *std::find_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.name == name; });
}

// With required effects; empty if incompatible.
Names completed(const Names& asked, const Bench& bench) {
  Names names;
  for (const std::string& name : asked) {
    const Effect& effect = effect_named(name);
    if (effect.needs != nullptr && !holds(names, effect.needs)) names.emplace_back(effect.needs);
    if (!holds(names, name)) names.push_back(name);
  }
  for (const std::string& name : names) {
    const Effect& effect = effect_named(name);
    for (const std::string& other : effect.excludes)
      if (holds(names, other)) return {};
    if (!effect.of_boxes && bench.elasticity.is<BoxOptions>()) return {};
  }
  return names;
}

Scene with_effects(Scene scene, const Names& names) {
  for (const std::string& name : names) effect_named(name).add(scene);
  return scene;
}

struct Counted {
  Cost press;
  std::vector<std::pair<std::string, Cost>> by_effect;
  std::int64_t kept = 0;  // held after the state was destroyed
  std::size_t buffers = 0;
  std::int64_t planned = 0;
  int iterations = 0;
  std::string digest;
  Names run, off, terms;

  double transforms_of(std::string_view effect) const {
    for (const auto& [name, cost] : by_effect)
      if (name == effect) return cost.transforms;
    return 0;
  }
  Names lines() const {
    Names names;
    for (const auto& entry : by_effect) names.push_back(entry.first);
    return names;
  }
};

Counted count_once(const Scene& scene, const PressRequest& request) {
  Counted result;
  SpecimenPair pair(scene);
  const std::int64_t before = memory::held();
  {
    const CostScope scope;
    const State state = pair.press(request);
    result.press = scope.so_far();
    result.by_effect = state.cost().by_effect;
    result.iterations = state.iterations();
    result.digest = state.digest();
    result.run = state.effects_run();
    result.off = state.effects_off();
  }
  result.kept = memory::held() - before;
  result.buffers = pair.plan().buffers.size();
  result.planned = pair.plan().bytes_peak();
  for (const PlannedTerm& term : pair.plan().terms) result.terms.push_back(term.effect);
  return result;
}

// Returns the second count; the first includes filled caches.
Counted count(const Scene& scene, const PressRequest& request = {PressBy::pressure, pressed, {}}) {
  count_once(scene, request);
  return count_once(scene, request);
}

using EffectsCounted = OnOneThread;

TEST_F(EffectsCounted, EveryEffectThatIsComputedHasARow) {
  for (const auto* known : known_effects())
    EXPECT_TRUE(
        std::any_of(effects.begin(), effects.end(), [&](const Effect& e) { return known->name == e.name; }))
        << known->name << " is computed, but nothing here counts what it does when it is not named";
}

// The same bytes apart from the solver's input and output.
TEST_F(EffectsCounted, ABareHalfSpaceIsItsSolverAlone) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    SCOPED_TRACE(name(boundary));
    Scene scene = bare_scene({"", boundary, HalfSpaceOptions{}});
    SpecimenPair pair(scene);
    const std::shared_ptr<const Solver> solver = pair.solver();
    const ContactGeometry geometry(scene, LatticeIsometry(48, 48));
    HalfSpaceProblem problem;
    problem.grid = geometry.grid();
    problem.boundary = boundary;
    problem.modulus = pair.plan().elasticity->modulus;
    problem.heights = std::make_shared<const Field>(geometry.combined());
    const double middle = mean(problem.heights->values());
    Array<double> squares(problem.heights->size());
    for (std::size_t k = 0; k < squares.size(); ++k)
      squares[k] = ((*problem.heights)[k] - middle) * ((*problem.heights)[k] - middle);
    problem.rms = std::sqrt(block_sum(squares) / static_cast<double>(squares.size()));
    problem.tolerance = tolerance;
    const auto bare = [&] {
      const CostScope scope;
      const HalfSpaceAnswer answer = solve_at_pressure(problem, pressed, nullptr, Monitor::silent());
      return std::pair{scope.so_far(), answer.pressure};
    };
    bare();
    const auto [cost, pressures] = bare();
    const CostScope scope;
    const State state = pair.press({PressBy::pressure, pressed, {}});
    const Cost mine = scope.so_far();
    EXPECT_EQ(mine.transforms, cost.transforms);
    EXPECT_EQ(mine.bytes, cost.bytes);
    const std::shared_ptr<const Field> field = state.field("pressure");
    EXPECT_TRUE(std::equal(pressures.values().begin(), pressures.values().end(), field->values().begin()));
  }
}

TEST_F(EffectsCounted, WhatIsNotNamedContributesNothing) {
  for (const Bench& bench : benches) {
    const Counted bare = count(bare_scene(bench));
    EXPECT_EQ(bare.lines(), Names{"elasticity"});
    for (std::size_t i = 0; i < effects.size(); ++i) {
      for (std::size_t k = i; k < effects.size(); ++k) {
        const Names named = completed({effects[i].name, effects[k].name}, bench);
        if (named.empty()) continue;
        SCOPED_TRACE(std::string(bench.name) + ": " + joined(named, " and "));
        const Counted found = count(with_effects(bare_scene(bench), named));

        // The lines add up to the total.
        Names expected = {"elasticity"};
        for (const std::string& name : named)
          if (effect_named(name).line != nullptr) expected.emplace_back(effect_named(name).line);
        Names lines = found.lines();
        std::sort(lines.begin(), lines.end());
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(lines, expected);
        double transforms = 0;
        for (const auto& entry : found.by_effect) transforms += entry.second.transforms;
        EXPECT_DOUBLE_EQ(transforms, found.press.transforms);
        for (const Effect& effect : effects) {
          const bool on = holds(named, effect.name) && !effect.of_the_accuracy;
          EXPECT_EQ(holds(found.terms, effect.name), on) << effect.name;
          EXPECT_EQ(holds(found.run, effect.name), on) << effect.name;
          if (!effect.of_the_accuracy) {
            EXPECT_EQ(holds(found.off, effect.name), !on) << effect.name;
          }
        }

        for (const std::string& name : named) {
          const Effect& effect = effect_named(name);
          if (effect.changes_the_normal_contact) continue;
          Names others = named;
          others.erase(std::find(others.begin(), others.end(), name));
          const Counted without = count(with_effects(bare_scene(bench), others));
          EXPECT_EQ(found.digest, without.digest) << name;
          EXPECT_EQ(found.iterations, without.iterations) << name;
          EXPECT_EQ(found.transforms_of("elasticity"), without.transforms_of("elasticity")) << name;
          if (effect.line != nullptr) {
            EXPECT_DOUBLE_EQ(found.press.transforms - found.transforms_of(effect.line),
                             without.press.transforms)
                << name;
            continue;
          }
          EXPECT_EQ(found.press.transforms, without.press.transforms) << name;
          EXPECT_EQ(found.press.bytes, without.press.bytes) << name;
          EXPECT_EQ(found.buffers, without.buffers) << name;
          EXPECT_EQ(found.planned, without.planned) << name;
          if (name != "tangential") {
            EXPECT_EQ(found.kept, without.kept) << name;
          }
        }
      }
    }
  }
}

TEST_F(EffectsCounted, OnlyAPullKeepsTheStateItStartsFrom) {
  for (const Bench& bench : benches) {
    if (bench.elasticity.is<BoxOptions>()) continue;
    const Counted bare = count(bare_scene(bench)),
                  pulled = count(with_effects(bare_scene(bench), {"tangential"}));
    const auto nodes = static_cast<std::int64_t>(48 * 48);
    EXPECT_EQ(bare.kept, 0) << bench.name;
    EXPECT_EQ(pulled.kept, 2 * 8 * nodes) << bench.name;
  }
}

TEST_F(EffectsCounted, FrictionWorksOutWhatIsNamed) {
  const JunctionLaw law({.tau0 = 0.01, .alpha = 0.2});
  for (const Bench& bench : benches) {
    SCOPED_TRACE(bench.name);
    const auto cost_of = [&](const Names& named, std::optional<double> rest) {
      SpecimenPair pair(with_effects(bare_scene(bench), named));
      const State state = pair.press({PressBy::pressure, pressed, {}});
      const CostScope scope;
      const FrictionResult result = law.on(state, rest);
      EXPECT_EQ(result.interlocking_force.has_value(), holds(named, "interlocking"));
      EXPECT_EQ(result.strengthening.has_value(), holds(named, "ageing"));
      return scope.so_far();
    };
    for (const Names& named : {Names{}, Names{"tangential"}}) {
      const Cost cost = cost_of(named, {});
      EXPECT_EQ(cost.transforms, 0);
      EXPECT_EQ(cost.bytes, 0);
    }
    EXPECT_EQ(cost_of({"ageing"}, 600).bytes, 0);
    EXPECT_GE(cost_of({"interlocking"}, {}).bytes, 3 * 8 * 48 * 48);
    EXPECT_EQ(cost_of({"interlocking"}, {}).transforms, 0);
  }
}

TEST_F(EffectsCounted, AnEstimateChangesNoBitAndShowsWhatItCost) {
  for (const Bench& bench : benches) {
    const Counted bare = count(bare_scene(bench));
    for (const Effect& effect : effects) {
      if (!effect.of_the_accuracy) continue;
      SCOPED_TRACE(std::string(bench.name) + ": " + effect.name);
      const Counted estimated = count(with_effects(bare_scene(bench), {effect.name}));
      EXPECT_EQ(estimated.digest, bare.digest);
      EXPECT_EQ(estimated.transforms_of("elasticity"), bare.press.transforms);
      EXPECT_EQ(estimated.lines(), (Names{"elasticity", "estimate"}));
      EXPECT_GT(estimated.by_effect.back().second.bytes, 0);
      if (bench.elasticity.is<HalfSpaceOptions>()) {
        EXPECT_GT(estimated.transforms_of("estimate"), 0);
      }
    }
  }
}

}  // namespace
}  // namespace asperity::effects_counted_test
