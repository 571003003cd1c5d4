// SPDX-License-Identifier: GPL-3.0-or-later
// Eq. (1) of the source paper with a liquid: P includes the capillary force; μ is per applied load.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/contact/effects/capillarity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/friction/junction_law.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::capillary_friction_test {
namespace {

TEST(CapillaryFriction, TheJunctionsRubWithWhatTheyCarryAndTheAppliedLoadDivides) {
  Surface body = test::surface_of(make_grid(32, 32, 32e-6, 32e-6), [](int i, int j) {
    return 50e-9 * std::cos(2 * std::numbers::pi * i / 32) * std::cos(2 * std::numbers::pi * j / 32);
  });
  SurfaceTraits traits;
  traits.material = test::elastic(1e9);
  Scene scene{Surface(body.grid(), body.heights(), traits), rigid_material(), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{}};
  scene.effects.set(CapillarityOptions{});
  scene.effects.find<CapillarityOptions>()->pressure = 1e6;
  const State state = test::press(scene, PressBy::pressure, 1e5);
  const double carried = state.load() + state.attraction();
  ASSERT_GT(state.attraction(), 0);
  FrictionOptions options;
  options.alpha = 0.2;
  const FrictionResult friction = JunctionLaw(options).on(state);
  EXPECT_NEAR(friction.force, 0.2 * carried, 1e-12 * carried);
  EXPECT_NEAR(*friction.mu, 0.2 * carried / state.load(), 1e-12 * *friction.mu);
  EXPECT_GT(*friction.mu, 0.2);
}

}  // namespace
}  // namespace asperity::capillary_friction_test
