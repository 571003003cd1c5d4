// SPDX-License-Identifier: GPL-3.0-or-later
// The slip angle for T = T0 + αN, steps, jumps of friction, the right angle.
#include "engine/friction/tilt_stage.hpp"

#include <cmath>
#include <limits>

#include "tests/contact/contacts.hpp"

namespace asperity::tilt_stage_test {
namespace {

using test::error_of;

constexpr double degree = std::numbers::pi / 180;
constexpr double right = 0.5 * std::numbers::pi;

FrictionForce line(double constant, double alpha) {
  return [=](double normal) { return constant + alpha * normal; };
}

TEST(SlipAngle, ConstantPlusProportionalFriction) {
  for (const auto& [constant, alpha, expected] : {std::tuple{0.3, 0.2, 28.417958}, {0.9, 0.1, 69.287628}}) {
    const double exact = std::asin(constant / std::sqrt(1 + alpha * alpha)) + std::atan(alpha);
    const SlipAngle slip = slip_angle(line(constant, alpha), 1, 0.1 * degree, right);
    EXPECT_TRUE(slip.slipped);
    EXPECT_NEAR(slip.angle, exact, 1e-12);
    EXPECT_NEAR(slip.angle / degree, expected, 5e-7);
    EXPECT_NEAR(slip.held / degree, std::floor(exact / degree * 10) / 10, 1e-9);
  }
}

// T0 > W.
TEST(SlipAngle, TooMuchFrictionNeverSlips) {
  const SlipAngle slip = slip_angle(line(1.1, 0.1), 1, 0.1 * degree, right);
  EXPECT_FALSE(slip.slipped);
  EXPECT_EQ(slip.angle, right);
  EXPECT_EQ(slip.held, right);
}

TEST(SlipAngle, ScalesWithTheWeight) {
  for (const double weight : {1e-6, 1.0, 1e9})
    EXPECT_NEAR(slip_angle(line(0.3 * weight, 0.2), weight, 0.1 * degree, right).angle / degree, 28.417958,
                5e-7);
}

TEST(SlipAngle, TheStepChangesOnlyWhatIsHeld) {
  const double exact = slip_angle(line(0, 0.5), 1, 0.1 * degree, right).angle;
  EXPECT_NEAR(exact, std::atan(0.5), 1e-15);
  for (const double step : {0.001, 0.7, 1.0, 7.0, 26.0}) {
    const SlipAngle slip = slip_angle(line(0, 0.5), 1, step * degree, right);
    EXPECT_NEAR(slip.angle, exact, 1e-12);
    EXPECT_NEAR(slip.held / degree, std::floor(26.565051177078 / step) * step, 1e-9) << step;
  }
}

// A step of 1 rad instead of 1 deg must not give a coefficient of 0.
TEST(SlipAngle, AStepAboveTheAngleOfSlipIsAnError) {
  for (const double step : {27.0 * degree, 1.0, 90.0 * degree})
    EXPECT_NE(error_of([&] {
                slip_angle(line(0, 0.5), 1, step, right);
              }).find("above the angle of slip of 26.5651 deg: no step would be held"),
              std::string::npos)
        << step;
  EXPECT_EQ(slip_angle(line(0, 0), 1, degree, right).held, 0);
  EXPECT_GT(slip_angle(line(0, 0.5), 1, std::atan(0.5) * (1 - 1e-12), right).held, 0);
}

TEST(SlipAngle, StepsDoNotPileUpRounding) {
  const SlipAngle slip = slip_angle(line(0, std::tan(80 * degree)), 1, 0.1 * degree, right);
  EXPECT_GE(slip.held, 799 * (0.1 * degree));
  EXPECT_NEAR(slip.angle, 80 * degree, 1e-13);
  const SlipAngle later = slip_angle(line(0, std::tan(80.05 * degree)), 1, 0.1 * degree, right);
  EXPECT_EQ(later.held, 800 * (0.1 * degree));
}

TEST(SlipAngle, NoFrictionSlipsAtTheFirstStep) {
  const SlipAngle slip = slip_angle(line(0, 0), 1, 0.1 * degree, right);
  EXPECT_TRUE(slip.slipped);
  EXPECT_EQ(slip.held, 0);
  EXPECT_NEAR(slip.angle, 0, 1e-300);
}

TEST(SlipAngle, ProportionalFrictionSlipsBeforeTheRightAngle) {
  const SlipAngle slip = slip_angle(line(0, 1e9), 1, 0.1 * degree, right);
  EXPECT_TRUE(slip.slipped);
  EXPECT_NEAR(slip.angle, std::atan(1e9), 1e-12);
  EXPECT_NEAR(slip.held / degree, 89.9, 1e-9);
}

TEST(SlipAngle, AtTheRightAngleTheNormalForceIsStillPositive) {
  double least = 1;
  slip_angle(
      [&](double normal) {
        least = std::min(least, normal);
        return 2.0;
      },
      1, degree, right);
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 1e-15);
}

TEST(SlipAngle, ALimitThatIsNoMultipleIsReached) {
  const SlipAngle holds = slip_angle(line(0, std::tan(25.25 * degree)), 1, degree, 25.2 * degree);
  EXPECT_FALSE(holds.slipped);
  EXPECT_EQ(holds.held, 25.2 * degree);
  const SlipAngle slips = slip_angle(line(0, std::tan(25.15 * degree)), 1, degree, 25.2 * degree);
  EXPECT_TRUE(slips.slipped);
  EXPECT_NEAR(slips.held, 25 * degree, 1e-15);
}

TEST(SlipAngle, AJumpOfFrictionIsWhereItFails) {
  // Real area falls by one node at N = 0.8: acos 0.8.
  const auto friction = [](double normal) { return normal > 0.8 ? 0.7 : 0.1; };
  const SlipAngle slip = slip_angle(friction, 1, 0.1 * degree, right);
  EXPECT_NEAR(slip.angle, std::acos(0.8), 1e-12);
  EXPECT_NEAR(slip.held / degree, 36.8, 1e-9);
}

TEST(SlipAngle, EveryStepOfTheStageIsSolved) {
  int calls = 0;
  slip_angle(
      [&](double) {
        ++calls;
        return 2.0;
      },
      1, 0.1 * degree, right);
  EXPECT_EQ(calls, 901);
}

TEST(SlipAngle, BadNumbersAreRefusedByName) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  TiltOptions good;
  good.mass = 4.3e-3;
  EXPECT_EQ(error_of([&] { check(good); }), "");
  TiltOptions bad = good;
  bad.mass = 0;
  EXPECT_EQ(error_of([&] { check(bad); }), "`mass` is 0 kg; give a finite value above zero");
  bad = good;
  bad.gravity = -1;
  EXPECT_EQ(error_of([&] { check(bad); }), "`gravity` is -1 m/s^2; give a finite value above zero");
  bad = good;
  bad.limit = 91 * degree;
  EXPECT_EQ(error_of([&] { check(bad); }), "`limit` is 91 deg; a stage is raised to at most 90 deg");
  bad = good;
  bad.step = 1e-8 * degree;
  EXPECT_NE(error_of([&] { check(bad); }).find("over a million steps to the `limit` of 90 deg"),
            std::string::npos);
  bad = good;
  bad.step = 0;
  EXPECT_EQ(error_of([&] { check(bad); }), "`step` is 0 rad; give a finite value above zero");
  EXPECT_NE(error_of([&] {
              slip_angle([](double) { return -1.0; }, 1, degree, right);
            }).find("the friction force at 0 deg is -1 N"),
            std::string::npos);
  EXPECT_NE(error_of([&] { slip_angle([](double) { return inf; }, 1, degree, right); }), "");
}

}  // namespace
}  // namespace asperity::tilt_stage_test
