// SPDX-License-Identifier: GPL-3.0-or-later
// Events on a rough pair: plastic deformation and repeated presses; only yield changes a stored surface.
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/contact/effects/creep.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/operations/heights.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"
#include "tests/support/warnings.hpp"

namespace asperity::plastic_events_test {
namespace {

using test::error_of;

constexpr double megapascal = 1e6, micrometre = 1e-6;

Surface specimen(std::uint64_t seed, double hardness = 1.1e9, int cells = 64) {
  SelfAffineOptions options = test::self_affine(make_grid(cells, cells, 250 * micrometre, 250 * micrometre),
                                                0.8, 250 * micrometre * 6 / cells, seed);
  options.ra = 1 * micrometre;
  Material metal = test::elastic(70e9, 0.33);
  metal.hardness = hardness;
  return self_affine_surface(options).with_material(metal);
}

const NodeMemory& hardness_of(const SpecimenPair& pair) {
  static const NodeMemory none;
  const auto kept = pair.memory().find(hardness_memory);
  return kept == pair.memory().end() ? none : kept->second;
}

Scene scene_of(Boundary boundary = Boundary::periodic, PlasticityOptions plasticity = {},
               double tolerance = 1e-9) {
  Scene scene{specimen(1), specimen(2), boundary, HalfSpaceOptions{}, Accuracy{tolerance}};
  scene.effects.set(plasticity);
  return scene;
}

PressRequest pressure(double megapascals) { return {PressBy::pressure, megapascals * megapascal, {}}; }

double volume_lost(const Surface& before, const Surface& after) {
  double sum = 0;
  for (std::size_t k = 0; k < before.heights().size(); ++k) sum += before.heights()[k] - after.heights()[k];
  return sum * before.grid().cell_area();
}

TEST(PlasticEvents, ALoadAboveTheHardnessIsRefusedBeforeAnyEvent) {
  const double tile = specimen(1).grid().area();
  const auto refusal = [](const Scene& scene, const PressRequest& request) {
    const auto pair = std::make_shared<SpecimenPair>(scene);
    return error_of([&] { ProtocolRun(Protocol({{pressure(10)}, {Protocol::Release{}}, {request}}), pair); });
  };
  const std::string told =
      "event 3 of 3: press 1.1 GPa: a mean pressure of 1.1 GPa cannot be carried: `hardness` "
      "is 1.1 GPa; press with less than the hardness, or give `hardening`";
  EXPECT_NE(refusal(scene_of(), pressure(1100)).find(told), std::string::npos)
      << refusal(scene_of(), pressure(1100));
  EXPECT_NE(refusal(scene_of(), {PressBy::load, 2e9 * tile, {}}).find("a mean pressure of 2 GPa"),
            std::string::npos);
  Scene box = scene_of();
  box.elasticity = BoxOptions{};
  EXPECT_NE(refusal(box, pressure(1100)).find("event 3 of 3"), std::string::npos);
  EXPECT_EQ(refusal(scene_of(), pressure(1099)), "");
  EXPECT_EQ(refusal(scene_of(), {PressBy::approach, 1e-6, {}}), "");
  EXPECT_EQ(refusal(scene_of(Boundary::periodic, {{}, 80e12}), pressure(1100)), "");
  Scene elastic = scene_of();
  elastic.effects = {};
  EXPECT_EQ(refusal(elastic, pressure(1100)), "");
}

TEST(PlasticEvents, APressFlattensBothBodiesByWhatItReports) {
  SpecimenPair pair(scene_of());
  const Surface lower = pair.lower(), upper = pair.upper();
  const State state = pair.press(pressure(100));
  EXPECT_GT(state.plastic_volume(), 0);
  EXPECT_GT(state.plastic_fraction(), 0);
  EXPECT_LE(state.peak_pressure(), 1.1e9);
  EXPECT_TRUE(state.converged());
  const double lower_loss = volume_lost(lower, pair.lower()), upper_loss = volume_lost(upper, pair.upper());
  EXPECT_NEAR((lower_loss + upper_loss) / state.plastic_volume(), 1, 1e-9);
  EXPECT_NEAR(lower_loss / upper_loss, 1, 1e-9);
  EXPECT_EQ(state.geometry().lower().digest(), lower.digest());
}

TEST(PlasticEvents, ReleaseTakesNothingAndGivesNothingBack) {
  SpecimenPair pair(scene_of());
  pair.press(pressure(100));
  const std::string lower = pair.lower().digest(), upper = pair.upper().digest();
  pair.release();
  EXPECT_EQ(pair.lower().digest(), lower);
  EXPECT_EQ(pair.upper().digest(), upper);
}

TEST(PlasticEvents, WithoutPlasticityNothingStays) {
  Scene scene = scene_of();
  scene.effects.remove<PlasticityOptions>();
  SpecimenPair pair(scene);
  const std::string lower = pair.lower().digest();
  const State state = pair.press(pressure(100));
  EXPECT_EQ(pair.lower().digest(), lower);
  EXPECT_NE(
      error_of([&] { find_quantity("plastic_volume")->of(state); }).find("needs the effect `plasticity`"),
      std::string::npos);
}

TEST(PlasticEvents, ARepeatedEventWithoutTurningTakesNothingMore) {
  SpecimenPair pair(scene_of());
  const double first = pair.press(pressure(100)).plastic_volume();
  pair.release();
  const Surface lower = pair.lower();
  for (const double megapascals : {100.0, 40.0, 100.0}) {
    EXPECT_EQ(pair.press(pressure(megapascals)).plastic_volume(), 0);
    EXPECT_EQ(pair.lower().digest(), lower.digest());
  }
  // A slightly greater load is not covered by the memory of earlier loads.
  EXPECT_LT(pair.press(pressure(100 * (1 + 1e-15))).plastic_volume(), 1e-6 * first);
}

TEST(PlasticEvents, WhatWasCarriedIsForgottenWhenTheBodiesAreMoved) {
  SpecimenPair pair(scene_of());
  const double first = pair.press(pressure(100)).plastic_volume();
  pair.shift(125 * micrometre, 0);
  EXPECT_GT(pair.press(pressure(60)).plastic_volume(), 0.01 * first);
}

TEST(PlasticEvents, ALongerDwellUnderTheSameLoadTakesMoreAndAShorterOneNothing) {
  Scene scene = scene_of();
  scene.effects.set(CreepOptions{});
  SpecimenPair pair(scene);
  const double first = pair.press({PressBy::pressure, 100 * megapascal, 600.0}).plastic_volume();
  EXPECT_EQ(pair.press({PressBy::pressure, 100 * megapascal, 60.0}).plastic_volume(), 0);
  EXPECT_GT(pair.press({PressBy::pressure, 100 * megapascal, 60000.0}).plastic_volume(), 1e-3 * first);
  // Both loads are known now; a greater load for a shorter time is not.
  EXPECT_EQ(pair.press({PressBy::pressure, 100 * megapascal, 60000.0}).plastic_volume(), 0);
  EXPECT_GT(pair.press({PressBy::pressure, 200 * megapascal, 600.0}).plastic_volume(), first);
}

// The upper body's share is mapped between nodes, but the pair's total loss stays in place.
TEST(PlasticEvents, ARepeatedEventOffTheLatticeTakesNothingMore) {
  for (const double hardening : {std::numeric_limits<double>::infinity(), 8e13})
    for (const double degrees : {37.0, 10.0, 45.0}) {
      SpecimenPair pair(scene_of(Boundary::free, {{}, hardening}));
      pair.rotate(degrees * std::numbers::pi / 180);
      const State first = pair.press(pressure(100));
      ASSERT_GT(first.plastic_volume(), 0);
      for (int event = 0; event < 3; ++event) {
        pair.release();
        // Not covered by the memory of earlier loads.
        const State again = pair.press(pressure(100 * (1 + (event + 1) * 1e-15)));
        EXPECT_LT(again.plastic_volume() / first.plastic_volume(), 1e-6) << degrees << " deg, " << hardening;
        EXPECT_NEAR(again.area_fraction(), first.area_fraction(), 1e-3) << degrees << " deg, " << hardening;
      }
      // After a placement each body uses its own frame.
      pair.rotate(-degrees * std::numbers::pi / 180);
      EXPECT_EQ(hardness_of(pair).upper_here, nullptr);
      EXPECT_GT(pair.press(pressure(100)).plastic_volume(), 0.1 * first.plastic_volume());
    }
}

TEST(PlasticEvents, ALoadAndThenAGreaterOneEqualTheGreaterAlone) {
  SpecimenPair in_steps(scene_of()), at_once(scene_of());
  const Surface virgin = in_steps.lower();
  in_steps.press(pressure(60));
  in_steps.press(pressure(150));
  at_once.press(pressure(150));
  const double by_steps = volume_lost(virgin, in_steps.lower()), alone = volume_lost(virgin, at_once.lower());
  EXPECT_NEAR(by_steps / alone, 1, 1e-6);
}

TEST(PlasticEvents, TurningBringsFreshGroundAndTakesMore) {
  SpecimenPair pair(scene_of());
  const double first = pair.press(pressure(100)).plastic_volume();
  pair.release();
  pair.place(5);
  EXPECT_GT(pair.press(pressure(100)).plastic_volume(), 0.1 * first);
}

TEST(PlasticEvents, EightTurnsWithoutLoadLeaveEveryBitAsItWas) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    SpecimenPair pair(scene_of(boundary));
    const std::string lower = pair.lower().digest(), upper = pair.upper().digest();
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      pair.place(seed);
      if (boundary == Boundary::free) pair.rotate(0.37);
      pair.press(pressure(0));
      pair.release();
    }
    EXPECT_EQ(pair.lower().digest(), lower);
    EXPECT_EQ(pair.upper().digest(), upper);
  }
}

