// SPDX-License-Identifier: GPL-3.0-or-later
// Expected transforms of a press, for each control, on small tiles (tried on all cells) and larger ones.
// Accuracy: tests/stability/properties/explain.cpp.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/core/cost.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::expected_transforms_test {
namespace {

using test::elastic;
using test::error_of;
using test::row_of;
using test::scene_of;

constexpr PressBy controls[] = {PressBy::pressure, PressBy::load, PressBy::approach, PressBy::indentation,
                                PressBy::flatten};

Scene rough(int nx, int ny, Boundary boundary = Boundary::periodic) {
  SelfAffineOptions o = test::self_affine(Grid{nx, ny, 1.0 * nx, 1.0 * ny}, 0.8, 8);
  o.rms_slope = 0.1;
  return {self_affine_surface(o).with_material(elastic(1e9)), rigid_material(), boundary, HalfSpaceOptions{},
          Accuracy{}};
}

struct Contact {
  explicit Contact(const Scene& of)
      : scene(of),
        geometry(scene, LatticeIsometry(of.lower.grid().nx, of.lower.grid().ny)),
        plan(make_plan(scene, geometry)) {}
  Plan plan_of(PressBy by, double value) const {
    return plan_of_press(scene, geometry, plan, {by, value, {}});
  }
  Scene scene;
  ContactGeometry geometry;
  Plan plan;
};

// The values of each control for the same state.
double value_of(const State& state, PressBy by) {
  switch (by) {
    case PressBy::pressure:
      return state.pressure();
    case PressBy::load:
      return state.load();
    case PressBy::approach:
      return state.approach();
    case PressBy::indentation:
      return state.indentation();
    case PressBy::flatten:
      return state.flatten();
  }
  return 0;
}

double taken_by(const Scene& scene, PressBy by, double value) {
  return test::press(scene, by, value).cost().total.transforms;
}

TEST(ExpectedTransforms, OfAPressThatIsTriedOnAllCellsAreThoseOfThePress) {
  for (const auto& [nx, ny] : {std::pair{48, 40}, {128, 128}})
    for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
      const Contact contact(rough(nx, ny, boundary));
      const State state = test::press(contact.scene, PressBy::pressure, 2e7);
      for (const PressBy by : controls) {
        const double value = value_of(state, by);
        EXPECT_EQ(contact.plan_of(by, value).transforms, taken_by(contact.scene, by, value)) << name(by);
      }
    }
}

// By flattening, the transforms of like presses on a free boundary differ up to fourfold.
TEST(ExpectedTransforms, OfFewerCellsAreWithinAFactorOfTwoInNineOfTen) {
  int presses = 0, within_two = 0;
  for (const auto& [nx, ny] : {std::pair{256, 192}, {251, 149}, {1024, 24}})
    for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
      const Contact contact(rough(nx, ny, boundary));
      const State state = test::press(contact.scene, PressBy::pressure, 1e7);
      for (const PressBy by : controls) {
        const double value = value_of(state, by);
        const double ratio = contact.plan_of(by, value).transforms / taken_by(contact.scene, by, value);
        const bool within = ratio > 0.5 && ratio < 2;
        EXPECT_TRUE(within || by == PressBy::flatten) << name(by) << " " << nx << " " << ratio;
        ++presses;
        within_two += within ? 1 : 0;
      }
    }
  EXPECT_GE(within_two, 0.9 * presses);
}

// A trial that fails costs transforms too.
TEST(ExpectedTransforms, ThatAreTriedAreNotCounted) {
  const Contact contact(rough(40, 40));
  const double before = cost::transforms();
  for (const double approach : {1e-2, 1e6}) contact.plan_of(PressBy::approach, approach);
  EXPECT_EQ(cost::transforms(), before);
}

