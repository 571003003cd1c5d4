// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements far below the roughness; cases from random scenes.
#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"

#include <gtest/gtest.h>

#include "engine/contact/elasticity/half_space/solver/free_set.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::nested_descent_test {
namespace {

using namespace half_space_test;

class LightContactOn : public testing::TestWithParam<Boundary> {};

// A certificate relative to the rms height would accept one peak.
TEST_P(LightContactOn, EqualPeaksShareTheLeastLoadEqually) {
  Field h(33, 21, -1.0);
  h(4, 10) = h(20, 10) = 0;
  for (const double pressure : {1e-3, 1e-9, 1e-30, 1e-120, 1e-270}) {
    const HalfSpaceAnswer answer =
        solve(problem_of(make_grid(33, 21, 1, 1), h, GetParam(), 1, 1e-6), pressure);
    EXPECT_EQ(answer.contacts, 2) << pressure;
    // Symmetric rims; measured 2e-7.
    EXPECT_NEAR(answer.pressure(4, 10) / answer.pressure(20, 10), 1, 1e-6) << pressure;
  }
}

TEST_P(LightContactOn, AreaDoesNotFallAsTheLoadRises) {
  Field h(9, 4);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i) h(i, j) = .03;
  const HalfSpaceProblem problem = problem_of(make_grid(9, 4, 9, 84.6), h, GetParam(), 1, 1e-6);
  for (const double pressure : {1e-14, 3.7e-10, 5.7e-10, 1e-6})
    EXPECT_EQ(solve(problem, pressure).contacts, 12) << pressure;
}

// Hardness below the rounding of the heights.
TEST_P(LightContactOn, SoftGroundTouchesOnLoadOverHardness) {
  for (const double hardness : {1e-9, 1e-12, 1e-15, 1e-30, 1e-100, 1e-250}) {
    HalfSpaceProblem problem = problem_from(
        make_grid(32, 32, 1, 1), GetParam(),
        [](double x, double y) {
          return .01 * (std::cos(2 * std::numbers::pi * x) * std::cos(2 * std::numbers::pi * y));
        },
        1, 1e-10);
    problem.yield.cap = hardness;
    const HalfSpaceAnswer answer = solve(problem, .3 * hardness);
    EXPECT_TRUE(answer.converged) << hardness;
    EXPECT_GE(area_fraction(answer), .3) << hardness;
    EXPECT_NEAR(area_fraction(answer), .3, .02) << hardness;
    // Equal heights share the rest: symmetric about the diagonal. Below 1e-15 rounding hides this.
    if (hardness < 1e-15) continue;
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i)
        ASSERT_NEAR(answer.pressure(i, j), answer.pressure(j, i), 1e-9 * hardness)
            << hardness;  // measured 5e-11
  }
}
INSTANTIATE_TEST_SUITE_P(Boundaries, LightContactOn, testing::Values(Boundary::periodic, Boundary::free),
                         [](const auto& boundary) { return std::string(name(boundary.param)); });

TEST(LoadProjection, KeepsALoadFarBelowTheRoundingOfTheValues) {
  const std::vector<double> values = {-1, 1, 1, 1, .5, -2};
  for (const double upper : {1e-13, 1e-30, 1e-200})
    for (const double part : {.5, 2.25, 3.5, 4.75}) {
      std::vector<double> target(values.size());
      ASSERT_TRUE(project_to_load(values, {}, upper, part * upper, target));
      double sum = 0;
      for (const double p : target) {
        EXPECT_TRUE(p >= 0 && p <= upper);
        sum += p;
      }
      EXPECT_NEAR(sum / upper, part, 1e-14);
      EXPECT_EQ(target[1], target[2]);
    }
}

// One elastic node must not balance the load of hundreds: thousands of steps instead of a hundred.
TEST(FreeSet, FewElasticNodesDoNotBalanceTheLoadOfManyThatYield) {
  FreeSet set;
  set.elastic_count = 1;
  set.yielding_count = 500;
  set.yielding_worth = .004;
  EXPECT_EQ(set.balancing(), yielding);
  EXPECT_EQ(set.balancing_count(), 500);
  set.elastic_count = 2;
  EXPECT_EQ(set.balancing(), elastic);
  set.yielding_worth = 0;  // a cap: its nodes take nothing
  set.elastic_count = 1;
  EXPECT_EQ(set.balancing(), elastic);
  set.elastic_count = 0;
  EXPECT_EQ(set.balancing(), yielding);
}

}  // namespace
}  // namespace asperity::nested_descent_test
