// SPDX-License-Identifier: GPL-3.0-or-later
// Projection on bounds (exact) and load (a few ulps); loads of lines.
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/grid.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::load_projection_test {

namespace {

std::vector<double> wavy(std::size_t n) {
  std::vector<double> y(n);
  for (std::size_t k = 0; k < n; ++k) y[k] = std::sin(.7 * static_cast<double>(k)) - .4;
  return y;
}

TEST(LoadProjection, CarriesTheLoadAndShiftsTheInteriorAlike) {
  const std::vector<double> y = wavy(1000);
  for (const double upper : {.3, 1.0, std::numeric_limits<double>::infinity()})
    for (const double load : {1e-12, 1.0, 250.0, 299.9999}) {
      std::vector<double> p(y.size());
      ASSERT_TRUE(project_to_load(y, {}, upper, load, p));
      EXPECT_NEAR(block_sum(p), load, 1e-14 * load) << upper;
      double shift = std::numeric_limits<double>::quiet_NaN();
      for (std::size_t k = 0; k < p.size(); ++k) {
        ASSERT_TRUE(p[k] >= 0 && p[k] <= upper);
        if (p[k] > 0 && p[k] < upper) {
          if (std::isnan(shift)) shift = p[k] - y[k];
          EXPECT_NEAR(p[k] - y[k], shift, 1e-15);
        }
      }
    }
}

TEST(LoadProjection, LeavesUnmarkedNodesClippedOnly) {
  const std::vector<double> y = wavy(100);
  std::vector<std::uint8_t> where(100);
  for (std::size_t k = 0; k < 50; ++k) where[k] = 1;
  std::vector<double> p(100);
  ASSERT_TRUE(project_to_load(y, where, .5, 20, p));
  EXPECT_NEAR(block_sum(p), 20, 1e-13);
  for (std::size_t k = 50; k < 100; ++k) EXPECT_EQ(p[k], std::min(std::max(y[k], 0.0), .5));
}

TEST(LoadProjection, RefusesWhatTheMarkedNodesCannotCarry) {
  const std::vector<double> y = wavy(100);
  std::vector<std::uint8_t> where(100);
  std::vector<double> p(100, 7.0);
  EXPECT_FALSE(project_to_load(y, where, .5, 20, p));
  where[3] = 1;
  EXPECT_FALSE(project_to_load(y, where, .5, 49, p));
  EXPECT_FALSE(project_to_load(y, where, .5, 1e-3, p));
  // The others carry the whole load.
  EXPECT_FALSE(
      project_to_load(std::vector{.25, .5}, std::vector<std::uint8_t>{1, 0}, 1, .5, std::span(p).first(2)));
  for (const double value : p) EXPECT_EQ(value, 7.0);
}

TEST(LoadProjection, ReachesBothEnds) {
  const std::vector<double> y = wavy(64);
  std::vector<double> p(64);
  ASSERT_TRUE(project_to_load(y, {}, .25, 16, p));
  for (const double value : p) EXPECT_EQ(value, .25);
  ASSERT_TRUE(project_to_load(y, {}, .25, std::nextafter(16.0, 0.0), p));
  EXPECT_NEAR(block_sum(p), 16, 1e-13);
  ASSERT_TRUE(project_to_load(y, {}, .25, 1e-300, p));
  EXPECT_NEAR(block_sum(p) / 1e-300, 1, 1e-12);
}

// The load as a step of the shift: no shift carries it, and two neighbours enclose it.
TEST(LoadShift, NarrowsAStepToTwoNeighboursAndTriesNoShiftTwice) {
  for (const double step : {0.1, 1.0 / 3, 0.7, 0.75, std::nextafter(0.75, 1)}) {
    std::vector<double> tried;
    const LoadShift shift = find_load_shift(0, 1, 0, 1, 0, true, [&](double at) {
      tried.push_back(at);
      return LoadAtShift{at < step ? 0.0 : 2.0, 0, 0, at < step ? 0.0 : 2.0};
    });
    EXPECT_FALSE(shift.found);
    EXPECT_EQ(shift.high, step);
    EXPECT_EQ(shift.low, std::nextafter(step, 0));
    std::sort(tried.begin(), tried.end());
    EXPECT_EQ(std::adjacent_find(tried.begin(), tried.end()), tried.end()) << step;
  }
}

// A straight line from the load 3 at λ = 0 with two nodes inside: λ = (load - 3)/2, found in one step.
TEST(LoadShift, ANewtonStepSolvesAStraightLine) {
  for (const bool by_excess : {false, true}) {
    int passes = 0;
    const LoadShift shift = find_load_shift(-4, 4, 0, 8, 1, by_excess, [&](double at) {
      ++passes;
      return LoadAtShift{3 + 2 * at, 2, 1.5, 0.5};  // fixed 1, bound 0.5
    });
    EXPECT_TRUE(shift.found);
    EXPECT_EQ(shift.at, 2.5);
    EXPECT_EQ(passes, 2);
  }
}

// 1.00147e-13 is 451 ulps and a little.
TEST(LoadShift, IsFoundIfTheLoadIsRightToOnePartInTenToTheThirteenth) {
  constexpr double load = 1.00147, ulp = std::numeric_limits<double>::epsilon();
  for (const int ulps : {-452, -451, 451, 452}) {
    const LoadAtShift off{load + ulps * ulp, 0, 0, 0};
    EXPECT_EQ(find_load_shift(0, 1, 0, load, 0, false, [&](double) { return off; }).found,
              std::abs(ulps) == 451)
        << ulps;
  }
}

using namespace half_space_test;

LevelShape long_shape(int nx, int ny, double aspect) { return {nx, ny, aspect, Boundary::periodic, 1}; }

TEST(LineLoads, OnlyOnLongCells) {
  EXPECT_FALSE(keeps_line_loads(1));
  EXPECT_FALSE(keeps_line_loads(7.9));
  EXPECT_TRUE(keeps_line_loads(8));
  EXPECT_TRUE(keeps_line_loads(1.0 / 8));
  EXPECT_FALSE(keeps_line_loads(std::nextafter(8.0, 0)));
  EXPECT_FALSE(keeps_line_loads(std::nextafter(1.0 / 8, 1)));
}

TEST(LineLoads, AreThoseOfBeforeWherePressuresCanMove) {
  constexpr int nx = 12, ny = 7;
  constexpr double upper = 2;
  for (const double aspect : {100.0, 0.01}) {
    const Stream draws(3, "loads of lines");
    Array<double> before(nx * ny), settled(nx * ny);
    Array<std::uint8_t> where(nx * ny);
    for (std::size_t k = 0; k < before.size(); ++k) {
      before[k] = draws.uniform(k, -0.3, 2.2);
      settled[k] = std::clamp(before[k], 0.0, upper);
      where[k] = settled[k] > 0 && settled[k] < upper ? 1 : 0;
    }
    const Array<double> clipped = settled;
    keep_line_loads(long_shape(nx, ny, aspect), before, where, upper, settled);
    const bool rows = aspect > 1;
    for (int line = 0; line < (rows ? ny : nx); ++line) {
      double wanted = 0, found = 0;
      for (int i = 0; i < (rows ? nx : ny); ++i) {
        const auto k = static_cast<std::size_t>(rows ? line * nx + i : i * nx + line);
        wanted += before[k];
        found += settled[k];
        EXPECT_TRUE(settled[k] >= 0 && settled[k] <= upper) << k;
        if (where[k] == 0) {
          EXPECT_EQ(settled[k], clipped[k]) << k;
        }
      }
      EXPECT_NEAR(found, wanted, 1e-12) << line << " of " << aspect;
    }
  }
}

TEST(LineLoads, ALineThatPullsCarriesNothingAndOneWithinItsBoundsStays) {
  const Array<double> before = {-3, 1, 0.5, 0, 0.25, 0.5};
  Array<double> settled = {0, 1, 0.5, 0, 0.25, 0.5};
  keep_line_loads(long_shape(3, 2, 50), before, Array<std::uint8_t>{0, 1, 1, 0, 1, 1}, 2, settled);
  EXPECT_EQ(settled[1], 0);
  EXPECT_EQ(settled[2], 0);
  EXPECT_EQ(settled[4], 0.25);
  EXPECT_EQ(settled[5], 0.5);
}

// Regression: 619 transforms lengthwise on a free tile.
TEST(LineLoads, NoiseOnAFreeTileTakesFewPasses) {
  for (const double aspect : {1e-3, 1e3}) {
    const Stream draws(1, "noise");
    Field heights(96, 96);
    for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = draws.uniform(k, 0, 1e-7);
    const HalfSpaceProblem problem =
        problem_of(make_grid(96, 96, 1e-3, 1e-3 * aspect), std::move(heights), Boundary::free, 1e11, 1e-6);
    const HalfSpaceAnswer answer = solve(problem, 1e8);
    EXPECT_TRUE(answer.converged);
    EXPECT_LE(answer.iterations, 200) << aspect;
  }
}

}  // namespace

}  // namespace asperity::load_projection_test
