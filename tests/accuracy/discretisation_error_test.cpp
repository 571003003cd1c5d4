// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation error estimates: known answers and extremes. For distributions see
// tests/accuracy/distributions.
#include "engine/accuracy/discretisation_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::discretisation_error_test {
namespace {

using test::elastic;
using test::error_of;

Scene half_space(Surface lower, Boundary boundary) {
  Scene scene{lower.with_material(elastic(1e9)), rigid_material(), boundary, HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.estimate = Accuracy::Estimate::coarser;
  return scene;
}

State pressed(const Scene& scene, const PressRequest& request) {
  check_accuracy(scene);
  auto geometry = std::make_shared<const ContactGeometry>(
      scene, LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny));
  const State state = make_solver(make_plan(scene, *geometry), geometry)->press(request);
  return state.beside(solve_coarser(scene, *geometry, make_plan(scene, *geometry), request));
}

Surface paraboloid(int n) { return sphere_surface({Grid{n, n, 1, 1}, 10, SphereShape::paraboloid}); }
double hertz_load(double radius_of_contact) { return 4.0 / 3 * 1e9 * std::pow(radius_of_contact, 3) / 10; }

Surface rough(int n, std::uint64_t seed = 1) {
  SelfAffineOptions o = test::self_affine(Grid{n, n, 1, 1}, 0.8, 1.0 / 16, seed);
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  return self_affine_surface(o);
}

TEST(CoarserGrids, HalvesWhileCellsAreLeft) {
  const auto cells = [](int nx, int ny) {
    std::vector<std::pair<int, int>> result;
    for (const Grid& grid : coarser_grids(Grid{nx, ny, 1, 1})) result.emplace_back(grid.nx, grid.ny);
    return result;
  };
  using Cells = std::vector<std::pair<int, int>>;
  EXPECT_EQ(cells(64, 64), (Cells{{32, 32}, {16, 16}}));
  EXPECT_EQ(cells(16, 16), (Cells{{8, 8}}));
  EXPECT_EQ(cells(15, 15), (Cells{}));
  EXPECT_EQ(cells(64, 1), (Cells{{32, 1}, {16, 1}}));
  EXPECT_EQ(cells(33, 16), (Cells{{17, 8}, {9, 8}}));
}

TEST(RiseBetweenNodes, IsThatOfTheParabola) {
  Field z(9, 7);
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 9; ++i) {
      const double x = i - 4.3, y = j - 2.8;
      z(i, j) = 5 - (x * x + 2 * y * y + 0.5 * x * y);
    }
  EXPECT_NEAR(rise_between_nodes(z, false), 5 - z(4, 3), 1e-12);
  EXPECT_NEAR(rise_between_nodes(z, true), 5 - z(4, 3), 1e-12);
}

TEST(RiseBetweenNodes, NothingIsKnownPastARim) {
  Field z(5, 5);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) z(i, j) = -i - 0.1 * (j - 2.2) * (j - 2.2);
  EXPECT_NEAR(rise_between_nodes(z, false), 0.1 * 0.2 * 0.2, 1e-12);  // along the rim only
  // Next to uncovered nodes (lowest height).
  Field turned(7, 7);
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 7; ++i) turned(i, j) = i < 3 ? -100 : -(i - 2.7) * (i - 2.7) - (j - 3.1) * (j - 3.1);
  EXPECT_NEAR(rise_between_nodes(turned, false), 0.1 * 0.1, 1e-12);
  EXPECT_EQ(rise_between_nodes(Field(1, 1, 3.0), true), 0);
  EXPECT_EQ(rise_between_nodes(Field(8, 8, 3.0), true), 0);
}

TEST(DiscretisationEstimate, HertzErrorsAreCovered) {
  for (const double a : {0.13, 0.21, 0.31}) {
    const State state =
        pressed(half_space(paraboloid(64), Boundary::free), {PressBy::load, hertz_load(a), {}});
    const double area = std::numbers::pi * a * a;
    const std::pair<const char*, double> exact[] = {{"area_fraction", area},
                                                    {"corrected_area_fraction", area},
                                                    {"approach", a * a / 10},
                                                    {"energy", 0.4 * hertz_load(a) * a * a / 10},
                                                    {"peak_pressure", 1.5 * hertz_load(a) / area},
                                                    {"stiffness", 2e9 * a}};
    for (const auto& [name, value] : exact) {
      const DiscretisationEstimate estimate = discretisation_estimate(state, name);
      EXPECT_LE(std::abs(estimate.value - value), 3 * estimate.error) << name << " " << a;
      EXPECT_LE(estimate.error, 0.2 * value) << name << " " << a;
    }
  }
}