// The closing load of a step is proportional to 1/cell.
TEST(ExpectedTransforms, NearFullContactAreNotThoseOfFullContact) {
  Scene scene = rough(192, 192);
  Field steps = scene.lower.heights();
  for (int j = 0; j < 192; ++j)
    for (int i = 0; i < 192; ++i) steps(i, j) = i < 100 ? 1 : 0;
  SurfaceTraits traits;
  traits.material = elastic(1e9);
  traits.periodic = true;
  scene.lower = Surface(scene.lower.grid(), std::move(steps), traits);
  // Closing loads: 2.7e8 Pa on 128² cells, 4e8 Pa on these.
  const double pressure = 2.4e8;
  const double expected = Contact(scene).plan_of(PressBy::pressure, pressure).transforms;
  const double taken = taken_by(scene, PressBy::pressure, pressure);
  EXPECT_LT(expected, 2 * taken);
  EXPECT_GT(expected, 0.5 * taken);
}

// By flattening, the memory includes the load search.
TEST(PlanOfAPress, NamesTheControl) {
  const Contact contact(rough(128, 128));
  EXPECT_NE(contact.plan.text().find("  transforms    40 expected of a press by `pressure`, a rough guess; "),
            std::string::npos)
      << contact.plan.text();
  for (const PressBy by : {PressBy::pressure, PressBy::approach, PressBy::flatten}) {
    const Plan plan = contact.plan_of(by, by == PressBy::pressure ? 1e7 : 0.2);
    EXPECT_NE(plan.text().find(" expected of the press by `" + std::string(name(by)) +
                               "`, from a trial on all 128 x 128 cells that took "),
              std::string::npos)
        << plan.text();
    EXPECT_NEAR(plan.seconds / plan.transforms, contact.plan.seconds / contact.plan.transforms, 1e-12);
    EXPECT_EQ(plan.bytes_peak() - contact.plan.bytes_peak(),
              by == PressBy::flatten ? contact.plan.bytes_to_flatten : 0);
  }
  EXPECT_GT(contact.plan.bytes_to_flatten, 0);
}

// The cost of a trial on fewer cells is a small part of the press.
TEST(PlanOfAPress, SaysTheCostOfItsTrial) {
  const Plan plan = Contact(rough(512, 256)).plan_of(PressBy::approach, 1);
  const std::string trial = ", from a trial on 180 x 88 cells that took ";
  const auto at = plan.press.find(trial);
  ASSERT_NE(at, std::string::npos) << plan.press;
  const double took = std::stod(plan.press.substr(at + trial.size()));
  EXPECT_GT(took, 0.03 * plan.transforms);
  EXPECT_LT(took, 0.15 * plan.transforms);
}

TEST(PlanOfAPress, CountsWhatAnEstimateAdds) {
  Scene scene = rough(64, 64);
  const double alone = Contact(scene).plan_of(PressBy::pressure, 1e7).transforms;
  scene.accuracy.estimate = Accuracy::Estimate::finer;
  const double finer = Contact(scene).plan_of(PressBy::pressure, 1e7).transforms;
  EXPECT_NEAR(finer / alone, 1 + estimate_work(Contact(scene).geometry, scene.accuracy), 1e-12);
  EXPECT_GT(finer, 9 * alone);
}

TEST(PlanOfAPress, OfBoxElementsTakesNoTransforms) {
  const Contact contact(scene_of(row_of({0, 1, 3, 8}).with_material(elastic(16)), rigid_material()));
  const Plan plan = contact.plan_of(PressBy::approach, 1);
  EXPECT_EQ(plan.transforms, 0);
  EXPECT_NE(plan.text().find("  transforms    0 expected of the press by `approach`\n"), std::string::npos);
}

TEST(PlanOfAPress, RefusesWhatAPressRefuses) {
  const Contact contact(rough(40, 40));
  EXPECT_EQ(error_of([&] { contact.plan_of(PressBy::pressure, -1); }),
            error_of([&] { test::press(contact.scene, PressBy::pressure, -1); }));
  EXPECT_NE(error_of([&] { contact.plan_of(PressBy::flatten, 2); }).find("`flatten` is 2"),
            std::string::npos);
  // Only the solve finds the limit: the plan contains the guess.
  const Plan plan = contact.plan_of(PressBy::approach, 1e6);
  EXPECT_EQ(plan.transforms, contact.plan.transforms);
  EXPECT_NE(plan.text().find("cannot be reached"), std::string::npos) << plan.text();
}

}  // namespace
}  // namespace asperity::expected_transforms_test
