// SPDX-License-Identifier: GPL-3.0-or-later
// The precision of the steps where an error is asked for: what the rule says, that solves bear it out by
// their counts, and that a choice keeps to it.
#include "engine/accuracy/precision_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "engine/accuracy/accuracy_choice.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"

namespace asperity::precision_choice_test {
namespace {

using Precision = Accuracy::Precision;

Surface rough(int nx, int ny, std::uint64_t seed = 1) {
  SelfAffineOptions o;
  o.grid = Grid{nx, ny, 1, 1};
  o.hurst = 0.8;
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  o.short_wave = 1.0 / 8;
  o.seed = seed;
  Material material;
  material.young = 1e9;
  material.poisson = 0;
  return self_affine_surface(o).with_material(material);
}

Scene half_space(Surface lower, Boundary boundary = Boundary::periodic) {
  return {std::move(lower), rigid_material(), boundary, HalfSpaceOptions{}, Accuracy{}};
}

TEST(PrecisionChoice, IsDouble) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const PrecisionChoice choice =
        choose_precision(half_space(rough(16, 16), boundary), Grid{1024, 1024, 1, 1});
    EXPECT_EQ(choice.precision, Precision::double_);
    EXPECT_EQ(choice.why, "single saves no time");
  }
}

TEST(PrecisionChoice, WhatIsNamedStays) {
  Scene scene = half_space(rough(16, 16));
  scene.accuracy.precision_named = true;
  EXPECT_EQ(choose_precision(scene, Grid{4096, 4096, 1, 1}).precision, Precision::double_);
  EXPECT_EQ(choose_precision(scene, Grid{4096, 4096, 1, 1}).why, "as named");
  scene.accuracy.precision = Precision::single;
  EXPECT_EQ(choose_precision(scene, Grid{16, 16, 1, 1}).precision, Precision::single);
  scene.accuracy.precision_named = false;
  EXPECT_EQ(choose_precision(scene, Grid{16, 16, 1, 1}).precision, Precision::double_);
}

TEST(PrecisionChoice, SomeCellsAndBoxesHaveNoOther) {
  const Scene periodic = half_space(rough(16, 16)), free = half_space(rough(16, 16), Boundary::free);
  for (const int nx : {1111, 2222}) {
    EXPECT_EQ(choose_precision(periodic, Grid{nx, 2048, 1, 1}).precision, Precision::double_);
    EXPECT_EQ(choose_precision(periodic, Grid{nx, 2048, 1, 1}).why, "there is no other on cells like these");
    EXPECT_EQ(choose_precision(free, Grid{nx, 2048, 1, 1}).why, "single saves no time");
  }
  Scene boxes = periodic;
  boxes.elasticity = BoxOptions{1e12};
  EXPECT_EQ(choose_precision(boxes, Grid{2048, 2048, 1, 1}).precision, Precision::double_);
  EXPECT_EQ(choose_precision(boxes, Grid{2048, 2048, 1, 1}).why, "boxes are solved in no other");
}

// What the choice rests on: single precision saves no step, and costs none.
TEST(PrecisionChoice, EitherTakesAsManySteps) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const std::uint64_t seed : {1, 2, 3})
      for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        const auto transforms = [&](Precision precision) {
          Scene scene = half_space(rough(128, 128, seed), boundary);
          scene.accuracy.precision = precision;
          scene.accuracy.tolerance = tolerance;
          return SpecimenPair(scene).press({PressBy::pressure, 1e7, {}}).cost().total.transforms;
        };
        EXPECT_NEAR(transforms(Precision::single) / transforms(Precision::double_), 1, 0.05)
            << seed << " " << tolerance;
      }
}

State chosen_press(Surface surface, std::optional<Precision> named) {
  Scene scene = half_space(std::move(surface));
  scene.accuracy.asked = AskedError{0.1, {"corrected_area_fraction"}};
  scene.accuracy.precision_named = named.has_value();
  scene.accuracy.precision = named.value_or(Precision::double_);
  SpecimenPair pair(scene);
  EXPECT_NE(pair.plan().text().find(named ? "chooses cells and tolerance for"
                                          : "chooses cells, tolerance and precision for"),
            std::string::npos);
  State state = pair.press({PressBy::pressure, 2e7, {}});
  EXPECT_EQ(pair.plan().accuracy.precision, state.chosen()->precision);
  const bool single = state.chosen()->precision == Precision::single;
  EXPECT_EQ(state.solver().find(" in single precision") != std::string_view::npos, single);
  return state;
}

TEST(PrecisionChoice, IsPartOfTheChoice) {
  const std::string chosen = chosen_press(rough(64, 64), {}).chosen()->text();
  EXPECT_NE(chosen.find(", double precision (single saves no time): "), std::string::npos) << chosen;
  const std::string named = chosen_press(rough(64, 63), Precision::single).chosen()->text();
  EXPECT_NE(named.find(", single precision (as named): "), std::string::npos) << named;
}

}  // namespace
}  // namespace asperity::precision_choice_test