TEST(DiscretisationEstimate, ExtrapolatedAreaIsBetter) {
  double off = 0, off_extrapolated = 0;
  for (const double a : {0.13, 0.21, 0.31, 0.42}) {
    const State state =
        pressed(half_space(paraboloid(128), Boundary::free), {PressBy::load, hertz_load(a), {}});
    const double area = std::numbers::pi * a * a;
    const DiscretisationEstimate estimate = discretisation_estimate(state, "area_fraction");
    off += std::abs(estimate.value - area);
    off_extrapolated += std::abs(estimate.extrapolated - area);
    EXPECT_EQ(estimate.relative(), estimate.error / estimate.value);
  }
  EXPECT_LT(off_extrapolated, 0.7 * off);
}

TEST(DiscretisationEstimate, WhatIsPrescribedHasNone) {
  const Scene scene = half_space(rough(64), Boundary::periodic);
  const State by_pressure = pressed(scene, {PressBy::pressure, 5e6, {}});
  EXPECT_EQ(discretisation_estimate(by_pressure, "pressure").error, 0);
  EXPECT_EQ(discretisation_estimate(by_pressure, "load").error, 0);
  EXPECT_GT(discretisation_estimate(by_pressure, "approach").error, 0);
  const State by_approach = pressed(scene, {PressBy::approach, by_pressure.approach(), {}});
  EXPECT_EQ(discretisation_estimate(by_approach, "approach").error, 0);
  EXPECT_GT(discretisation_estimate(by_approach, "pressure").error, 0);
  // The peak-to-valley depends on the grid.
  const State by_indentation = pressed(scene, {PressBy::indentation, by_pressure.indentation(), {}});
  EXPECT_EQ(discretisation_estimate(by_indentation, "indentation").error, 0);
  EXPECT_GT(discretisation_estimate(by_indentation, "approach").relative(), 1e-3);
}

