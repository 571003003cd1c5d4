// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/dimension_scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace asperity::line_fit_test {
namespace {

TEST(LineFit, FindsALineExactly) {
  const std::vector<double> x = {1, 2, 5, 9}, y = {5, 3, -3, -11};
  const LineFit fit = fit_line(x, y);
  EXPECT_DOUBLE_EQ(fit.slope, -2);
  EXPECT_DOUBLE_EQ(fit.intercept, 7);
  EXPECT_EQ(fit.slope_error, 0);
  EXPECT_EQ(fit.r_squared, 1);
}

// Residuals -1/6, 1/3, -1/6 about y = 7/6 + x/2.
TEST(LineFit, StatesItsScatter) {
  const std::vector<double> x = {0, 1, 2}, y = {1, 2, 2};
  const LineFit fit = fit_line(x, y);
  EXPECT_DOUBLE_EQ(fit.slope, 0.5);
  EXPECT_DOUBLE_EQ(fit.intercept, 7.0 / 6);
  EXPECT_NEAR(fit.slope_error, std::sqrt(1.0 / 12), 1e-15);
  EXPECT_NEAR(fit.r_squared, 0.75, 1e-15);
}

TEST(LineFit, OfALevelLineIsPerfect) {
  const std::vector<double> x = {0, 1, 2}, y = {4, 4, 4};
  EXPECT_EQ(fit_line(x, y).slope, 0);
  EXPECT_EQ(fit_line(x, y).r_squared, 1);
}

}  // namespace
}  // namespace asperity::line_fit_test
