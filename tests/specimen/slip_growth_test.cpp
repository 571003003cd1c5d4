// SPDX-License-Identifier: GPL-3.0-or-later
// Lateral effects on the bench: shear, growth of slip on a tilting stage, rest, slopes.
#include "engine/specimen/tilt_trials.hpp"

#include <cmath>
#include <numbers>

#include "engine/contact/effects/ageing.hpp"
#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::slip_growth_test {
namespace {

using test::error_of;
using test::random_surface;
using test::scene_of;

TiltTrialOptions light() {
  TiltTrialOptions options;
  options.stage.mass = 0.01;
  return options;
}

Scene boxes_on_rough(Effects effects) {
  Scene scene = scene_of(random_surface(40, 40, 1), random_surface(40, 40, 2), 3.0, Boundary::periodic);
  scene.effects = effects;
  return scene;
}

Scene half_space(Effects effects) {
  SelfAffineOptions options = test::self_affine(make_grid(64, 64, 250e-6, 250e-6), 0.8, 24e-6, 7);
  options.ra = 1e-6;
  Scene scene{self_affine_surface(options).with_material(named_material("Al-2011")), named_material("quartz"),
              Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  scene.effects = effects;
  return scene;
}

const Effects partial{TangentialOptions{2.0}};

// --- shear of a pair

TEST(SpecimenPairShear, NeedsALoadAndLeavesThePairAsItIs) {
  SpecimenPair pair(boxes_on_rough(partial));
  const std::string loose = "the contact carries no load, so nothing resists shear; press it first";
  const auto pull = [&] { return pair.shear({{}, 0.5, 0.3}); };
  EXPECT_EQ(error_of(pull), loose);
  const State st = pair.press({PressBy::pressure, 0.4, {}});
  const PartialSlip slip = pull();
  EXPECT_EQ(slip.normal().digest(), st.digest());
  EXPECT_GT(slip.slip_fraction(), 0);
  EXPECT_LT(slip.slip_fraction(), 1);
  EXPECT_TRUE(pair.under_load());
  EXPECT_EQ(pull().displacement(), slip.displacement());
  SpecimenPair copy = pair;
  EXPECT_EQ(copy.shear({{}, 0.5, 0.3}).displacement(), slip.displacement());
  pair.release();
  EXPECT_EQ(error_of(pull), loose);
  pair.press({PressBy::pressure, 0.4, {}});
  pair.place(3);
  EXPECT_EQ(error_of(pull), loose);
  pair.press({PressBy::load, 0, {}});
  EXPECT_EQ(error_of(pull), loose);
}

TEST(SpecimenPairShear, WithoutTheEffectNoStateIsKept) {
  SpecimenPair pair(boxes_on_rough({}));
  pair.press({PressBy::pressure, 0.4, {}});
  EXPECT_EQ(pair.pressed(), nullptr);
  EXPECT_NE(error_of([&] {
              pair.shear({{}, 0.5, 0.3});
            }).find("needs the effect `tangential`"),
            std::string::npos);
}

// --- growth of slip

TEST(SlipGrowth, GrowsToAllOfTheContactWhereTheSpecimenSlides) {
  for (const Scene& scene : {boxes_on_rough(partial), half_space({TangentialOptions{}})}) {
    const SpecimenPair pair(scene);
    const bool boxes = scene.elasticity.is<BoxOptions>();
    const JunctionLaw law({.tau0 = boxes ? 0.02 : 5e8, .alpha = 0.2});
    const TiltResult raised = raise(pair, law, light());
    const std::vector<SlipShare> growth = slip_growth(pair, law, light(), 6);
    ASSERT_EQ(growth.size(), 6U);
    double before = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      const SlipShare& at = growth[k];
      EXPECT_DOUBLE_EQ(at.angle, raised.trials[0].angle * static_cast<double>(k + 1) / 6);
      EXPECT_GT(at.slip_fraction, before);
      EXPECT_EQ(at.displacement.has_value(), boxes);
      before = at.slip_fraction;
    }
    EXPECT_LT(growth[4].ratio, 1);
    EXPECT_EQ(growth[5].ratio, 1);
    EXPECT_EQ(growth[5].slip_fraction, 1);
  }
}

// With alpha alone, pull over sliding force is tan θ / α; shares follow the remaining load.
TEST(SlipGrowth, IsThatOfAContactAtTheLoadOfTheAngle) {
  Scene scene = test::boxes(random_surface(40, 40, 1), 3.0);
  scene.effects = partial;
  SpecimenPair pair(scene);
  const std::vector<SlipShare> growth = slip_growth(pair, JunctionLaw({.tau0 = 0, .alpha = 0.5}), light(), 4);
  for (const SlipShare& at : growth) {
    EXPECT_NEAR(at.ratio, std::tan(at.angle) / 0.5, 1e-12);
    pair.press({PressBy::load, 0.01 * 9.81 * std::cos(at.angle), {}});
    const PartialSlip slip = pair.shear({{}, at.ratio, 0.5});
    EXPECT_EQ(at.slip_fraction, slip.slip_fraction());
    EXPECT_NEAR(*at.displacement, slip.displacement(), 1e-12 * slip.displacement());
  }
}

TEST(SlipGrowth, WithoutFrictionAllSlipsAtOnce) {
  const std::vector<SlipShare> growth =
      slip_growth(SpecimenPair(boxes_on_rough(partial)), JunctionLaw({.tau0 = 0, .alpha = 0}), light(), 2);
  for (const SlipShare& at : growth) EXPECT_EQ(at.slip_fraction, 1);
}

TEST(SlipGrowth, NeedsItsEffectAndSteps) {
  const JunctionLaw law({.tau0 = 0.1, .alpha = 0.2});
  EXPECT_NE(error_of([&] {
              slip_growth(SpecimenPair(boxes_on_rough({})), law, light(), 5);
            }).find("needs the effect `tangential`"),
            std::string::npos);
  EXPECT_EQ(error_of([&] { slip_growth(SpecimenPair(boxes_on_rough(partial)), law, light(), 0); }),
            "`steps` is 0; give a whole number from 1 to 10000");
}

// --- rest

TEST(TiltRest, RaisesTheAngleByWhatTau0Grew) {
  const double rate = 0.1, rest = 600;
  const JunctionLaw law({.tau0 = 0.02, .alpha = 0.2}),
      stronger({.tau0 = 0.02 * (1 + rate * std::log1p(rest / 2)), .alpha = 0.2});
  TiltTrialOptions rested = light();
  rested.rest = rest;
  const SpecimenPair ageing(boxes_on_rough({AgeingOptions{rate, 2}})), plain(boxes_on_rough({}));
  const TiltResult after = raise(ageing, law, rested);
  EXPECT_EQ(after.angle, raise(plain, stronger, light()).angle);
  EXPECT_GT(after.angle, raise(plain, law, light()).angle);
  EXPECT_NE(after.note.find("at rest for 600 s, tau0 grew by a factor of 1.57071"), std::string::npos)
      << after.note;
  EXPECT_EQ(raise(ageing, law, light()).angle, raise(plain, law, light()).angle);
}

TEST(TiltRest, AnEffectOfRateZeroChangesNoBit) {
  TiltTrialOptions rested = light();
  rested.rest = 1e9;
  const JunctionLaw law({.tau0 = 0.02, .alpha = 0.2, .tau_max = 0.5});
  const TiltResult with = raise(SpecimenPair(boxes_on_rough({AgeingOptions{0, 1}})), law, rested);
  const TiltResult without = raise(SpecimenPair(boxes_on_rough({})), law, light());
  EXPECT_EQ(with.angle, without.angle);
  EXPECT_EQ(with.spread, without.spread);
}

TEST(TiltRest, ARestWithoutAgeingIsRefused) {
  TiltTrialOptions rested = light();
  rested.rest = 60;
  const JunctionLaw law({.tau0 = 0.02, .alpha = 0.2});
  EXPECT_EQ(error_of([&] { raise(SpecimenPair(boxes_on_rough({})), law, rested); }),
            "`rest` needs the effect `ageing`, which this scene does not name; name ageing={ rate=, onset= } "
            "in the effects of the contact, or leave `rest` out");
  rested.rest = -1;
  EXPECT_EQ(error_of([&] {
              raise(SpecimenPair(boxes_on_rough({AgeingOptions{0.1, 1}})), law, rested);
            }),
            "`rest` is -1 s; give a time from zero up");
}

// --- slopes

TEST(TiltInterlocking, AnInclineThatFitsSlipsAtItsAngleAndThatOfFriction) {
  const double slope = 0.3;
  const Grid grid{24, 10, 2.4, 0.5};
  const auto incline = [&](double sign) {
    return test::surface_of(grid, [=](int i, int) { return sign * slope * 0.1 * i; });
  };
  // Turned over, the upper body fits.
  Scene scene = scene_of(incline(1), incline(1), 1.0);
  scene.effects.set(InterlockingOptions{});
  // Free placements turn by 0 or 180 deg; only one of these fits.
  const SpecimenPair pair(scene);
  const JunctionLaw law({.tau0 = 0, .alpha = 0.2});
  const State st = SpecimenPair(pair).press({PressBy::pressure, 0.1, {}});
  EXPECT_NEAR(*law.on(st).mu, (0.2 + slope) / (1 - 0.2 * slope), 1e-12);
  TiltTrialOptions options = light();
  options.repeats = 20;
  const TiltResult t = raise(pair, law, options);
  int fits = 0;
  for (const SlipAngle& trial : t.trials)
    fits += std::abs(trial.angle - (std::atan(0.2) + std::atan(slope))) < 1e-9 ? 1 : 0;
  EXPECT_GT(fits, 0);
}

// Sliding at the first step is no error of the stage.
TEST(TiltInterlocking, ASlopeThatPushesSlipsAtOnce) {
  const Grid grid{24, 10, 2.4, 0.5};
  const auto incline = test::surface_of(grid, [](int i, int) { return 0.03 * i; });
  Scene scene = scene_of(incline, incline, 1.0);
  scene.effects.set(InterlockingOptions{std::numbers::pi});
  TiltTrialOptions options = light();
  options.repeats = 20;
  const TiltResult t = raise(SpecimenPair(scene), JunctionLaw({.tau0 = 0, .alpha = 0.1}), options);
  int at_once = 0;
  for (const SlipAngle& trial : t.trials) at_once += trial.slipped && trial.angle < 1e-12 ? 1 : 0;
  EXPECT_GT(at_once, 0);
}

TEST(TiltInterlocking, ProbesOfAHalfSpaceTakeItIn) {
  Scene scene = half_space({});
  scene.upper = scene.lower.with_material(named_material("quartz"));
  const JunctionLaw law({.tau0 = 5e8, .alpha = 0.2});
  const TiltResult plain = raise(SpecimenPair(scene), law, light());
  scene.effects.set(InterlockingOptions{});
  const TiltResult with = raise(SpecimenPair(scene), law, light());
  ASSERT_EQ(plain.probes.size(), with.probes.size());
  for (std::size_t k = 0; k < plain.probes.size(); ++k) {
    EXPECT_NE(plain.probes[k].mu, with.probes[k].mu);
    EXPECT_EQ(plain.probes[k].area_per_load, with.probes[k].area_per_load);
  }
}

}  // namespace
}  // namespace asperity::slip_growth_test
