// SPDX-License-Identifier: GPL-3.0-or-later
// Presses from a similar press: the same answer for fewer transforms, also from a useless guess.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_solver.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/accuracy/asked_scenes.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"
#include "tests/core/shelf.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::press_from_test {
namespace {

using test::rough;

const PressRequest pressed{PressBy::pressure, 5e6, {}};

enum class Ground { elastic, capped, hardening };

Scene scene_on(int n, Boundary boundary, Ground ground = Ground::elastic, double tolerance = 1e-5) {
  Scene scene{rough(n), rigid_material(), boundary, HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.tolerance = tolerance;
  if (ground != Ground::elastic) {
    PlasticityOptions options;
    options.hardness = 3e7;
    if (ground == Ground::hardening) options.hardening = 1e10;
    scene.effects.set(options);
  }
  return scene;
}

State press_from(const Solver& solver, const State& guess, const PressRequest& request = pressed) {
  return solver.press_from(*guess.solution(), request, Monitor::silent());
}

void expect_same(const State& one, const State& other, double tolerance, const std::string& of) {
  EXPECT_NEAR(one.approach(), other.approach(), 20 * tolerance * std::abs(other.approach())) << of;
  EXPECT_NEAR(one.area_fraction(), other.area_fraction(), 2e-3 * other.area_fraction()) << of;
  EXPECT_NEAR(one.energy(), other.energy(), 20 * tolerance * other.energy()) << of;
  EXPECT_LE(one.residual(), tolerance) << of;
}

TEST(PressFrom, AStateOnFewerCellsGivesTheSamePressForFewerTransforms) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const Ground ground : {Ground::elastic, Ground::capped, Ground::hardening})
      for (const int cells : {64, 96, 112}) {
        const std::string of = std::to_string(cells) + " cells, boundary " +
                               std::to_string(static_cast<int>(boundary)) + ", ground " +
                               std::to_string(static_cast<int>(ground));
        const State coarse = test::ready(scene_on(cells, boundary, ground))->press(pressed);
        const Scene scene = scene_on(128, boundary, ground);
        const auto solver = test::ready(scene);
        const State afresh = solver->press(pressed), from_coarse = press_from(*solver, coarse);
        expect_same(from_coarse, afresh, scene.accuracy.tolerance, of);
        EXPECT_LT(from_coarse.cost().total.transforms, 0.95 * afresh.cost().total.transforms) << of;
      }
}

TEST(PressFrom, ALooserAnswerOnTheSameCellsIsTightened) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const auto tight = test::ready(scene_on(128, boundary, Ground::elastic, 1e-7));
    const State loose = test::ready(scene_on(128, boundary, Ground::elastic, 1e-4))->press(pressed);
    const State afresh = tight->press(pressed), tightened = press_from(*tight, loose);
    expect_same(tightened, afresh, 1e-7, "tightened");
    EXPECT_LT(tightened.cost().total.transforms, 0.7 * afresh.cost().total.transforms);
  }
}

TEST(PressFrom, OfADifferentContactItStillConverges) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    Scene other = scene_on(48, boundary);
    other.lower = rough(48, 2);
    const State far_off = test::ready(other)->press({PressBy::pressure, 1e8, {}});
    const auto solver = test::ready(scene_on(128, boundary));
    expect_same(press_from(*solver, far_off), solver->press(pressed), 1e-5, "far off");
  }
}

TEST(PressFrom, CellsThatAreNotSquare) {
  const auto scene_of = [](int nx, int ny) {
    SelfAffineOptions o = test::self_affine(Grid{nx, ny, 2, 1}, 0.8, 0.125);
    o.rms_slope = 0.1;
    const Surface surface = self_affine_surface(o).with_material(test::elastic(1e9));
    Scene scene{surface, rigid_material(), Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
    scene.accuracy.tolerance = 1e-5;
    return scene;
  };
  const State coarse = test::ready(scene_of(64, 96))->press(pressed);
  const auto solver = test::ready(scene_of(96, 128));
  const State afresh = solver->press(pressed), from_coarse = press_from(*solver, coarse);
  expect_same(from_coarse, afresh, 1e-5, "96 x 128");
  EXPECT_LT(from_coarse.cost().total.transforms, afresh.cost().total.transforms);
}

TEST(PressFrom, ByApproachItIsThePressItself) {
  const auto solver = test::ready(scene_on(64, Boundary::periodic));
  const State guess = test::ready(scene_on(48, Boundary::periodic))->press(pressed);
  const PressRequest request{PressBy::approach, 0.5 * guess.approach(), {}};
  EXPECT_EQ(press_from(*solver, guess, request).digest(), solver->press(request).digest());
}

TEST(PressFrom, WhatItBeganFromIsInTheKeyOfItsAnswer) {
  Shelf shelf;
  ShelfMonitor monitor(shelf);
  const HalfSpaceProblem problem = half_space_test::rough_problem(32, Boundary::periodic, 1);
  const HalfSpaceAnswer first = half_space_test::solve(problem, 0.01),
                        second = half_space_test::solve(problem, 0.011);
  int solves = 0;
  const auto taken = [&](const HalfSpaceAnswer* start) {
    recall_or_solve(problem, "pressure", 0.01, start, monitor, [&] { return ++solves, first; });
  };
  for (const HalfSpaceAnswer* start : {static_cast<const HalfSpaceAnswer*>(nullptr), &first, &second}) {
    taken(start);
    taken(start);
  }
  EXPECT_EQ(solves, 3);
  EXPECT_EQ(shelf.found, 3);
}

}  // namespace
}  // namespace asperity::press_from_test
