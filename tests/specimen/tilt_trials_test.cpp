// SPDX-License-Identifier: GPL-3.0-or-later
// Trials on the tilt stage: repeats, placements, scatter, specimen area.
#include "engine/specimen/tilt_trials.hpp"

#include <cmath>
#include <numbers>

#include "tests/contact/contacts.hpp"

namespace asperity::tilt_trials_test {
namespace {

using test::error_of;
using test::random_surface;
using test::scene_of;

constexpr double degree = std::numbers::pi / 180;

SpecimenPair on_flat() { return SpecimenPair(scene_of(random_surface(40, 40, 1), rigid_material(), 3.0)); }
SpecimenPair on_rough() {
  return SpecimenPair(
      scene_of(random_surface(40, 40, 1), random_surface(40, 40, 2), 3.0, Boundary::periodic));
}

TiltTrialOptions light() {
  TiltTrialOptions options;
  options.stage.mass = 0.01;
  return options;
}

TEST(TiltTrials, ProportionalFrictionGivesItsAngle) {
  const TiltResult t = raise(on_flat(), JunctionLaw({.tau0 = 0, .alpha = 0.5}), light());
  EXPECT_TRUE(t.slipped);
  EXPECT_NEAR(t.angle, std::atan(0.5), 1e-12);
  EXPECT_NEAR(t.held, 26.5 * degree, 1e-12);
  EXPECT_EQ(t.mu, std::tan(t.held));
  EXPECT_EQ(t.trials.size(), 5U);
}

TEST(TiltTrials, TheBalanceHoldsAtTheExactAngle) {
  SpecimenPair pair = on_flat();
  const JunctionLaw law({.tau0 = 0.5, .alpha = 0.2, .tau_max = 0.9});
  const TiltResult t = raise(pair, law, light());
  ASSERT_TRUE(t.slipped);
  const double weight = 0.01 * 9.81;
  auto left = [&](double angle) {
    return law.on(pair.press({PressBy::load, weight * std::cos(angle), {}})).force - weight * std::sin(angle);
  };
  EXPECT_GE(left(t.angle), 0);
  EXPECT_LT(left(t.angle + 1e-12), 0);
}

const std::string one_pair = "`spread` covers trials on one pair of faces, not other seeds or specimens";

TEST(TiltTrials, OnAFlatTrialsAreTheSameWithoutScatter) {
  const TiltResult t = raise(on_flat(), JunctionLaw({.tau0 = 0.1, .alpha = 0.2}), light());
  for (const SlipAngle& trial : t.trials) EXPECT_EQ(trial.angle, t.angle);
  EXPECT_EQ(t.spread, 0);
  EXPECT_EQ(t.note, "the counter-body is flat and `scatter` is 0: all trials are the same; " + one_pair);
}

TEST(TiltTrials, ScatterSpreadsTheTrialsAsAsked) {
  TiltTrialOptions options = light();
  options.scatter = 0.05;
  options.repeats = 200;
  options.stage.step = 0.05 * degree;
  const JunctionLaw law({.tau0 = 0, .alpha = 0.5});
  const TiltResult t = raise(on_flat(), law, options);
  EXPECT_NEAR(t.spread, 0.05 * 0.5, 4 * 0.05 * 0.5 / std::sqrt(400));
  EXPECT_NEAR(t.mu, 0.5, 4 * 0.05 * 0.5 / std::sqrt(200));
  EXPECT_EQ(t.note, "the counter-body is flat: trials differ only by `scatter`; " + one_pair);
  EXPECT_EQ(raise(on_flat(), law, options).angle, t.angle);
  options.seed = 2;
  EXPECT_NE(raise(on_flat(), law, options).angle, t.angle);
}

TEST(TiltTrials, ARoughCounterBodyIsPutDownAfresh) {
  SpecimenPair pair = on_rough();
  const LatticeIsometry home = pair.placement();
  const TiltResult t = raise(pair, JunctionLaw({.tau0 = 2, .alpha = 0.2}), light());
  EXPECT_NE(t.trials[0].angle, t.trials[1].angle);
  EXPECT_GT(t.spread, 0);
  EXPECT_EQ(t.note, one_pair);
  EXPECT_EQ(pair.placement(), home);
}

TEST(TiltTrials, AWeightOnFewNodesIsToldOf) {
  TiltTrialOptions options = light();
  options.stage.mass *= 1e-9;
  const TiltResult t = raise(on_rough(), JunctionLaw({.tau0 = 0, .alpha = 0.2}), options);
  EXPECT_EQ(t.note.find("the weight rests on "), 0U) << t.note;
  EXPECT_NE(t.note.find(" only, so mu depends on the cells"), std::string::npos) << t.note;
}

TEST(TiltTrials, MoreTrialsKeepTheFirstOnes) {
  TiltTrialOptions options = light();
  const JunctionLaw law({.tau0 = 2, .alpha = 0.2});
  options.repeats = 2;
  const TiltResult two = raise(on_rough(), law, options);
  options.repeats = 4;
  const TiltResult four = raise(on_rough(), law, options);
  EXPECT_EQ(two.trials[0].angle, four.trials[0].angle);
  EXPECT_EQ(two.trials[1].angle, four.trials[1].angle);
}

TEST(TiltTrials, ASpecimenThatNeverSlipsIsSaidPlainly) {
  const TiltResult t = raise(on_flat(), JunctionLaw({.tau0 = 1e6, .alpha = 0.2}), light());
  EXPECT_FALSE(t.slipped);
  EXPECT_EQ(t.angle, 0.5 * std::numbers::pi);
  EXPECT_TRUE(std::isinf(t.mu));
  EXPECT_EQ(t.spread, 0);
  EXPECT_EQ(t.note.find("does not slip up to 90 deg: mu is a lower bound"), 0U);
  TiltTrialOptions low = light();
  low.stage.limit = 10 * degree;
  const TiltResult bound = raise(on_flat(), JunctionLaw({.tau0 = 0, .alpha = 0.2}), low);
  EXPECT_FALSE(bound.slipped);
  EXPECT_NEAR(bound.mu, std::tan(10 * degree), 1e-15);
}

TEST(TiltTrials, SpecimenAreaTurnsWeightIntoPressure) {
  // Nine tiles with nine times the mass.
  TiltTrialOptions large = light();
  large.specimen_area = 9;
  large.stage.mass = 0.09;
  const JunctionLaw law({.tau0 = 0.5, .alpha = 0.2});
  EXPECT_NEAR(raise(on_flat(), law, large).angle, raise(on_flat(), law, light()).angle, 1e-12);
  large.stage.mass = 0.01;
  EXPECT_NE(raise(on_flat(), law, large).angle, raise(on_flat(), law, light()).angle);
}

TEST(TiltTrials, BadOptionsAreRefusedByName) {
  const JunctionLaw law({.tau0 = 0.5, .alpha = 0.2});
  TiltTrialOptions bad = light();
  bad.repeats = 0;
  EXPECT_EQ(error_of([&] { raise(on_flat(), law, bad); }),
            "`repeats` is 0; give a whole number from 1 to 100000");
  bad = light();
  bad.scatter = -0.1;
  EXPECT_EQ(error_of([&] { raise(on_flat(), law, bad); }).find("`scatter` is -0.1"), 0U);
  bad = light();
  bad.specimen_area = 0;
  EXPECT_EQ(error_of([&] { raise(on_flat(), law, bad); }).find("`specimen_area` is 0 m^2"), 0U);
  bad = light();
  bad.stage.mass = -1;
  EXPECT_EQ(error_of([&] { raise(on_flat(), law, bad); }).find("`mass` is -1 kg"), 0U);
}

}  // namespace
}  // namespace asperity::tilt_trials_test