TEST(DiscretisationEstimate, PeakAtTheRimOfAPunchHasNoLimit) {
  const State state =
      pressed(half_space(flat_surface({Grid{64, 64, 1, 1}}), Boundary::free), {PressBy::pressure, 1e6, {}});
  const DiscretisationEstimate estimate = discretisation_estimate(state, "peak_pressure");
  EXPECT_EQ(estimate.error, std::numeric_limits<double>::infinity());
  EXPECT_EQ(estimate.relative(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(discretisation_estimate(state, "area_fraction").error, 0);
}

TEST(DiscretisationEstimate, FullContactAndNoLoad) {
  const Scene scene = half_space(sine_surface({Grid{64, 64, 1, 1}, 0.01, {}, 2}), Boundary::periodic);
  const State full = pressed(scene, {PressBy::pressure, 1e8, {}});
  EXPECT_EQ(full.area_fraction(), 1);
  EXPECT_EQ(discretisation_estimate(full, "area_fraction").error, 0);
  EXPECT_LT(discretisation_estimate(full, "energy").relative(), 1e-5);
  EXPECT_EQ(discretisation_estimate(full, "stiffness").error, 0);  // infinite on every grid
  const State none = pressed(scene, {PressBy::pressure, 0, {}});
  for (const char* name : {"area_fraction", "approach", "energy", "peak_pressure", "load"})
    EXPECT_EQ(discretisation_estimate(none, name).error, 0) << name;
}

TEST(DiscretisationEstimate, BodiesAsTheyLie) {
  // Coarser grids take every second node of both bodies.
  Scene scene = half_space(rough(64, 1), Boundary::periodic);
  scene.upper = rough(64, 2).with_material(elastic(1e9));
  check_accuracy(scene);
  const LatticeIsometry pose = LatticeIsometry(64, 64).turned(1).shifted(5, 3);
  const auto geometry = std::make_shared<const ContactGeometry>(scene, pose);
  const auto coarser =
      solve_coarser(scene, *geometry, make_plan(scene, *geometry), {PressBy::pressure, 5e6, {}});
  ASSERT_EQ(coarser->levels().size(), 2u);
  const Field& half = coarser->levels()[0].state.geometry().combined();
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) EXPECT_EQ(half(i, j), geometry->combined()(2 * i, 2 * j));
}

TEST(DiscretisationEstimate, PlasticBodiesRememberOnCoarserGrids) {
  Scene scene = half_space(rough(64), Boundary::periodic);
  scene.effects.set(PlasticityOptions{.hardness = 5e7, .hardening = 1e12});
  const State state = pressed(scene, {PressBy::pressure, 1e7, {}});
  for (const char* name : {"plastic_volume", "plastic_fraction"}) {
    const DiscretisationEstimate estimate = discretisation_estimate(state, name);
    EXPECT_GT(estimate.value, 0);
    EXPECT_GT(estimate.error, 0);
    EXPECT_LT(estimate.relative(), 1);
  }
  // No yield: all nodes harder than any pressure.
  NodeMemory memory;
  memory.lower = std::make_shared<const Field>(64, 64, 1e12);
  const ContactGeometry hard(scene, LatticeIsometry(64, 64), {{std::string(hardness_memory), memory}});
  const auto coarser = solve_coarser(scene, hard, make_plan(scene, hard), {PressBy::pressure, 1e7, {}});
  EXPECT_EQ(coarser->levels()[0].state.plastic_volume(), 0);
  EXPECT_EQ(coarser->levels()[1].state.plastic_volume(), 0);
}

TEST(DiscretisationEstimate, BoxElementsHaveOneToo) {
  Scene scene = test::boxes(rough(64), 1e12);
  scene.accuracy.estimate = Accuracy::Estimate::coarser;
  const double before = cost::transforms();
  const State state = pressed(scene, {PressBy::pressure, 1e7, {}});
  EXPECT_EQ(cost::transforms(), before);
  EXPECT_GT(discretisation_estimate(state, "approach").error, 0);
}

TEST(DiscretisationEstimate, CostsLessThanTwoFifthsOfThePress) {
  const Scene scene = half_space(rough(128), Boundary::periodic);
  const auto geometry = std::make_shared<const ContactGeometry>(scene, LatticeIsometry(128, 128));
  const PressRequest request{PressBy::pressure, 5e6, {}};
  const CostScope press;
  make_solver(make_plan(scene, *geometry), geometry)->press(request);
  const double of_press = press.so_far().transforms;
  const CostScope estimate;
  solve_coarser(scene, *geometry, make_plan(scene, *geometry), request);
  EXPECT_GT(estimate.so_far().transforms, 0);
  EXPECT_LT(estimate.so_far().transforms, 0.4 * of_press);  // measured: 0.36
  const Plan plan = plan_with_estimate(scene, *geometry);
  EXPECT_NE(plan.text().find("estimate      the same press on 64 x 64 and 32 x 32 cells"), std::string::npos)
      << plan.text();
}

State pressed_beside_finer(Scene scene, const PressRequest& request) {
  scene.accuracy.estimate = Accuracy::Estimate::finer;
  check_accuracy(scene);
  const auto geometry = std::make_shared<const ContactGeometry>(
      scene, LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny));
  const Plan plan = plan_with_estimate(scene, *geometry);
  return make_solver(plan, geometry)->press(request).beside(solve_finer(scene, *geometry, plan, request));
}

TEST(EstimateFromAFinerGrid, HertzErrorsAreWithinAFactorOfThree) {
  for (const double a : {0.13, 0.21, 0.31}) {
    const State state =
        pressed_beside_finer(half_space(paraboloid(64), Boundary::free), {PressBy::load, hertz_load(a), {}});
    EXPECT_EQ(state.companion_grids()->levels()[0].state.geometry().grid().nx, 192);
    const double area = std::numbers::pi * a * a;
    const std::pair<const char*, double> exact[] = {
        {"area_fraction", area}, {"approach", a * a / 10}, {"energy", 0.4 * hertz_load(a) * a * a / 10}};
    for (const auto& [name, value] : exact) {
      const DiscretisationEstimate estimate = discretisation_estimate(state, name);
      const double off = std::abs(estimate.value - value);
      EXPECT_LE(off, 3 * estimate.error) << name << " " << a;
      EXPECT_LE(estimate.error, 3 * off) << name << " " << a;
      EXPECT_LT(std::abs(estimate.extrapolated - value), off) << name << " " << a;
    }
    EXPECT_EQ(discretisation_estimate(state, "load").error, 0);
  }
}

