// SPDX-License-Identifier: GPL-3.0-or-later
// The table of quantities: unique names, values, texts of errors.
#include "engine/contact/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::quantities_test {
namespace {

State pressed_ball(bool yields) {
  Scene scene{sphere_surface({Grid{32, 32, 1e-3, 1e-3}, 1e-2, SphereShape::paraboloid})
                  .with_material(test::elastic(1e9)),
              rigid_material(), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
  if (yields) scene.effects.set(PlasticityOptions{.hardness = 1e6});
  return test::press(scene, PressBy::load, 0.05);
}

TEST(StateQuantities, EachIsThereOnceAndIsFound) {
  std::set<std::string_view> names;
  for (const StateQuantity& quantity : state_quantities()) {
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
    EXPECT_EQ(find_quantity(quantity.name), &quantity);
    EXPECT_FALSE(quantity.sentence.empty()) << quantity.name;
    EXPECT_EQ(quantity.called.empty(), quantity.bound == nullptr && !quantity.cells) << quantity.name;
  }
  EXPECT_EQ(find_quantity("Approach"), nullptr);
  EXPECT_EQ(find_quantity(""), nullptr);
}

TEST(StateQuantities, ValuesAreThoseOfTheState) {
  const State state = pressed_ball(false);
  EXPECT_EQ(find_quantity("approach")->value(state), state.approach());
  EXPECT_EQ(find_quantity("nodes_in_contact")->value(state), static_cast<double>(state.contacts()));
  EXPECT_EQ(find_quantity("energy")->value(state), state.energy());
  for (const StateQuantity& quantity : state_quantities())
    if (quantity.effect.empty()) {
      EXPECT_TRUE(std::isfinite(quantity.of(state))) << quantity.name;
    }
}

TEST(StateQuantities, OnesOfAnEffectNeedIt) {
  const State elastic = pressed_ball(false), yielding = pressed_ball(true);
  int of_effects = 0;
  for (const StateQuantity& quantity : state_quantities()) {
    if (quantity.effect.empty()) continue;
    ++of_effects;
    EXPECT_THROW(quantity.of(elastic), Error) << quantity.name;
    EXPECT_FALSE(quantity.bound(elastic)) << quantity.name;
    EXPECT_GT(quantity.of(yielding), 0) << quantity.name;
    EXPECT_TRUE(quantity.bound(yielding)) << quantity.name;
  }
  EXPECT_EQ(of_effects, 2);
}

TEST(StateQuantities, BoundsAreThoseOfTheAlgebraicError) {
  const State state = pressed_ball(false);
  EXPECT_EQ(find_quantity("approach")->bound(state), state.algebraic_error().approach);
  EXPECT_EQ(find_quantity("area")->bound(state), state.algebraic_error().area);
  EXPECT_EQ(find_quantity("stiffness")->bound, nullptr);
}

TEST(StateQuantities, WhatALoadLacksByTheFirstTouchIsItsStiffness) {
  const State state = pressed_ball(false);
  const double rise = 1e-9;
  EXPECT_EQ(find_quantity("separation")->cells->lacks(state, rise), rise);
  EXPECT_EQ(find_quantity("pressure")->cells->lacks(state, rise), -state.stiffness() * rise);
  EXPECT_EQ(find_quantity("load")->cells->lacks(state, rise), -state.stiffness() * rise * 1e-6);
  EXPECT_EQ(find_quantity("energy")->cells->lacks(state, rise), -state.load() * rise);
  EXPECT_EQ(find_quantity("approach")->cells->lacks, nullptr);
}

TEST(StateQuantities, SentencesOfErrorsNameQuantityAndEffect) {
  EXPECT_EQ(bound_sentence(*find_quantity("approach")), "of the approach");
  EXPECT_EQ(estimate_sentence(*find_quantity("area_fraction")),
            "of the area fraction; most of it is its stepped outline");
  EXPECT_EQ(bound_sentence(*find_quantity("plastic_volume")), "of the plastic volume; needs plasticity");
}

}  // namespace
}  // namespace asperity::quantities_test
