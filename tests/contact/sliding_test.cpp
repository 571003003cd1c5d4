// SPDX-License-Identifier: GPL-3.0-or-later
// The effects of lateral loading; presses ignore them.
#include "engine/contact/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/effects/ageing.hpp"
#include "engine/contact/effects/interlocking.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::sliding_test {
namespace {

using test::elastic;
using test::error_of;
using test::random_surface;
using test::ready;
using test::scene_of;

constexpr double infinite = std::numeric_limits<double>::infinity();

Scene two_rough(Effects effects) {
  Scene scene{random_surface(32, 32, 1).with_material(elastic(1)),
              random_surface(32, 32, 2).with_material(elastic(1)), Boundary::periodic, HalfSpaceOptions{},
              Accuracy{}};
  scene.effects = effects;
  return scene;
}

Plan plan_of(const Scene& scene) {
  return make_plan(scene,
                   ContactGeometry(scene, LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny)));
}

TEST(Ageing, GrowsWithTheLogarithmOfTheRest) {
  const AgeingOptions ageing{0.02, 1};
  EXPECT_EQ(strengthening(ageing, {}), 1);
  EXPECT_EQ(strengthening(ageing, 0.0), 1);
  EXPECT_DOUBLE_EQ(strengthening(ageing, std::exp(1.0) - 1), 1.02);
  EXPECT_DOUBLE_EQ(strengthening(ageing, 600.0), 1 + 0.02 * std::log(601.0));
  EXPECT_NEAR(strengthening(ageing, 1e9) - strengthening(ageing, 1e8), 0.02 * std::log(10), 1e-9);
  EXPECT_EQ(strengthening({0, 1}, 1e300), 1);
  EXPECT_TRUE(std::isfinite(strengthening(ageing, 1e300)));
}

TEST(Sliding, PressesKnowNothingOfIt) {
  const Scene all = two_rough({InterlockingOptions{1.0}, AgeingOptions{0.1, 2}, TangentialOptions{}});
  const State with = test::press(all, PressBy::pressure, 0.2);
  const State without = test::press(two_rough({}), PressBy::pressure, 0.2);
  EXPECT_EQ(with.digest(), without.digest());
  EXPECT_NEAR(with.cost().total.transforms, without.cost().total.transforms, 1e-9);
  EXPECT_EQ(with.cost().total.bytes, without.cost().total.bytes);
  ASSERT_EQ(with.cost().by_effect.size(), 1U);
  EXPECT_EQ(with.effects().find<InterlockingOptions>()->direction, 1.0);
  EXPECT_EQ(with.effects().find<AgeingOptions>()->onset, 2);
  EXPECT_FALSE(without.effects().find<InterlockingOptions>() || without.effects().find<AgeingOptions>() ||
               without.effects().find<TangentialOptions>());
}

TEST(Sliding, APlanListsWhatIsNamedAndPlansNothingForIt) {
  const Plan none = plan_of(two_rough({}));
  const Plan all = plan_of(two_rough({InterlockingOptions{}, AgeingOptions{0.02, 60}, TangentialOptions{}}));
  EXPECT_EQ(all.effects_run,
            (std::vector<std::string>{"elasticity", "ageing", "interlocking", "tangential"}));
  for (const char* effect : {"ageing", "interlocking", "tangential"}) {
    EXPECT_EQ(std::count(none.effects_off.begin(), none.effects_off.end(), effect), 1);
    EXPECT_EQ(std::count(all.effects_off.begin(), all.effects_off.end(), effect), 0);
  }
  EXPECT_EQ(all.bytes_peak(), none.bytes_peak());
  EXPECT_EQ(all.transforms, none.transforms);
  EXPECT_EQ(all.seconds, none.seconds);
  const std::string text = all.text();
  EXPECT_NE(text.find("  ageing        tau0 grows with rest, rate 0.02 from 60 s\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("  interlocking  slopes of the contact towards 0 deg from x add"), std::string::npos);
  EXPECT_NE(text.find("  tangential    sideways the bodies give way 1 times as much as normally\n"),
            std::string::npos);
}

TEST(Sliding, ShearThatMovesUnlikeBodiesNormallyIsTold) {
  Scene scene = two_rough({TangentialOptions{}});
  scene.upper = rigid_material();
  EXPECT_NE(
      plan_of(scene).text().find("; Dundurs' beta is 0.5: the coupling of shear and pressure is neglected"),
      std::string::npos);
}

TEST(Sliding, OptionsOutOfRangeAreNamed) {
  const auto asked = [](Effects effects) { return error_of([&] { check(two_rough(effects)); }); };
  EXPECT_EQ(asked({InterlockingOptions{infinite}}),
            "`direction` of the effect `interlocking` is inf rad; give a finite angle, e.g. \"37 deg\"");
  EXPECT_EQ(asked({AgeingOptions{-1, 1}}), "`rate` of the effect `ageing` is -1; give a number at least 0");
  EXPECT_EQ(asked({AgeingOptions{0.1, 0}}),
            "`onset` of the effect `ageing` is 0 s; give a time above 0, e.g. \"10 min\"");
  EXPECT_EQ(asked({TangentialOptions{0.0}}),
            "`compliance_ratio` of the effect `tangential` is 0; give a number above 0");
  EXPECT_EQ(asked({InterlockingOptions{}, AgeingOptions{0, 1}, TangentialOptions{1e-300}}), "");
}

TEST(Sliding, WhatAnEffectNeedsIsNamed) {
  Scene flat = two_rough({InterlockingOptions{}});
  flat.upper = rigid_material();
  EXPECT_EQ(error_of([&] { plan_of(flat); }),
            "the effect `interlocking` needs two rough bodies, and the upper body is flat; give a surface "
            "as `upper`, or leave the effect out");
  Scene boxes = test::boxes(random_surface(8, 8, 1), 1);
  boxes.effects.set(TangentialOptions{});
  EXPECT_NE(error_of([&] { plan_of(boxes); }).find("the effect `tangential` needs `compliance_ratio`"),
            std::string::npos);
  boxes.effects.find<TangentialOptions>()->compliance_ratio = 2;
  EXPECT_EQ(error_of([&] { plan_of(boxes); }), "");
  Scene plastic = two_rough({TangentialOptions{}});
  plastic.effects.set(PlasticityOptions{1.0, infinite});
  EXPECT_NE(error_of([&] { check(plastic); }).find("`tangential` needs an elastic contact"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::sliding_test