TEST(DiscretisationEstimate, OfAPrescribedApproachFollowsTheFirstTouch) {
  for (const double off_node : {0.0, 0.4}) {
    constexpr int n = 64;
    Field heights(n, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double x = (i - n / 2 - off_node) / n, y = (j - n / 2 + 0.5 * off_node) / n;
        heights(i, j) = -(x * x + y * y) / 20;
      }
    const Scene scene = half_space(
        Surface(Grid{n, n, 1, 1}, heights, {.material = {}, .periodic = false, .aliased_share = {}}),
        Boundary::free);
    const double approach = 0.004, load = 4.0 / 3 * 1e9 * std::sqrt(10) * std::pow(approach, 1.5);
    const PressRequest request{PressBy::approach, approach, {}};
    const std::pair<const char*, double> exact[] = {{"load", load},
                                                    {"pressure", load},
                                                    {"secant_stiffness", load / approach},
                                                    {"energy", 0.4 * load * approach}};
    for (const State& state : {pressed(scene, request), pressed_beside_finer(scene, request)}) {
      const bool between = rise_between_nodes(state.geometry().combined(), false) > 1e-6 * approach;
      EXPECT_EQ(between, off_node > 0);
      for (const auto& [name, value] : exact) {
        const DiscretisationEstimate estimate = discretisation_estimate(state, name);
        const double off = std::abs(estimate.value - value);
        EXPECT_LE(off, 3 * estimate.error) << name << " " << off_node;
        if (between) {
          EXPECT_LE(estimate.error, 3 * off) << name << " " << off_node;
          EXPECT_LT(std::abs(estimate.extrapolated - value), 0.5 * off) << name << " " << off_node;
        }
      }
      EXPECT_EQ(discretisation_estimate(state, "approach").error, 0);
    }
  }
}

TEST(EstimateFromAFinerGrid, FullContactAndNoLoad) {
  const Scene scene = half_space(sine_surface({Grid{32, 32, 1, 1}, 0.01, {}, 2}), Boundary::periodic);
  const State full = pressed_beside_finer(scene, {PressBy::pressure, 1e8, {}});
  EXPECT_EQ(discretisation_estimate(full, "area_fraction").error, 0);
  EXPECT_EQ(discretisation_estimate(full, "stiffness").error, 0);
  const State none = pressed_beside_finer(scene, {PressBy::pressure, 0, {}});
  EXPECT_EQ(discretisation_estimate(none, "approach").error, 0);
}

TEST(EstimateFromAFinerGrid, CostsAboutElevenTimesThePress) {
  Scene scene = half_space(rough(128), Boundary::periodic);
  scene.accuracy.estimate = Accuracy::Estimate::finer;
  const auto geometry = std::make_shared<const ContactGeometry>(scene, LatticeIsometry(128, 128));
  const Plan plan = plan_with_estimate(scene, *geometry);
  const PressRequest request{PressBy::pressure, 5e6, {}};
  const CostScope press;
  make_solver(plan, geometry)->press(request);
  const double of_press = press.so_far().transforms;
  const CostScope estimate;
  solve_finer(scene, *geometry, plan, request);
  EXPECT_GT(estimate.so_far().transforms, 8 * of_press);
  EXPECT_LT(estimate.so_far().transforms, 14 * of_press);
  EXPECT_NE(plan.text().find("estimate      the same press on 384 x 384 cells, with it about 12 times the"),
            std::string::npos)
      << plan.text();
  scene.accuracy.estimate = Accuracy::Estimate::none;
  const Plan bare = make_plan(scene, *geometry);
  EXPECT_GE(plan.bytes_peak(), 10 * bare.bytes_grown());
  EXPECT_NEAR(plan.transforms, 12.04 * bare.transforms, 0.01 * plan.transforms);
}

