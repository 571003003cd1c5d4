// SPDX-License-Identifier: GPL-3.0-or-later
// Expected transforms of a press, for each control, on small tiles (trial press) and large tiles. Accuracy:
// tests/stability/properties/explain.cpp.
#include "engine/accuracy/expected_transforms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/memory.hpp"
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
  ExpectedTransforms expected(PressBy by, double value, const TrialEffort& effort = {}) const {
    return expected_transforms(scene, geometry, plan, {by, value, {}}, effort);
  }
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

TEST(TrialGrid, KeepsShapeAndTakesNoMoreThanSomeNodes) {
  const auto cells = [](int nx, int ny) {
    const Grid grid = trial_grid(Grid{nx, ny, 3, 2}, 96 * 96);
    EXPECT_EQ(grid.size_x, 3);
    EXPECT_EQ(grid.size_y, 2);
    return std::pair{grid.nx, grid.ny};
  };
  EXPECT_EQ(cells(96, 96), std::pair(96, 96));
  EXPECT_EQ(cells(97, 96), std::pair(96, 92));
  EXPECT_EQ(cells(512, 512), std::pair(96, 96));
  EXPECT_EQ(cells(4096, 4096), std::pair(96, 96));
  EXPECT_EQ(cells(1024, 256), std::pair(192, 48));
  EXPECT_EQ(cells(9216, 1), std::pair(9216, 1));
  for (const auto& [nx, ny] : {std::pair{4096, 4}, {1 << 20, 1}, {3, 9999}, {20, 100000}, {997, 991}}) {
    const auto [fewer_x, fewer_y] = cells(nx, ny);
    EXPECT_LE(fewer_x * fewer_y, 96 * 96) << nx << " x " << ny;
    EXPECT_GE(fewer_x * fewer_y, 96 * 96 / 2) << nx << " x " << ny;
    EXPECT_GE(fewer_x, std::min(nx, 8));
    EXPECT_GE(fewer_y, std::min(ny, 8));
  }
}

TEST(ExpectedTransforms, OfAPressThatIsTriedOnAllCellsAreThoseOfThePress) {
  for (const auto& [nx, ny] : {std::pair{48, 40}, {256, 192}})
    for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
      const Contact contact(rough(nx, ny, boundary));
      const State state = test::press(contact.scene, PressBy::pressure, 2e7);
      for (const PressBy by : controls) {
        const double value = value_of(state, by);
        const ExpectedTransforms expected = contact.expected(by, value);
        const State again = test::press(contact.scene, by, value);
        EXPECT_EQ(expected.transforms, again.cost().total.transforms) << name(by);
        EXPECT_EQ(expected.tried_on, contact.scene.lower.grid());
        EXPECT_TRUE(expected.ended && expected.refused.empty());
        EXPECT_EQ(expected.halvings, 0);
      }
    }
}

TEST(ExpectedTransforms, OfFewerCellsAreWithinAFactorOfTwoByEachControl) {
  const Contact contact(rough(256, 192));
  const State state = test::press(contact.scene, PressBy::pressure, 1e7);
  for (const PressBy by : controls) {
    const double value = value_of(state, by);
    const ExpectedTransforms expected = contact.expected(by, value, {.most_nodes = 96 * 96});
    const double taken = test::press(contact.scene, by, value).cost().total.transforms;
    EXPECT_LT(expected.transforms, 2 * taken) << name(by);
    EXPECT_GT(expected.transforms, 0.5 * taken) << name(by);
    EXPECT_EQ(expected.tried_on, (Grid{108, 80, 256, 192}));
    EXPECT_NEAR(expected.halvings, std::log2(256 * 192 / (108 * 80.0)) / 2, 1e-12);
  }
}

