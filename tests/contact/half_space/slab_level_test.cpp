// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts in slabs, one process. Several: tests/scripts/runner/spread.sh.
#include "engine/contact/elasticity/slabs/slab_level.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/slabs/slab_descent.hpp"
#include "engine/core/arithmetic/random.hpp"

namespace asperity::slab_level_test {
namespace {

Array<double> noise(std::size_t n, std::uint64_t seed) {
  const Stream stream(seed, "noise");
  Array<double> values(n);
  for (std::size_t k = 0; k < n; ++k) values[k] = stream.uniform(k) - 0.5;
  return values;
}

SlabLevel level_of(int nx, int ny, double aspect, const Array<double>& heights) {
  Team& team = Team::alone();
  return {team, {nx, ny, aspect}, heights, 0.25, 2, std::numeric_limits<double>::infinity(), 1};
}

double product(const Array<double>& a, const Array<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

TEST(SlabLevel, AppliesTheComplianceOfAWholeGrid) {
  for (const auto& [nx, ny] :
       {std::pair(48, 32), std::pair(33, 20), std::pair(7, 13), std::pair(1, 8), std::pair(6, 1)}) {
    const Array<double> p = noise(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 1);
    Array<double> expected(p.size()), gap(p.size());
    HalfSpaceCompliance(nx, ny, 1.3, Boundary::periodic).apply(p, expected);
    const Array<double> heights = noise(p.size(), 2);
    SlabLevel level = level_of(nx, ny, 1.3, heights);
    level.gap(p, gap);
    for (std::size_t k = 0; k < p.size(); ++k)
      EXPECT_NEAR(gap[k], expected[k] - (heights[k] - 0.25) * 2, 1e-12) << nx << " x " << ny << " at " << k;
    EXPECT_EQ(level.applications, 1);
  }
}

TEST(SlabLevel, ItsInverseIsOneButForTheMean) {
  const Array<double> heights(48 * 20), p = noise(heights.size(), 3);
  SlabLevel level = level_of(48, 20, 0.8, heights);
  Array<double> u(p.size()), back(p.size());
  level.apply([&](std::size_t k) { return p[k]; }, [&](std::size_t k, double v) { u[k] = v; });
  level.apply_inverse([&](std::size_t k) { return u[k]; }, [&](std::size_t k, double v) { back[k] = v; });
  double mean = 0;
  for (const double v : p) mean += v / static_cast<double>(p.size());
  for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(back[k], p[k] - mean, 1e-13);
}

TEST(SlabPreconditioner, IsSymmetricAndPositiveOnTheFreeSet) {
  for (const auto& [nx, ny] : {std::pair(24, 18), std::pair(9, 5), std::pair(2, 3)}) {
    const auto n = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
    const Array<double> heights(n);
    SlabLevel level = level_of(nx, ny, 1, heights);
    SlabPreconditioner preconditioner(level);
    const Array<double> choice = noise(n, 4);
    Array<std::uint8_t> free(n);
    for (std::size_t k = 0; k < n; ++k) free[k] = choice[k] > 0.1 ? 1 : 0;
    free[0] = 1;
    preconditioner.set_free(free);
    const auto applied = [&](const Array<double>& r) {
      preconditioner.apply([&](std::size_t k) { return r[k]; });
      Array<double> z(n);
      for (std::size_t k = 0; k < n; ++k) z[k] = free[k] != 0 ? preconditioner.values()[k] : 0.0;
      return z;
    };
    Array<double> a = noise(n, 5), b = noise(n, 6);
    for (std::size_t k = 0; k < n; ++k)
      if (free[k] == 0) a[k] = b[k] = 0;
    const Array<double> ma = applied(a), mb = applied(b);
    EXPECT_NEAR(product(ma, b), product(a, mb), 1e-13 * std::sqrt(product(ma, ma) * product(b, b)));
    EXPECT_GT(product(ma, a), 0);
  }
}

TEST(SlabPreconditioner, IsHalfTheWaveNumberWhereAllIsFree) {
  const int nx = 16, ny = 12;
  const Array<double> heights(nx * ny);
  SlabLevel level = level_of(nx, ny, 1, heights);
  SlabPreconditioner preconditioner(level);
  preconditioner.set_free(Array<std::uint8_t>(heights.size(), 1));
  const double q = 2 * std::numbers::pi * 3 / nx;
  preconditioner.apply([&](std::size_t k) { return std::cos(q * static_cast<double>(k % nx)); });
  for (std::size_t k = 0; k < heights.size(); ++k)
    EXPECT_NEAR(preconditioner.values()[k], 0.5 * q * std::cos(q * static_cast<double>(k % nx)), 1e-13);
}

TEST(SlabTransfer, IsThatOfAWholeGrid) {
  Team& team = Team::alone();
  for (const auto& [nx, ny] : {std::pair(128, 96), std::pair(101, 67), std::pair(70, 20)}) {
    const LevelShape fine{nx, ny, 1};
    const auto coarse = coarser(fine);
    ASSERT_TRUE(coarse);
    const Array<double> field = noise(fine.nodes(), 7);
    const Array<double> expected = restrict_to(fine, *coarse, field);
    const Array<double> found = restrict_slabs(team, team.slab(nx, ny), *coarse, field);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-15);
    Array<double> up(fine.nodes()), up_in_slabs(fine.nodes());
    prolong(*coarse, expected, 0.5, fine, up);
    prolong_slabs(team, *coarse, expected, 0.5, team.slab(nx, ny), up_in_slabs);
    for (std::size_t k = 0; k < up.size(); ++k) EXPECT_NEAR(up_in_slabs[k], up[k], 1e-15);
  }
}

}  // namespace
}  // namespace asperity::slab_level_test