TEST(EstimateFromAFinerGrid, PlasticBodiesRemember) {
  Scene scene = half_space(rough(64), Boundary::periodic);
  scene.effects.set(PlasticityOptions{.hardness = 5e7, .hardening = 1e12});
  const PressRequest request{PressBy::pressure, 1e7, {}};
  const State state = pressed_beside_finer(scene, request);
  const DiscretisationEstimate estimate = discretisation_estimate(state, "plastic_volume");
  EXPECT_GT(estimate.error, 0);
  EXPECT_LT(estimate.relative(), 0.5);
  NodeMemory memory;
  memory.lower = std::make_shared<const Field>(64, 64, 1e12);
  const ContactGeometry hard(scene, LatticeIsometry(64, 64), {{std::string(hardness_memory), memory}});
  const auto finer = solve_finer(scene, hard, make_plan(scene, hard), request);
  EXPECT_EQ(finer->levels()[0].state.plastic_volume(), 0);
}

TEST(EstimateFromAFinerGrid, IsNotOfACoarserOne) {
  Scene scene = half_space(paraboloid(15), Boundary::free);
  scene.accuracy.estimate = Accuracy::Estimate::finer;
  EXPECT_EQ(error_of([&] { check_accuracy(scene); }), "");
  scene.accuracy.asked = AskedError{0.01, {"approach"}};
  EXPECT_EQ(error_of([&] { check_accuracy(scene); }),
            "`estimate` = \"finer\" and `error` are both given; `error` compares with the coarser grids that "
            "it has tried: leave one of the two out");
}

TEST(DiscretisationEstimate, SaysWhatIsMissing) {
  Scene scene = half_space(paraboloid(32), Boundary::free);
  scene.accuracy.estimate = Accuracy::Estimate::none;
  const State state = test::press(scene, PressBy::load, hertz_load(0.2));
  EXPECT_EQ(state.companion_grids(), nullptr);
  EXPECT_EQ(error_of([&] { discretisation_estimate(state, "approach"); }),
            "the discretisation error of `approach` was not estimated in this press; give lab.contact "
            "accuracy={ estimate=true }, which solves coarser grids as well");
  EXPECT_EQ(error_of([&] { discretisation_estimate(state, "aproach"); }).substr(0, 76),
            "no discretisation error of `aproach` is estimated (did you mean `approach`?)");
  Scene small = half_space(paraboloid(15), Boundary::free);
  EXPECT_EQ(error_of([&] { check_accuracy(small); }),
            "`estimate` is given for a tile of 15 x 15 cells; it also presses on half the cells: give at "
            "least 16 along x or y, or leave `estimate` out");
}

TEST(Scene, AskedErrorIsChecked) {
  Scene scene = half_space(paraboloid(32), Boundary::free);
  scene.accuracy.asked = AskedError{1, {"approach"}};
  EXPECT_EQ(error_of([&] { check_accuracy(scene); }),
            "`error` is 1; it is relative: give a number from 1e-6 to below 1, such as 0.01 for 1 %");
  scene.accuracy.asked = AskedError{0.01, {}};
  EXPECT_EQ(error_of([&] { check_accuracy(scene); }),
            "`of` names no quantity; give one, such as \"corrected_area_fraction\"");
  scene.accuracy.asked = AskedError{0.01, {"approach", "area_fracton"}};
  EXPECT_NE(error_of([&] {
              check_accuracy(scene);
            }).find("`of` names `area_fracton`, whose error is not estimated"),
            std::string::npos);
  scene.accuracy.asked = AskedError{0.01, {"plastic_volume"}};
  EXPECT_EQ(error_of([&] { check_accuracy(scene); }),
            "`of` names `plastic_volume`, which needs the effect `plasticity`, and this scene names no such "
            "effect; "
            "name `plasticity`, or request the error of another quantity");
  scene.accuracy.asked = AskedError{0.01, {"approach", "energy"}};
  EXPECT_EQ(error_of([&] { check_accuracy(scene); }), "");
}

}  // namespace
}  // namespace asperity::discretisation_error_test