TEST(PlasticEvents, AFailedPressLeavesTheContactAsItWas) {
  SpecimenPair pair(scene_of());
  pair.press(pressure(50));
  const std::string lower = pair.lower().digest(), upper = pair.upper().digest();
  EXPECT_NE(error_of([&] { pair.press(pressure(1100)); }), "");
  EXPECT_NE(error_of([&] { pair.press(pressure(-1)); }), "");
  EXPECT_EQ(pair.lower().digest(), lower);
  EXPECT_EQ(pair.upper().digest(), upper);
  EXPECT_TRUE(pair.under_load());
}

TEST(PlasticEvents, ACopyLivesItsOwnLife) {
  SpecimenPair pair(scene_of());
  SpecimenPair copy = pair;
  copy.press(pressure(100));
  EXPECT_NE(copy.lower().digest(), pair.lower().digest());
  pair.press(pressure(100));
  EXPECT_EQ(copy.lower().digest(), pair.lower().digest());
}

TEST(PlasticEvents, TheSofterBodyLosesMore) {
  Scene scene = scene_of();
  scene.upper = specimen(2, 3.3e9);
  SpecimenPair pair(scene);
  const Surface lower = pair.lower(), upper = pair.upper();
  pair.press(pressure(100));
  // Hardness ratio 3.
  const double odds = std::exp(1.5 * (9 - 1.0 / 9));
  EXPECT_NEAR(volume_lost(lower, pair.lower()) / volume_lost(upper, pair.upper()), odds, 1e-6 * odds);
}

