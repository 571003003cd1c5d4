// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/profile_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/metrology/dimension_scaling.hpp"

namespace asperity::length_ratio_test {
namespace {

TEST(LengthRatio, HasItsKnownValues) {
  const double known[][2] = {
      {0.05, 1.00124767}, {0.3, 1.04246791}, {1, 1.35453081}, {3, 2.71005671}, {10, 8.12078261}};
  for (const auto& [slope, ratio] : known)
    EXPECT_NEAR(expected_length_ratio(slope), ratio, 0.5e-8 * (1 + 1e-6)) << slope;
}

// Slope s·d^(-1/2) at the spacings 1, 2, 4 … 1024; D = 1.5.
TEST(LengthRatio, ExplainsWhatTheLengthMethodFinds) {
  const double known[][3] = {
      {0.05, 1.00013, 5e-6}, {0.3, 1.00444, 5e-6}, {1, 1.0351, 5e-5}, {5, 1.2008, 5e-5}, {100, 1.4867, 5e-5}};
  for (const auto& [slope, D, half_digit] : known) {
    std::vector<double> x, y;
    for (int d = 1; d <= 1024; d *= 2) {
      x.push_back(std::log(static_cast<double>(d)));
      y.push_back(std::log(expected_length_ratio(slope / std::sqrt(static_cast<double>(d)))));
    }
    EXPECT_NEAR(1 - fit_line(x, y).slope, D, half_digit) << slope;
  }
}

TEST(LengthRatio, IsTheMeanOverGaussianSlopes) {
  const Stream stream(20, "slopes");
  const int n = 200000;
  for (const double s : {0.05, 1.0, 10.0}) {
    double sum = 0, squares = 0;
    for (int k = 0; k < n; ++k) {
      const double length = std::hypot(1, s * stream.normal(static_cast<std::uint64_t>(k)));
      sum += length;
      squares += length * length;
    }
    const double found = sum / n, deviation = std::sqrt(squares / n - found * found);
    EXPECT_NEAR(found, expected_length_ratio(s), 3 * deviation / std::sqrt(1.0 * n));
  }
}

TEST(LengthRatio, GoesOverIntoItsLimits) {
  EXPECT_EQ(expected_length_ratio(0), 1);
  EXPECT_EQ(expected_length_ratio(1e-200), 1);
  EXPECT_NEAR((expected_length_ratio(1e-4) - 1) / 0.5e-8, 1, 1e-7);
  EXPECT_NEAR(expected_length_ratio(1e8) / (1e8 * std::sqrt(2 / std::numbers::pi)), 1, 1e-14);
  EXPECT_NEAR(expected_length_ratio(1e200) / (1e200 * std::sqrt(2 / std::numbers::pi)), 1, 1e-15);
  EXPECT_TRUE(std::isinf(expected_length_ratio(std::numeric_limits<double>::infinity())));
}

// Bessel functions end at x = 25 (s = 0.1); the steep limit begins at s = 1e9.
TEST(LengthRatio, HasNoStepWhereItsFormulasMeet) {
  for (const double s : {0.1, 1e9}) {
    const double below = expected_length_ratio(s * (1 - 1e-13)),
                 above = expected_length_ratio(s * (1 + 1e-13));
    EXPECT_NEAR(above / below, 1, 5e-13) << s;
  }
}

TEST(LengthSensitivity, IsTheLogarithmicSlope) {
  for (const double s : {0.02, 0.099, 0.101, 0.5, 1.0, 4.0, 50.0}) {
    const double e = 1e-4;
    const double slope =
        (std::log(expected_length_ratio(s * (1 + e))) - std::log(expected_length_ratio(s * (1 - e)))) /
        (2 * e);
    EXPECT_NEAR(length_sensitivity(s), slope, 1e-7) << s;
  }
}

TEST(LengthSensitivity, RisesFromNothingToOne) {
  EXPECT_EQ(length_sensitivity(0), 0);
  EXPECT_NEAR(length_sensitivity(0.999e-3) / (0.999e-3 * 0.999e-3), 1, 3e-6);
  EXPECT_NEAR(length_sensitivity(1.001e-3) / (1.001e-3 * 1.001e-3), 1, 3e-6);
  EXPECT_NEAR(length_sensitivity(1.22), 0.5, 1e-3);
  EXPECT_NEAR(length_sensitivity(4.67), 0.9, 1e-3);
  EXPECT_EQ(length_sensitivity(1e300), 1);
}

}  // namespace
}  // namespace asperity::length_ratio_test
