// SPDX-License-Identifier: GPL-3.0-or-later
// Student's t, F and normal distribution against closed forms and twenty digits (incomplete beta function
// with 50 digits).
#include "engine/statistics/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/error.hpp"

namespace asperity::distributions_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void expect_close(double value, double wanted, const char* what) {
  EXPECT_NEAR(value / wanted, 1, 1e-12) << what;
}

TEST(StudentT, FactorsOfWholeAndFractionalDegrees) {
  expect_close(student_t_factor(0.95, 1), 12.706204736174704646, "1");
  expect_close(student_t_factor(0.95, 2.5), 3.5746548420036832185, "2.5");
  expect_close(student_t_factor(0.95, 4), 2.7764451051977943578, "4");
  expect_close(student_t_factor(0.99, 7.3), 3.4510316556221852449, "7.3");
  expect_close(student_t_factor(0.2, 30), 0.25560536495191277249, "30");
  expect_close(student_t_factor(0.998, 0.5), 102849.11563017555403, "0.5");
  expect_close(student_t_factor(0.95, 1000), 1.962339080826408485, "1000");
  // Confidence over the density in the middle.
  for (const double confidence : {1e-300, 1e-9, 9e-7, 1.1e-6})
    expect_close(student_t_factor(confidence, 6), confidence * 8 / 15 * std::sqrt(6.0), "middle");
}

// Share q in each tail.
TEST(StudentT, ClosedFormsOfOneAndTwoDegrees) {
  for (const double q : {0.4999999, 0.4, 0.25, 0.1, 0x1p-10, 0x1p-30, 0x1p-50}) {
    const double one = q < 0.25 ? 1 / std::tan(std::numbers::pi * q) : std::tan(std::numbers::pi * (0.5 - q));
    expect_close(student_t_factor(1 - 2 * q, 1), one, "1");
    const double two = (1 - 2 * q) / std::sqrt(2 * q * (1 - q));
    expect_close(student_t_factor(1 - 2 * q, 2), two, "2");
  }
}

TEST(StudentT, EndsInTheNormalDistribution) {
  EXPECT_EQ(student_t_factor(0, 3), 0);
  EXPECT_EQ(student_t_factor(1, 3), infinite);
  expect_close(student_t_factor(0.95, infinite), 1.9599639845400542355, "normal");
  expect_close(student_t_factor(0.95, 1e13), 1.9599639845400542355, "1e13");
  EXPECT_THROW(student_t_factor(1.1, 3), Error);
  EXPECT_THROW(student_t_factor(std::nan(""), 3), Error);
  EXPECT_THROW(student_t_factor(0.9, 0), Error);
}

TEST(FisherF, SharesOfWholeAndFractionalDegrees) {
  expect_close(f_cdf(4.1028210151304013219, 2, 10), 0.95, "2, 10");
  expect_close(f_cdf(6.6933129540758406439, 1.5, 4.4), 0.95, "1.5, 4.4");
  expect_close(f_cdf(0.11516889456229307146, 3, 17), 0.05, "3, 17");
  expect_close(f_cdf(3.0787199815797877564, 5, 300), 0.99, "5, 300");
  expect_close(f_cdf(3.2351361382028832167, 100, 0.7), 0.5, "100, 0.7");
  // Many degrees need more digits inside.
  EXPECT_NEAR(f_cdf(1.029870644075269, 14, 1e9) / 0.58095712067664418, 1, 2e-11);
}

TEST(FisherF, IsTheSquareOfStudentsTAndItsOwnInverse) {
  for (const double degrees : {0.7, 4.0, 33.3, 1e6}) {
    const double t = student_t_factor(0.95, degrees);
    expect_close(f_cdf(t * t, 1, degrees), 0.95, "t²");
    for (const double f : {0.1, 0.9, 2.0})
      expect_close(f_cdf(f, degrees, 7) + f_cdf(1 / f, 7, degrees), 1, "inverse");
  }
  EXPECT_EQ(f_cdf(0, 2, 2), 0);
  expect_close(f_cdf(1e-300, 2, 2), 1e-300, "near nothing");
  EXPECT_EQ(f_cdf(infinite, 2, 2), 1);
  EXPECT_TRUE(std::isnan(f_cdf(std::nan(""), 2, 2)));
  EXPECT_THROW(f_cdf(1, 0, 2), Error);
}

TEST(Normal, Quantiles) {
  expect_close(normal_quantile(0.975), 1.9599639845400542355, "0.975");
  expect_close(normal_quantile(0.6), 0.2533471031357997988, "0.6");
  expect_close(normal_quantile(1e-10), -6.3613409024040562047, "1e-10");
  expect_close(normal_quantile(1 - 0x1p-20), 4.7630010342678139569, "1 - 2^-20");
  EXPECT_EQ(normal_quantile(0.5), 0);
}

}  // namespace
}  // namespace asperity::distributions_test