// The first trial gets a part of the work, the second all.
TEST(ExpectedTransforms, TakeAboutTheWorkGiven) {
  const Contact contact(rough(512, 512));
  const Grid& grid = contact.scene.lower.grid();
  double before = 0;
  for (const double work : {1e7, 3e7}) {
    const ExpectedTransforms expected = contact.expected(PressBy::pressure, 1e7, {.work = work});
    EXPECT_GT(expected.work * transform_work(grid), 0.25 * work);
    EXPECT_LT(expected.work * transform_work(grid), 2 * work);
    const auto nodes = static_cast<double>(expected.tried_on.nodes());
    EXPECT_GT(nodes, 1.5 * before);
    EXPECT_LT(nodes, static_cast<double>(grid.nodes()));
    before = nodes;
  }
}

TEST(ExpectedTransforms, OfATrialThatIsLeftAreMore) {
  const Contact contact(rough(64, 64));
  const double taken = contact.expected(PressBy::approach, 1).transforms;
  const double left_after = 0.5 * taken;
  const ExpectedTransforms expected = contact.expected(
      PressBy::approach, 1, {.work = left_after * transform_work(contact.scene.lower.grid())});
  EXPECT_FALSE(expected.ended);
  EXPECT_NEAR(expected.tried, left_after, 1e-9 * taken);
  EXPECT_NEAR(expected.transforms, 3 * left_after, 1e-9 * taken);
}

// Estimated even without memory for the press.
TEST(ExpectedTransforms, AreTriedWithinALimitOfMemory) {
  struct Limit {
    explicit Limit(std::int64_t bytes) { memory::set_limit(bytes); }
    ~Limit() { memory::set_limit(0); }
  };
  const Contact contact(rough(256, 256));
  for (const PressBy by : {PressBy::pressure, PressBy::flatten})
    for (const double share : {0.9, 0.5, 0.2}) {
      const double value = by == PressBy::pressure ? 1e7 : 0.2;
      const double taken = contact.expected(by, value).transforms;
      const Limit limit(memory::held() +
                        static_cast<std::int64_t>(share * static_cast<double>(contact.plan.bytes_peak())));
      const ExpectedTransforms expected = contact.expected(by, value);
      EXPECT_LT(expected.tried_on.nodes(), contact.scene.lower.grid().nodes());
      EXPECT_LT(expected.transforms, 2 * taken);
      EXPECT_GT(expected.transforms, 0.5 * taken);
      EXPECT_FALSE(memory::exceeded());
    }
}

TEST(ExpectedTransforms, ThatAreTriedAreNotCounted) {
  const Contact contact(rough(40, 40));
  const double before = cost::transforms();
  const ExpectedTransforms expected = contact.expected(PressBy::approach, 1e-2);
  EXPECT_GT(expected.work, 0);
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
  const Contact contact(scene);
  // Closing loads: 2e8 Pa on doubled cells, 4e8 Pa on these.
  const double pressure = 2.4e8;
  const State state = test::press(scene, PressBy::pressure, pressure);
  ASSERT_LT(state.area_fraction(), 1);
  const double said = contact.expected(PressBy::pressure, pressure).transforms;
  const double taken = state.cost().total.transforms;
  EXPECT_LT(said, 2 * taken);
  EXPECT_GT(said, 0.5 * taken);
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
                               "`, tried on all 128 x 128 cells\n"),
              std::string::npos)
        << plan.text();
    EXPECT_NEAR(plan.seconds / plan.transforms, contact.plan.seconds / contact.plan.transforms, 1e-12);
    EXPECT_EQ(plan.bytes_peak() - contact.plan.bytes_peak(),
              by == PressBy::flatten ? contact.plan.bytes_to_flatten : 0);
  }
  EXPECT_GT(contact.plan.bytes_to_flatten, 0);
}

TEST(PlanOfAPress, SaysOnHowManyCellsItWasTried) {
  const Contact contact(rough(2048, 1024));
  const Grid grid = contact.expected(PressBy::approach, 1).tried_on;
  ASSERT_LT(grid.nodes(), contact.scene.lower.grid().nodes());
  const std::string text = contact.plan_of(PressBy::approach, 1).text();
  EXPECT_NE(text.find("`, tried on " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
                      " cells; one such press in some fifty takes over "),
            std::string::npos)
      << text;
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