TEST(PlasticEvents, AFlatCounterBodyStaysFlat) {
  Scene scene = scene_of();
  Material quartz = test::elastic(95e9, 0.08);
  scene.upper = quartz;
  SpecimenPair pair(scene);
  const Surface lower = pair.lower();
  const State state = pair.press(pressure(100));
  EXPECT_NEAR(volume_lost(lower, pair.lower()) / state.plastic_volume(), 1, 1e-9);
  EXPECT_EQ(pair.upper().peak_to_valley(), 0);
}

TEST(PlasticEvents, AHarderCounterBodyThatNeverYieldsIsNotCut) {
  Scene scene = scene_of();
  scene.upper = specimen(2).with_material(rigid_material());
  SpecimenPair pair(scene);
  const std::string upper = pair.upper().digest();
  pair.press(pressure(100));
  EXPECT_EQ(pair.upper().digest(), upper);
}

TEST(PlasticEvents, InfiniteHardnessIsElastic) {
  Scene elastic_scene = scene_of();
  elastic_scene.effects.remove<PlasticityOptions>();
  SpecimenPair hard(scene_of(Boundary::periodic, {std::numeric_limits<double>::infinity(), 1e13})),
      elastic(elastic_scene);
  const State with = hard.press(pressure(100)), without = elastic.press(pressure(100));
  EXPECT_EQ(with.digest(), without.digest());
  EXPECT_EQ(with.plastic_volume(), 0);
}

TEST(PlasticEvents, HardenedNodesCarryTheSameLoadWithoutYieldingAgain) {
  SpecimenPair pair(scene_of(Boundary::periodic, {{}, 8e13}));
  const double first = pair.press(pressure(100)).plastic_volume();
  ASSERT_NE(hardness_of(pair).lower, nullptr);
  EXPECT_GT(range(hardness_of(pair).lower->values()).max, 1.1e9);
  pair.release();
  EXPECT_LT(pair.press(pressure(100 * (1 + 1e-15))).plastic_volume(), 1e-5 * first);
  pair.release();
  pair.place(3);
  EXPECT_GT(pair.press(pressure(100)).plastic_volume(), 0.1 * first);
}

