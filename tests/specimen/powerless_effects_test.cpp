// SPDX-License-Identifier: GPL-3.0-or-later
// An effect of zero strength changes no bit, but appears in plan, effects and cost. A limit beyond all
// pressures changes results within the tolerance only. Every such effect needs a row of `powerless`.
#include <functional>
#include <optional>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/effects/ageing.hpp"
#include "engine/contact/effects/capillarity.hpp"
#include "engine/contact/effects/creep.hpp"
#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "tests/specimen/counted_scenes.hpp"

namespace asperity::powerless_effects_test {
namespace {

using namespace counted_scenes;
using PowerlessEffects = OnOneThread;

struct Powerless {
  const char* name;
  std::function<void(Scene&)> without, with;  // common part; added effect
  std::optional<double> dwell{};
  const char* term;            // in the plan
  const char* line = nullptr;  // in the cost
};

const std::vector<Powerless> powerless = {
    {.name = "plasticity of infinite hardness",
     .without = [](Scene&) {},
     .with = [](Scene& s) { s.effects.set(PlasticityOptions{never}); },
     .term = "plasticity",
     .line = "plasticity"},
    {.name = "plasticity of infinite hardness that hardens",
     .without = [](Scene&) {},
     .with =
         [](Scene& s) {
           s.effects.set(PlasticityOptions{never, 1.0});
         },
     .term = "plasticity",
     .line = "plasticity"},
    {.name = "infinite hardening",
     .without = [](Scene& s) { s.effects.set(PlasticityOptions{hardness}); },
     .with =
         [](Scene& s) {
           s.effects.set(PlasticityOptions{hardness, never});
         },
     .term = "plasticity",
     .line = "plasticity"},
    {.name = "creep of rate zero",
     .without = [](Scene& s) { s.effects.set(PlasticityOptions{hardness}); },
     .with =
         [](Scene& s) {
           s.effects.set(CreepOptions{0, 1, 600});
         },
     .dwell = 86400,
     .term = "creep"},
    {.name = "creep of infinite hardness",
     .without = [](Scene& s) { s.effects.set(PlasticityOptions{never}); },
     .with = [](Scene& s) { s.effects.set(CreepOptions{}); },
     .dwell = 86400,
     .term = "creep"},
    {.name = "ageing of rate zero",
     .without = [](Scene&) {},
     .with =
         [](Scene& s) {
           s.effects.set(AgeingOptions{0, 1});
         },
     .term = "ageing"},
    {.name = "interlocking that nobody asks friction of",
     .without = [](Scene&) {},
     .with = [](Scene& s) { s.effects.set(InterlockingOptions{}); },
     .term = "interlocking"},
    {.name = "adhesion of work zero",
     .without = [](Scene&) {},
     .with =
         [](Scene& s) {
           s.effects.set(AdhesionOptions{0, 0.01});
         },
     .term = "adhesion",
     .line = "adhesion"},
    {.name = "capillarity of pressure zero",
     .without = [](Scene&) {},
     .with = [](Scene& s) { s.effects.set(CapillarityOptions{.pressure = 0.0}); },
     .term = "capillarity",
     .line = "capillarity"},
    {.name = "capillarity in dry air, and adhesion of work zero, of bodies that yield",
     .without = [](Scene& s) { s.effects.set(PlasticityOptions{hardness}); },
     .with =
         [](Scene& s) {
           s.effects.set(CapillarityOptions{.humidity = 0.0});
           s.effects.set(AdhesionOptions{0, 0.01});
         },
     .term = "capillarity",
     .line = "capillarity"},
    {.name = "tangential that nobody pulls",
     .without = [](Scene&) {},
     .with = [](Scene& s) { s.effects.set(TangentialOptions{1.2}); },
     .term = "tangential"},
};

TEST_F(PowerlessEffects, OfNoStrengthAnEffectChangesNoBitAndIsShown) {
  for (const Bench& bench : benches) {
    for (const Powerless& row : powerless) {
      SCOPED_TRACE(std::string(bench.name) + ": " + row.name);
      Scene without = bare_scene(bench);
      row.without(without);
      Scene with = without;
      row.with(with);
      SpecimenPair one(without), other(with);
      const PressRequest request{PressBy::pressure, pressed, row.dwell};
      const State a = one.press(request), b = other.press(request);
      EXPECT_EQ(a.digest(), b.digest());
      EXPECT_EQ(a.cost().total.transforms, b.cost().total.transforms);
      EXPECT_EQ(a.energy(), b.energy());
      EXPECT_EQ(a.mean_gap(), b.mean_gap());
      EXPECT_EQ(a.stiffness(), b.stiffness());
      EXPECT_EQ(one.lower().digest(), other.lower().digest());
      EXPECT_EQ(one.upper().digest(), other.upper().digest());
      one.place(7);
      other.place(7);
      EXPECT_EQ(one.press(request).digest(), other.press(request).digest());

      const auto& terms = other.plan().terms;
      EXPECT_TRUE(
          std::any_of(terms.begin(), terms.end(), [&](const auto& t) { return t.effect == row.term; }));
      EXPECT_TRUE(holds(b.effects_run(), row.term));
      if (row.line != nullptr) {
        const auto& lines = b.cost().by_effect;
        EXPECT_TRUE(
            std::any_of(lines.begin(), lines.end(), [&](const auto& l) { return l.first == row.line; }));
      }
    }
  }
}

TEST_F(PowerlessEffects, ACapOutOfReachChangesNothingBeyondTheTolerance) {
  for (const Bench& bench : benches) {
    if (bench.elasticity.is<BoxOptions>()) continue;
    for (const double hardening : {never, 1.0}) {
      Scene capped = bare_scene(bench);
      capped.effects.set(PlasticityOptions{1e6, hardening});
      SpecimenPair one(bare_scene(bench)), other(capped);
      const State a = one.press({PressBy::pressure, pressed, {}}),
                  b = other.press({PressBy::pressure, pressed, {}});
      ASSERT_LT(a.peak_pressure(), 1e6);
      const double within = 10 * tolerance;
      EXPECT_NEAR(b.approach() / a.approach(), 1, within) << bench.name;
      EXPECT_NEAR(b.energy() / a.energy(), 1, within) << bench.name;
      EXPECT_NEAR(b.mean_gap() / a.mean_gap(), 1, within) << bench.name;
      EXPECT_EQ(b.contacts(), a.contacts()) << bench.name;
      EXPECT_EQ(b.plastic_volume(), 0) << bench.name;
      EXPECT_EQ(other.lower().digest(), one.lower().digest()) << bench.name;
      EXPECT_EQ(b.cost().by_effect.back().first, "plasticity") << bench.name;
    }
  }
}

// Level bodies have no slopes; rate zero means no growth.
TEST_F(PowerlessEffects, OfNoStrengthAnEffectLeavesFrictionAsItIs) {
  const JunctionLaw law({.tau0 = 0.013, .alpha = 0.21, .tau_max = 0.015});
  for (const Bench& bench : benches) {
    SCOPED_TRACE(bench.name);
    const Surface level =
        Surface(make_grid(24, 24, 1, 1), Field(24, 24)).with_material(test::elastic(1, 0.3));
    Scene plain{level, level, bench.boundary, bench.elasticity, Accuracy{tolerance}};
    Scene with = plain;
    with.effects.set(InterlockingOptions{});
    with.effects.set(AgeingOptions{0, 1});
    if (bench.elasticity.is<HalfSpaceOptions>() && bench.boundary == Boundary::free)
      continue;  // a punch has slopes at its rim
    SpecimenPair one(plain), other(with);
    const PressRequest request{PressBy::pressure, pressed, {}};
    const FrictionResult a = law.on(one.press(request)), b = law.on(other.press(request), 3600);
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.adhesive_force, b.adhesive_force);
    EXPECT_EQ(a.load_force, b.load_force);
    EXPECT_EQ(a.capped_fraction, b.capped_fraction);
    EXPECT_EQ(*b.interlocking_force, 0);
    EXPECT_EQ(*b.strengthening, 1);
  }
}

}  // namespace
}  // namespace asperity::powerless_effects_test
