// SPDX-License-Identifier: GPL-3.0-or-later
// Limits reported by a state: few nodes in contact, the rim of a free tile.
#include "engine/contact/state.hpp"

#include <gtest/gtest.h>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::state_limits_test {
namespace {

constexpr double radius = 1e-2;

Scene ball(int cells, double size, Boundary boundary = Boundary::free) {
  return {sphere_surface({Grid{cells, cells, size, size}, radius, SphereShape::paraboloid})
              .with_material(test::elastic(2e11, 0.3)),
          rigid_material(), boundary, HalfSpaceOptions{}, Accuracy{}};
}

std::string limits_of(const State& state) {
  std::string text;
  for (const std::string& limit : state_limits(state)) text += limit + "\n";
  return text;
}

const std::string at_the_rim =
    "the contact reaches the rim of the free tile, where the bodies end; press less, or give a larger tile\n";

TEST(StateLimits, AContactOnFewNodesIsReportedWithTheirNumber) {
  const State one = test::press(ball(128, 1e-3), PressBy::load, 1e-6);
  ASSERT_EQ(one.contacts(), 1);
  EXPECT_EQ(limits_of(one),
            "only 1 node touches, so the result depends on the cells: press harder, or take finer cells on a "
            "smaller tile\n");
  const State more = test::press(ball(128, 1e-3), PressBy::load, 0.1);
  ASSERT_GT(more.contacts(), 1);
  ASSERT_LT(more.contacts(), 30);
  EXPECT_EQ(limits_of(more).find("only " + std::to_string(more.contacts()) + " nodes touch"), 0U);
  const State enough = test::press(ball(128, 1e-3), PressBy::load, 3);
  ASSERT_GE(enough.contacts(), 30);
  EXPECT_EQ(limits_of(enough), "");
  EXPECT_EQ(limits_of(test::press(ball(128, 1e-3), PressBy::load, 0)), "");
}

TEST(StateLimits, OnFewNodesNoBoundOfTheSolverIsShown) {
  const std::string few = test::press(ball(128, 1e-3), PressBy::load, 1e-6).text();
  EXPECT_EQ(few.find("±"), std::string::npos) << few;
  const std::string enough = test::press(ball(128, 1e-3), PressBy::load, 3).text();
  EXPECT_NE(enough.find("±"), std::string::npos) << enough;
}

// Full contact, or independent boxes.
TEST(StateLimits, FewNodesAreEnoughWhereAllTouchOrEachStandsAlone) {
  Scene small = ball(4, 1e-5, Boundary::periodic);
  const State all = test::press(small, PressBy::pressure, 1e10);
  ASSERT_EQ(all.contacts(), 16);
  EXPECT_EQ(limits_of(all), "");
  const State box = test::press(test::boxes(test::random_surface(16, 16, 1), 1e9), PressBy::flatten, 0.1);
  ASSERT_LT(box.contacts(), 30);
  EXPECT_EQ(limits_of(box).find("only"), std::string::npos);
}

TEST(StateLimits, AContactAtTheRimOfAFreeTileIsReported) {
  const State cut = test::press(ball(64, 2e-5), PressBy::load, 0.12);
  ASSERT_EQ(cut.area_fraction(), 1);
  EXPECT_EQ(limits_of(cut), at_the_rim);
  Scene tilted = ball(32, 2e-5);
  tilted.lower = test::surface_of(tilted.lower.grid(), [](int i, int) {
                   return i == 0 ? 1e-9 : 0.0;
                 }).with_material(test::elastic(2e11, 0.3));
  const State edge = test::press(tilted, PressBy::load, 1e-6);
  ASSERT_EQ(edge.contacts(), 32);
  EXPECT_EQ(limits_of(edge), at_the_rim);
}

TEST(StateLimits, ARimIsNoneOfPeriodicTilesOfFlatsAndOfContactsWithinIt) {
  EXPECT_EQ(limits_of(test::press(ball(64, 2e-5, Boundary::periodic), PressBy::load, 0.12)), "");
  EXPECT_EQ(limits_of(test::press(ball(64, 1e-4), PressBy::load, 0.12)), "");
  Scene punch = ball(16, 1e-3);
  punch.lower = test::surface_of(punch.lower.grid(), [](int, int) {
                  return 0.0;
                }).with_material(test::elastic(2e11, 0.3));
  EXPECT_EQ(limits_of(test::press(punch, PressBy::load, 1)), "");
}

TEST(StateLimits, AnAttractionThatReachesTheRimIsReported) {
  const auto pulled = [](double range) {
    Scene scene{
        sphere_surface({Grid{32, 32, 1, 1}, 1, SphereShape::paraboloid}).with_material(test::elastic(1)),
        rigid_material(), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
    scene.effects.set(AdhesionOptions{.work = 0.003, .range = range});
    return limits_of(test::press(scene, PressBy::approach, 0.01));
  };
  EXPECT_NE(pulled(0.2).find("`adhesion` reaches the rim of the free tile"), std::string::npos)
      << pulled(0.2);
  EXPECT_EQ(pulled(0.01).find("the rim"), std::string::npos) << pulled(0.01);
}

}  // namespace
}  // namespace asperity::state_limits_test