TEST(PlasticEvents, ALongerDwellTakesMore) {
  Scene scene = scene_of();
  scene.effects.set(CreepOptions{});
  std::vector<double> volumes;
  for (const double dwell : {0.0, 600.0, 60000.0}) {
    SpecimenPair pair(scene);
    volumes.push_back(pair.press({PressBy::pressure, 100 * megapascal, dwell}).plastic_volume());
  }
  EXPECT_LT(volumes[0], volumes[1]);
  EXPECT_LT(volumes[1], volumes[2]);
  // The reference dwell: as without creep.
  SpecimenPair plain(scene_of());
  EXPECT_EQ(plain.press(pressure(100)).plastic_volume(), volumes[1]);
}

TEST(PlasticEvents, AFreeTurnByAnyAngleMeetsFreshGroundAndNeverResamples) {
  SpecimenPair pair(scene_of(Boundary::free, {}, 1e-7));
  const Surface upper = pair.upper();
  const double first = pair.press(pressure(60)).plastic_volume();
  pair.release();
  pair.rotate(30 * std::numbers::pi / 180);
  const Surface before = pair.upper();
  const State state = pair.press(pressure(60));
  EXPECT_GT(state.plastic_volume(), 0.05 * first);
  // The increment is mapped, not the heights.
  for (std::size_t k = 0; k < before.heights().size(); ++k)
    EXPECT_LE(pair.upper().heights()[k], before.heights()[k]);
  EXPECT_NEAR(volume_lost(before, pair.upper()) / state.plastic_volume(), 0.5, 1e-6);
}

TEST(PlasticEvents, AStepAtTheRimOfAPeriodicHalfSpaceIsWarnedOfOnce) {
  Scene scene = scene_of();
  const Surface& body = scene.lower;
  Field tilted = body.heights();  // continues across the rim: no warning
  const double height = range(tilted.values()).span();
  for (int i = 0; i < body.grid().nx; ++i)
    for (int j = 0; j < body.grid().ny; ++j) tilted(i, j) += height * i / body.grid().nx;
  scene.lower = Surface(body.grid(), std::move(tilted), SurfaceTraits{body.material(), false, {}});
  SpecimenPair pair(scene);
  test::Warnings monitor;
  pair.press(pressure(10), monitor);
  pair.press(pressure(20), monitor);
  ASSERT_EQ(monitor.all.size(), 1U);
  EXPECT_NE(monitor.all[0].find("the lower body does not continue across the rim"), std::string::npos);
  EXPECT_NE(monitor.all[0].find("boundary=\"free\""), std::string::npos);
  scene.boundary = Boundary::free;
  test::Warnings quiet;
  SpecimenPair free(scene);
  free.press(pressure(10), quiet);
  EXPECT_TRUE(quiet.all.empty());
}

TEST(PlasticEvents, ADwellWithoutCreepIsWarnedOfOnce) {
  test::Warnings monitor;
  SpecimenPair pair(scene_of());
  pair.press(pressure(10), monitor);
  EXPECT_TRUE(monitor.all.empty());
  EXPECT_EQ(pair.press({PressBy::pressure, 20 * megapascal, 600.0}, monitor).digest(), [&] {
    SpecimenPair other(scene_of());
    other.press(pressure(10));
    return other.press(pressure(20)).digest();
  }());
  pair.press({PressBy::pressure, 30 * megapascal, 60.0}, monitor);
  ASSERT_EQ(monitor.all.size(), 1U);
  EXPECT_NE(monitor.all[0].find("`dwell` does nothing without creep"), std::string::npos);
  Scene scene = scene_of();
  scene.effects.set(CreepOptions{});
  SpecimenPair creeping(scene);
  test::Warnings quiet;
  creeping.press({PressBy::pressure, 10 * megapascal, 600.0}, quiet);
  EXPECT_TRUE(quiet.all.empty());
}

TEST(PlasticEvents, CostIsToldByEffect) {
  SpecimenPair pair(scene_of());
  const StateCost cost = pair.press(pressure(100)).cost();
  ASSERT_EQ(cost.by_effect.size(), 2U);
  EXPECT_EQ(cost.by_effect[0].first, "elasticity");
  EXPECT_GT(cost.by_effect[0].second.transforms, 0);
  EXPECT_EQ(cost.by_effect[1].first, "plasticity");
  EXPECT_GT(cost.by_effect[1].second.bytes, 0);
}

}  // namespace
}  // namespace asperity::plastic_events_test
