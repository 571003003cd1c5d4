// SPDX-License-Identifier: GPL-3.0-or-later
// The tilt stage on a half-space: probe pressures, extrapolated to the weight.
#include <cmath>
#include <numbers>

#include "engine/contact/effects/capillarity.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/specimen/tilt_trials.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "tests/contact/contacts.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::tilt_half_space_test {
namespace {

using test::error_of;

constexpr double megapascal = 1e6;

SpecimenPair on_quartz() {
  SelfAffineOptions options = test::self_affine(make_grid(64, 64, 250e-6, 250e-6), 0.8, 24e-6, 7);
  options.ra = 1e-6;
  Scene scene{self_affine_surface(options).with_material(named_material("Al-2011")), named_material("quartz"),
              Boundary::periodic, HalfSpaceOptions{}, Accuracy{}};
  return SpecimenPair(scene);
}

TiltTrialOptions stage(std::vector<double> probes) {
  TiltTrialOptions options;
  options.stage.mass = 4.3e-3;
  options.probe_pressures = std::move(probes);
  return options;
}

const JunctionLaw law({500 * megapascal, 0.2, {}, {}});

TEST(TiltHalfSpace, SlipsAtTheRealAreaPerLoadOfTheProbe) {
  const SpecimenPair pair = on_quartz();
  const TiltResult result = raise(pair, law, stage({30 * megapascal}));
  SpecimenPair copy = pair;
  const State probe = copy.press({PressBy::pressure, 30 * megapascal, {}});
  ASSERT_GE(probe.contacts(), 50);
  const double c = probe.corrected_area_fraction() / probe.pressure();
  ASSERT_TRUE(result.area_per_load.has_value());
  EXPECT_DOUBLE_EQ(*result.area_per_load, c);
  EXPECT_LT(probe.corrected_area_fraction(), probe.area_fraction());
  EXPECT_NEAR(std::tan(result.angle), 0.2 + 500 * megapascal * c, 1e-9);
  EXPECT_TRUE(result.slipped);
  EXPECT_NE(result.note.find("calibrated"), std::string::npos);
}

TEST(TiltHalfSpace, TheAngleDoesNotDependOnAWeightBelowTheProbes) {
  const SpecimenPair pair = on_quartz();
  TiltTrialOptions light = stage({30 * megapascal}), heavy = light;
  light.stage.mass = 1e-6;
  heavy.stage.mass = 0.19;  // 29.8 MPa
  EXPECT_NEAR(raise(pair, law, light).angle, raise(pair, law, heavy).angle, 1e-12);
}

// Single spot, area ~ load^(2/3): Hertz gives mu = 0.1943 at the weight.
TEST(TiltHalfSpace, ALoneSpotIsSolvedUnderTheWeight) {
  for (const double size : {1e-3, 2e-4, 1e-4}) {
    Scene scene{sphere_surface({Grid{64, 64, size, size}, 1e-2, SphereShape::paraboloid})
                    .with_material(test::elastic(70e9, 0.33)),
                rigid_material(), Boundary::free, HalfSpaceOptions{}, Accuracy{}};
    const JunctionLaw weak({5 * megapascal, 0.1, {}, {}});
    TiltTrialOptions options = stage({megapascal, 3 * megapascal});
    options.repeats = 1;
    const TiltResult result = raise(SpecimenPair(scene), weak, options);
    EXPECT_NEAR(std::tan(result.angle), 0.1943, 0.012) << size;
    ASSERT_EQ(result.at_weight.size(), 1U);
    EXPECT_FALSE(result.probe_spread.has_value());
    // A large specimen has more spots elsewhere.
    options.specimen_area = 1;
    EXPECT_TRUE(raise(SpecimenPair(scene), weak, options).at_weight.empty());
  }
}

TEST(TiltHalfSpace, AreaPerLoadThatDiffersBetweenTheProbesIsReported) {
  const std::string differs = "area per load differs by";
  const TiltResult rough = raise(on_quartz(), law, stage({200 * megapascal, 4000 * megapascal}));
  EXPECT_TRUE(rough.at_weight.empty());
  EXPECT_NE(rough.note.find(differs), std::string::npos) << rough.note;
  EXPECT_EQ(raise(on_quartz(), law, stage({30 * megapascal})).note.find(differs), std::string::npos);
}

TEST(TiltHalfSpace, PressuresAboveTheHardnessAreReported) {
  const std::string hard = "times the hardness of the lower body";
  const TiltResult elastic = raise(on_quartz(), law, stage({30 * megapascal, 60 * megapascal}));
  EXPECT_NE(elastic.note.find(hard), std::string::npos) << elastic.note;
  EXPECT_EQ(elastic.note.find(hard), elastic.note.rfind(hard));
  Scene scene = on_quartz().scene();
  scene.effects.set(PlasticityOptions{});
  EXPECT_EQ(raise(SpecimenPair(scene), law, stage({30 * megapascal})).note.find(hard), std::string::npos);
}

// No extrapolation above the probes.
TEST(TiltHalfSpace, AWeightAboveTheProbesIsSolvedItself) {
  const SpecimenPair pair = on_quartz();
  const double area = pair.lower().grid().area();
  const TiltResult light = raise(pair, law, stage({30 * megapascal, 60 * megapascal}));
  EXPECT_TRUE(light.at_weight.empty());
  ASSERT_TRUE(light.probe_spread.has_value());
  EXPECT_GT(*light.probe_spread, 0);
  double before = 2;
  for (const double pressure : {40 * megapascal, 200 * megapascal, 1000 * megapascal, 8000 * megapascal}) {
    TiltTrialOptions options = stage({30 * megapascal, 60 * megapascal});
    options.repeats = 2;
    options.stage.mass = pressure * area / options.stage.gravity;
    const TiltResult result = raise(pair, law, options);
    ASSERT_EQ(result.at_weight.size(), 2U);
    EXPECT_NEAR(result.at_weight[0].pressure, pressure, 1e-6 * pressure);
    // Holding force: friction under the remaining normal force.
    SpecimenPair copy = pair;
    const State state = copy.press({PressBy::pressure, pressure * std::cos(result.angle), {}});
    const FrictionResult friction = law.on(state);
    const double corrected = state.corrected_area_fraction() / state.area_fraction();
    const double mu = (friction.adhesive_force * corrected + friction.load_force) / state.load();
    EXPECT_NEAR(std::tan(result.angle), mu, 1e-5 * mu) << pressure;
    EXPECT_LT(result.angle, before) << pressure;  // area grows less than proportionally
    before = result.angle;
    EXPECT_NE(result.note.find("above the smallest probe pressure"), std::string::npos) << result.note;
    EXPECT_EQ(result.note.find("the same at the weight"), std::string::npos) << result.note;
  }
}

TEST(TiltHalfSpace, AWeightThatTheHardnessCannotCarryIsRefused) {
  Scene scene = on_quartz().scene();
  scene.effects.set(PlasticityOptions{});
  TiltTrialOptions options = stage({30 * megapascal});
  options.stage.mass = 1e6;
  EXPECT_NE(error_of([&] { raise(SpecimenPair(scene), law, options); }).find("cannot be carried"),
            std::string::npos);
}

TEST(TiltHalfSpace, AProbeUnderFiftyNodesIsRaisedAndSaysSo) {
  const TiltResult result = raise(on_quartz(), law, stage({0.1 * megapascal}));
  ASSERT_EQ(result.probes.size(), 1U);
  EXPECT_GT(result.probes[0].pressure, 0.1 * megapascal);
  EXPECT_GE(result.probes[0].contacts, 50);
  EXPECT_NE(result.note.find("the probe pressure was raised to"), std::string::npos);
}

// Eq. (1) of the source paper with a liquid: junctions carry the capillary force; μ is per weight.
TEST(TiltHalfSpace, WhatTheBodiesAttractEachOtherByRaisesTheAngleAndIsTold) {
  Scene scene = on_quartz().scene();
  const TiltResult dry = raise(SpecimenPair(scene), law, stage({30 * megapascal}));
  EXPECT_EQ(dry.note.find("attract"), std::string::npos);
  EXPECT_EQ(dry.probes.at(0).attraction, 0);
  scene.effects.set(CapillarityOptions{.pressure = 100 * megapascal, .surface_tension = 5});
  const SpecimenPair pair(scene);
  const TiltResult wet = raise(pair, law, stage({30 * megapascal}));
  EXPECT_NE(wet.note.find("the bodies attract each other by"), std::string::npos) << wet.note;
  const double pull = wet.probes.at(0).attraction;
  ASSERT_GT(pull, 0.01);
  EXPECT_NEAR(std::tan(wet.angle), 0.2 * (1 + pull) + 500 * megapascal * *wet.area_per_load, 1e-9);
  EXPECT_GT(wet.angle, dry.angle);
}

TEST(TiltHalfSpace, SpotsThatYieldUnderTheProbeAreTold) {
  const std::string told = "spots yield under the probe pressure";
  Scene scene = on_quartz().scene();
  const TiltResult elastic = raise(SpecimenPair(scene), law, stage({30 * megapascal}));
  EXPECT_EQ(elastic.note.find(told), std::string::npos);
  EXPECT_FALSE(elastic.probes.at(0).yields);
  scene.effects.set(PlasticityOptions{});  // the softer of Al-2011 and quartz
  SpecimenPair pair(scene);
  const std::string before = pair.lower().digest();
  const TiltResult plastic = raise(pair, law, stage({30 * megapascal}));
  EXPECT_NE(plastic.note.find(told), std::string::npos) << plastic.note;
  EXPECT_TRUE(plastic.probes.at(0).yields);
  EXPECT_GT(*plastic.area_per_load, *elastic.area_per_load);
  EXPECT_EQ(pair.lower().digest(), before);
  scene.effects.set(PlasticityOptions{1e12, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(raise(SpecimenPair(scene), law, stage({30 * megapascal})).note.find(told), std::string::npos);
}
TEST(TiltHalfSpace, ARaisedProbeTellsHowManyNodesTouched) {
  const TiltResult result = raise(on_quartz(), law, stage({0.1 * megapascal}));
  EXPECT_NE(result.note.find("until " + std::to_string(result.probes.at(0).contacts) + " nodes touched"),
            std::string::npos)
      << result.note;
}

TEST(TiltHalfSpace, ProbesAreAveraged) {
  const SpecimenPair pair = on_quartz();
  const double one = *raise(pair, law, stage({30 * megapascal})).area_per_load,
               other = *raise(pair, law, stage({60 * megapascal})).area_per_load;
  EXPECT_DOUBLE_EQ(*raise(pair, law, stage({30 * megapascal, 60 * megapascal})).area_per_load,
                   (one + other) / 2);
}

TEST(TiltHalfSpace, AFlatIsSolvedOnceForAllTrials) {
  TiltTrialOptions options = stage({30 * megapascal});
  options.scatter = 0.1;
  const TiltResult result = raise(on_quartz(), law, options);
  EXPECT_EQ(result.trials.size(), 5U);
  EXPECT_EQ(result.probes.size(), 1U);
  EXPECT_GT(result.spread, 0);
}

TEST(TiltHalfSpace, ACapOfTheLawHoldsOnTheProbe) {
  const JunctionLaw capped({500 * megapascal, 0.2, 600 * megapascal, {}});
  EXPECT_LT(raise(on_quartz(), capped, stage({30 * megapascal})).angle,
            raise(on_quartz(), law, stage({30 * megapascal})).angle);
}

TEST(TiltHalfSpace, ProbesOutOfRangeAreNamed) {
  for (const double probe : {0.0, -1.0, std::nan("")})
    EXPECT_NE(error_of([&] { raise(on_quartz(), law, stage({probe})); }).find("`probe_pressure`"),
              std::string::npos);
}

}  // namespace
}  // namespace asperity::tilt_half_space_test
