// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of lines: what a shift brings back, what it cannot, and contacts that need it.
#include "engine/contact/elasticity/half_space/solver/line_loads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/core/arithmetic/random.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::line_loads_test {
namespace {

using namespace half_space_test;

LevelShape long_shape(int nx, int ny, double aspect) { return {nx, ny, aspect, Boundary::periodic, 1}; }

TEST(LineLoads, OnlyOnLongCells) {
  EXPECT_FALSE(keeps_line_loads(1));
  EXPECT_FALSE(keeps_line_loads(7.9));
  EXPECT_TRUE(keeps_line_loads(8));
  EXPECT_TRUE(keeps_line_loads(1.0 / 8));
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

// Entry V2: lengthwise on a free tile it took 619 transforms.
TEST(LineLoads, V2_NoiseOnAFreeTileTakesFewPasses) {
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
}  // namespace asperity::line_loads_test
