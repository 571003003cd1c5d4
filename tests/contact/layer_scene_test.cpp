// SPDX-License-Identifier: GPL-3.0-or-later
// A layer in a scene: refusals, plan, quantities with uniform compression.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/effects/capillarity.hpp"
#include "engine/contact/effects/tangential.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/contact/solution.hpp"
#include "engine/core/constants.hpp"
#include "engine/surface/generators/sine.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::layer_scene_test {
namespace {

constexpr double young = 2e9, poisson = 0.35, thickness = 40e-6, side = 100e-6, amplitude = 1e-6;

Surface noise(int n, std::uint64_t seed) {
  const Stream stream(seed, "heights on a layer");
  return test::surface_of(
             make_grid(n, n, side, side),
             [&](int i, int j) { return 1e-7 * stream.normal(static_cast<std::uint64_t>(j * n + i)); })
      .with_material(test::elastic(young, poisson));
}
Surface wave() { return sine_surface({Grid{48, 32, side, 0.6 * side}, amplitude, {}}); }

Scene scene_on_layer(Surface lower = wave().with_material(test::elastic(young, poisson))) {
  return {std::move(lower), rigid_material(), Boundary::periodic, LayerOptions{thickness}, Accuracy{}};
}

double contact_modulus() { return young / (1 - poisson * poisson); }
double uniform() { return thickness * (1 + poisson) * (1 - 2 * poisson) / (young * (1 - poisson)); }

TEST(LayerScene, InFullContactHasExactApproachAndEnergy) {
  const double q = 2 * std::numbers::pi / side;
  const double of_wave = 2 / (contact_modulus() * q) * layer_share(q * thickness, poisson, LayerBase::bonded);
  const double swing = amplitude / of_wave, p = 1.5 * swing;
  const State state = test::press(scene_on_layer(), PressBy::pressure, p);
  EXPECT_NEAR(state.peak_pressure(), p + swing, 1e-9 * p);
  EXPECT_NEAR(state.approach(), amplitude + uniform() * p, 1e-9 * state.approach());
  const double energy = 0.5 * state.grid().area() * (uniform() * p * p + 0.5 * of_wave * swing * swing);
  EXPECT_NEAR(state.energy(), energy, 1e-9 * energy);
  EXPECT_NEAR(state.stiffness(), 1 / uniform(), 1e-9 / uniform());
  EXPECT_NEAR(state.flatten(), 1, 1e-9);
  // Flat, and lowered by the approach from the crest.
  const Field under = *state.field("displacement");
  EXPECT_NEAR(under(0, 0), state.approach(), 1e-9 * state.approach());
}

TEST(LayerScene, SpendsTheWorkOfThePressAsEnergy) {
  // Work ∫ load dδ by Simpson's rule.
  const Scene scene = [] {
    Scene s = scene_on_layer(noise(24, 3));
    s.accuracy.tolerance = 1e-11;
    return s;
  }();
  const auto solver = test::ready(scene);
  const double from = solver->press({PressBy::pressure, 4e6, {}}).approach(), by = 4e-9;
  const State low = solver->press({PressBy::approach, from, {}});
  const State middle = solver->press({PressBy::approach, from + by / 2, {}});
  const State high = solver->press({PressBy::approach, from + by, {}});
  const double work = by / 6 * (low.load() + 4 * middle.load() + high.load());
  EXPECT_NEAR(high.energy() - low.energy(), work, 2e-4 * work);
}

TEST(LayerScene, BoundsHoldWhatATighterSolveFinds) {
  for (const PressBy by : {PressBy::pressure, PressBy::approach})
    for (const LayerBase base : {LayerBase::bonded, LayerBase::frictionless}) {
      Scene scene = scene_on_layer(noise(32, 9));
      scene.elasticity = LayerOptions{thickness / 4, base};
      const double value = by == PressBy::pressure ? 8e6 : 1.5e-7;
      scene.accuracy.tolerance = 1e-4;
      const State loose = test::press(scene, by, value);
      scene.accuracy.tolerance = 1e-12;
      const State tight = test::press(scene, by, value);
      ASSERT_GT(tight.contacts(), 20);
      ASSERT_LT(tight.contacts(), 1000);
      const AlgebraicError &e = loose.algebraic_error(), &f = tight.algebraic_error();
      EXPECT_LE(std::abs(loose.approach() - tight.approach()), e.approach + f.approach);
      EXPECT_LE(std::abs(loose.load() - tight.load()), e.load.value() + f.load.value());
      EXPECT_LE(std::abs(loose.energy() - tight.energy()), e.energy + f.energy);
      EXPECT_LE(std::abs(loose.mean_gap() - tight.mean_gap()), e.mean_gap + f.mean_gap);
      EXPECT_LE(std::abs(loose.peak_pressure() - tight.peak_pressure()), e.peak_pressure + f.peak_pressure);
      EXPECT_LT(e.energy, 0.05 * loose.energy());
      EXPECT_LT(e.approach, 0.05 * loose.approach());
      EXPECT_LT(f.energy, 1e-8 * loose.energy());
      EXPECT_LT(f.approach, 1e-6 * loose.approach());
    }
}

TEST(LayerScene, PlanNamesTheLayer) {
  const Scene scene = scene_on_layer();
  const std::string text = make_plan(scene, ContactGeometry(scene, LatticeIsometry(48, 32))).text();
  EXPECT_NE(text.find("layer of 40 um, bonded to a rigid base"), std::string::npos) << text;
  EXPECT_NE(text.find("a uniform pressure compresses it by 12.46 nm a MPa"), std::string::npos) << text;
}

TEST(LayerScene, RefusesByName) {
  const auto refused = [](Scene scene) { return test::error_of([&] { check(scene); }); };
  const auto names = [](const std::string& error, std::initializer_list<const char*> parts) {
    for (const char* part : parts)
      EXPECT_NE(error.find(part), std::string::npos) << error << "\nlacks " << part;
  };
  EXPECT_EQ(refused(scene_on_layer()), "");
  for (const double wrong : {0.0, -1e-6, infinity, std::nan("")}) {
    Scene scene = scene_on_layer();
    scene.elasticity = LayerOptions{wrong};
    names(refused(scene), {"`thickness`"});
  }
  Scene free = scene_on_layer();
  free.boundary = Boundary::free;
  names(refused(free), {"`boundary` is \"free\", and a layer", "periodic"});
  Scene soft = scene_on_layer();
  soft.upper = named_material("quartz");
  names(refused(soft), {"the upper body is of `quartz`", "lab.rigid"});
  Scene bare = scene_on_layer();
  bare.upper = wave();
  names(refused(bare), {"the upper body has no material", "lab.rigid"});
  bare.upper = wave().with_material(rigid_material());
  EXPECT_EQ(refused(bare), "");
  names(refused(scene_on_layer(wave().with_material(rigid_material()))), {"the lower body is rigid"});
  Scene sticky = scene_on_layer();
  sticky.effects.set(AdhesionOptions{0.05, 1e-9});
  names(refused(sticky), {"`adhesion` is not computed on a layer"});
  sticky.effects.find<AdhesionOptions>()->work = 0;
  EXPECT_EQ(refused(sticky), "");
  Scene wet = scene_on_layer();
  wet.effects.set(CapillarityOptions{.humidity = 0.5});
  names(refused(wet), {"`capillarity` is not computed on a layer"});
  Scene pulled = scene_on_layer();
  pulled.effects.set(TangentialOptions{});
  names(refused(pulled), {"`tangential` is not computed on a layer"});
  names(test::error_of([] { test::ready(scene_on_layer(wave())); }), {"the lower body", "no material"});
}

}  // namespace
}  // namespace asperity::layer_scene_test
