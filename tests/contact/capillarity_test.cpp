// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/capillarity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::capillarity_test {
namespace {

using test::elastic;
using test::error_of;
using test::press;
using test::surface_of;

Scene rough(std::optional<CapillarityOptions> capillarity) {
  Surface body = surface_of(make_grid(32, 32, 32e-6, 32e-6), [](int i, int j) {
    return 50e-9 * std::cos(2 * std::numbers::pi * i / 32) * std::cos(2 * std::numbers::pi * j / 32);
  });
  SurfaceTraits traits;
  traits.material = elastic(1e9);
  Scene scene{Surface(body.grid(), body.heights(), traits), rigid_material(), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.tolerance = 1e-5;
  if (capillarity) scene.effects.set(*capillarity);
  return scene;
}

// Water at 20 °C: γV_m/RT is 0.5377 nm, so a meniscus at 50 % has a radius of 0.7757 nm.
TEST(Capillarity, KelvinAndLaplaceSetTheMeniscus) {
  CapillarityOptions options;
  options.humidity = 0.5;
  const Meniscus half = meniscus(options);
  const double radius = 0.0728 * 1.8e-5 / (8.31446261815324 * 293.15 * std::log(2.0));
  EXPECT_NEAR(radius, 0.7756e-9, 0.001e-9);
  EXPECT_NEAR(half.pressure, 0.0728 / radius, 1e-9 * half.pressure);
  EXPECT_NEAR(half.height, 2 * radius, 1e-9 * half.height);
  options.contact_angle = std::numbers::pi / 3;
  EXPECT_NEAR(meniscus(options).height, radius, 1e-9 * radius);
  CapillarityOptions given;
  given.pressure = half.pressure;
  EXPECT_NEAR(meniscus(given).height, half.height, 1e-9 * half.height);
}

TEST(Capillarity, WithoutLiquidItIsTheContactWithoutIt) {
  const State without = press(rough({}), PressBy::pressure, 1e5);
  CapillarityOptions none, dry;
  none.pressure = 0;
  dry.humidity = 0;
  EXPECT_EQ(press(rough(none), PressBy::pressure, 1e5).digest(), without.digest());
  EXPECT_EQ(press(rough(dry), PressBy::pressure, 1e5).digest(), without.digest());
}

TEST(Capillarity, TheJunctionsCarryItsPullBesideTheLoad) {
  CapillarityOptions liquid;
  liquid.pressure = 1e6;
  const State state = press(rough(liquid), PressBy::pressure, 1e5);
  ASSERT_GT(state.attraction(), 0);
  double carried = 0;
  for (const double p : state.field("pressure")->values()) carried += p;
  carried *= state.geometry().grid().cell_area();
  EXPECT_NEAR(carried, state.load() + state.attraction(), 1e-9 * carried);
  EXPECT_EQ(state.cost().by_effect.back().first, "capillarity");
}

// 4πRγ cos θ (McFarlane & Tabor 1950) at a Tabor number of 0.05, in the limit of Derjaguin, Muller & Toporov.
TEST(Capillarity, HoldsASphereWithTheForceOfItsMeniscus) {
  const int n = 96;
  const double size = 8, tension = 0.01, angle = std::numbers::pi / 3;
  Surface body = surface_of(make_grid(n, n, size, size), [&](int i, int j) {
    const double x = ((i + 0.5) / n - 0.5) * size, y = ((j + 0.5) / n - 0.5) * size;
    return -0.5 * (x * x + y * y);
  });
  SurfaceTraits traits;
  traits.material = elastic(1);
  Scene scene{Surface(body.grid(), body.heights(), traits), rigid_material(), Boundary::free,
              HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.tolerance = 1e-4;
  const double work = 2 * tension * std::cos(angle);
  scene.effects.set(
      CapillarityOptions{.pressure = work / 0.95, .surface_tension = tension, .contact_angle = angle});
  ASSERT_NEAR(meniscus(*scene.effects.find<CapillarityOptions>()).height, 0.95, 1e-12);
  const double held = 4 * std::numbers::pi * tension * std::cos(angle);
  const auto contact = test::ready(scene);
  EXPECT_GT(contact->press({PressBy::load, -0.97 * held, {}}).contacts(), 0);
  EXPECT_NE(error_of([&] {
              contact->press({PressBy::load, -1.01 * held, {}});
            }).find("the bodies separate"),
            std::string::npos);
}

TEST(Capillarity, OptionsOutOfRangeAreRefused) {
  const auto refused = [](const CapillarityOptions& options) {
    return error_of([&] { check(rough(options)); });
  };
  EXPECT_NE(refused({}).find("neither `pressure` nor `humidity`"), std::string::npos);
  EXPECT_NE(refused({.pressure = 1.0, .humidity = 0.5}).find("both `pressure` and `humidity`"),
            std::string::npos);
  EXPECT_NE(refused({.pressure = -1.0}).find("`pressure` of the effect `capillarity` is -1 Pa"),
            std::string::npos);
  EXPECT_NE(refused({.humidity = 1.0}).find("`humidity` of the effect `capillarity` is 1"),
            std::string::npos);
  EXPECT_NE(
      refused({.humidity = 0.5, .contact_angle = std::numbers::pi / 2}).find("`contact_angle` is 90 deg"),
      std::string::npos);
  EXPECT_NE(refused({.humidity = 0.5, .surface_tension = 0}).find("`surface_tension`"), std::string::npos);
}

}  // namespace
}  // namespace asperity::capillarity_test
