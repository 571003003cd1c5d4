// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement and separation with plastic deformation.
#include <gtest/gtest.h>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::displacement_test {
namespace {

constexpr double megapascal = 1e6;

Surface rough(std::uint64_t seed) {
  SelfAffineOptions options = test::self_affine(make_grid(64, 64, 100e-6, 100e-6), 0.8, 12e-6, seed);
  options.ra = 0.3e-6;
  return self_affine_surface(options).with_material(named_material("Al-2011"));
}

Scene scene(Boundary boundary, UpperBody upper = rigid_material(), bool yields = true) {
  Scene scene{rough(1), std::move(upper), boundary, HalfSpaceOptions{}, Accuracy{}};
  if (yields) scene.effects.set(PlasticityOptions{});
  return scene;
}

State pressed(SpecimenPair& pair, double megapascals) {
  return pair.press({PressBy::pressure, megapascals * megapascal, {}});
}

TEST(Displacement, RisesAndFallsWithTheLoadAndRemembersWhatYielded) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    SpecimenPair pair(scene(boundary));
    double before = 0, first = 0;
    for (const double up : {10., 50., 100., 200.}) {
      const double now = pressed(pair, up).displacement();
      EXPECT_GT(now, before);
      if (first == 0) first = now;
      before = now;
    }
    const double most = before;
    for (const double down : {100., 50., 10.}) {
      const double now = pressed(pair, down).displacement();
      EXPECT_LT(now, before);
      before = now;
    }
    EXPECT_GT(before, 1.5 * first);
    pair.release();
    EXPECT_NEAR(pressed(pair, 200).displacement(), most, 1e-3 * most);
  }
}

TEST(Displacement, IsTheApproachOfUnwornBodiesHoweverTheyLie) {
  SpecimenPair pair(scene(Boundary::periodic, rough(2), false));
  for (const std::uint64_t seed : {1U, 2U}) {
    pair.place(seed);
    const State state = pressed(pair, 100);
    EXPECT_EQ(state.displacement(), state.approach());
  }
}

TEST(Displacement, GoesOnWhereAWornBodyIsPutDownAgain) {
  SpecimenPair pair(scene(Boundary::periodic));
  const double before = pressed(pair, 100).displacement();
  pair.release();
  const State at_once = pair.copy().press({PressBy::pressure, 100 * megapascal, {}});
  pair.place(3);  // under a flat all placements are equal
  EXPECT_NEAR(pressed(pair, 100).displacement(), at_once.displacement(), 1e-6 * before);
  EXPECT_GT(at_once.displacement(), at_once.approach());
}

TEST(Separation, IsThatOfTheBodiesAsTheyStandUnderTheLoad) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    SpecimenPair pair(scene(boundary));
    const State first = pressed(pair, 100), again = pressed(pair, 100);
    ASSERT_GT(first.plastic_volume(), 0);
    ASSERT_EQ(again.plastic_volume(), 0);
    EXPECT_NEAR(first.separation(), again.separation(), 1e-5 * first.approach());
    if (boundary == Boundary::periodic) {
      EXPECT_NEAR(first.separation(), first.mean_gap(), 1e-5 * first.approach());
    }
  }
}

}  // namespace
}  // namespace asperity::displacement_test
