// SPDX-License-Identifier: GPL-3.0-or-later
// The extension along lines: values, transpose, and contacts on long cells.
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/cost.hpp"
#include "tests/contact/half_space/half_space_problems.hpp"

namespace asperity::residual_extension_test {
namespace {

using namespace half_space_test;

TEST(LineExtension, InterpolatesBetweenFreeNodesOfALine) {
  // Free nodes in rows of six: 2 and 5; none; 0.
  const Array<std::uint8_t> free = {0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
  Array<float> field = {0, 0, 3, 0, 0, 6, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0};
  LineExtension periodic(6, 3, Boundary::periodic, true);
  periodic.set_free(free);
  periodic.extend(field);
  const Array<float> wrapped = {5, 4, 3, 4, 5, 6, 7, 6.5f, 6, 6.5f, 7, 7.5f, 9, 9, 9, 9, 9, 9};
  for (std::size_t k = 0; k < field.size(); ++k) EXPECT_NEAR(field[k], wrapped[k], 1e-6) << k;
  LineExtension bounded(6, 3, Boundary::free, true);
  bounded.set_free(free);
  bounded.extend(field);
  EXPECT_EQ(field[0], 3);
  EXPECT_EQ(field[1], 3);
  EXPECT_NEAR(field[4], 5, 1e-6);
}

TEST(LineExtension, GatheringIsTheTranspose) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const bool along_x : {true, false})
      for (const double share : {.05, .5, 1.0}) {
        const int nx = 19, ny = 13;
        const std::size_t n = nx * ny;
        const Stream draws(7, "line extension");
        Array<std::uint8_t> free(n);
        Array<float> a(n), b(n);
        for (std::size_t k = 0; k < n; ++k) {
          free[k] = draws.uniform(3 * k, 0, 1) < share ? 1 : 0;
          a[k] = free[k] != 0 ? static_cast<float>(draws.uniform(3 * k + 1, -1, 1)) : 0.0f;
          b[k] = static_cast<float>(draws.uniform(3 * k + 2, -1, 1));
        }
        LineExtension lines(nx, ny, boundary, along_x);
        lines.set_free(free);
        Array<float> extended = a, gathered = b;
        lines.extend(extended);
        lines.gather(gathered);
        double left = 0, right = 0;
        for (std::size_t k = 0; k < n; ++k) {
          left += static_cast<double>(extended[k]) * b[k];
          right += static_cast<double>(a[k]) * gathered[k];
          if (free[k] == 0) {
            EXPECT_EQ(gathered[k], 0);
          }
        }
        EXPECT_NEAR(left, right, 1e-4 * (1 + std::abs(left)));
      }
}

TEST(LineExtension, NoiseAndWavesOnLongCells) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const double aspect : {1e-3, 1e-2, .1, 10.0, 100.0, 1000.0})
      for (const bool noise : {true, false})
        for (const double share : {.01, .3}) {
          const int n = 48;
          const Stream draws(11, "long cells");
          std::uint64_t next = 0;
          const Grid grid = make_grid(n, n, 1, aspect);
          const HalfSpaceProblem problem = problem_from(
              grid, boundary,
              [&](double x, double y) {
                return noise ? draws.uniform(next++, 0, 1e-4)
                             : 1e-4 * std::cos(4 * pi * x) * std::cos(2 * pi * y / aspect);
              },
              1, 1e-6);
          const double slope = problem.rms / std::min(grid.hx(), grid.hy());
          const CostScope scope;
          const HalfSpaceAnswer answer = solve(problem, share * slope);
          const std::string scene = std::string(name(boundary)) + ", 1:" + std::to_string(aspect) +
                                    (noise ? ", noise, " : ", waves, ") + std::to_string(share);
          EXPECT_TRUE(answer.converged) << scene;
          EXPECT_LE(scope.so_far().transforms, 400) << scene;
        }
}

}  // namespace
}  // namespace asperity::residual_extension_test
