// SPDX-License-Identifier: GPL-3.0-or-later
// The pyramid against the exact |q|/2: as a form, on single waves, odd sides and oblong cells.
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::half_order_pyramid_test {
namespace {

Field noise(int nx, int ny, std::uint64_t seed) {
  const Stream stream(seed, "pyramid test");
  Field field(nx, ny);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = stream.normal(k);
  return field;
}

Field applied(HalfOrderPyramid& pyramid, const Field& a) {
  std::transform(a.values().begin(), a.values().end(), pyramid.input().begin(),
                 [](double value) { return static_cast<float>(value); });
  Field b(a.nx(), a.ny());
  const auto result = pyramid.apply();
  std::copy(result.begin(), result.end(), b.values().begin());
  return b;
}

double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

// Extreme ratios of the pyramid's form to the exact form, by the power method.
std::pair<double, double> eigenvalue_range(int n) {
  HalfOrderPyramid pyramid(n, n, 1, Boundary::periodic);
  HalfSpaceCompliance compliance(n, n, 1, Boundary::periodic);
  const auto extreme = [&](double shift) {
    Field x = noise(n, n, 3);
    double value = 0;
    for (int step = 0; step < 150; ++step) {
      const double average = mean(x.values());
      for (double& v : x.values()) v -= average;
      Field y(n, n);
      const Field b = applied(pyramid, x);
      compliance.apply(b.values(), y.values());
      for (std::size_t k = 0; k < x.size(); ++k) y[k] -= shift * x[k];
      value = dot(x, y) / dot(x, x);
      const double size = std::sqrt(dot(y, y));
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = y[k] / size;
    }
    return value + shift;
  };
  const double greatest = extreme(0);
  return {extreme(greatest), greatest};
}

TEST(HalfOrderPyramid, IsSpectrallyCloseToHalfTheWaveNumber) {
  for (const int n : {64, 256}) {
    const auto [least, greatest] = eigenvalue_range(n);
    EXPECT_GT(least, 0.69) << n;
    EXPECT_LT(greatest, 1.32) << n;
    EXPECT_LT(least, greatest);
  }
}

// Coarse grids stretch the seam by up to two cells of a level.
TEST(HalfOrderPyramid, IsSpectrallyCloseOnOddSides) {
  for (const int n : {33, 63, 257, 261}) {
    const auto [least, greatest] = eigenvalue_range(n);
    EXPECT_GT(least, 0.5) << n;
    EXPECT_LT(greatest, 5) << n;
  }
}

TEST(HalfOrderPyramid, IsSymmetric) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free})
    for (const auto& [nx, ny] :
         {std::pair(64, 64), std::pair(96, 48), std::pair(51, 38), std::pair(67, 35), std::pair(1, 40)}) {
      HalfOrderPyramid pyramid(nx, ny, 1, boundary);
      const Field a = noise(nx, ny, 1), b = noise(nx, ny, 2);
      const Field pa = applied(pyramid, a), pb = applied(pyramid, b);
      EXPECT_NEAR(dot(a, pb), dot(b, pa), 1e-5 * std::sqrt(dot(a, a) * dot(pb, pb))) << nx << " x " << ny;
      EXPECT_GT(dot(a, pa), 0);
    }
}

TEST(HalfOrderPyramid, AConstantCostsNothingOnAPeriodicGrid) {
  for (const int n : {16, 64, 100, 33, 131}) {
    HalfOrderPyramid pyramid(n, n, 1, Boundary::periodic);
    const Field b = applied(pyramid, Field(n, n, 1.0));
    for (const double value : b.values()) EXPECT_NEAR(value, 0, 2e-6) << n;
  }
}

TEST(HalfOrderPyramid, AGridOfLongCellsIsTransformed) {
  struct Grid {
    int nx, ny;
    double aspect;
  };
  for (const Grid& grid : {Grid{64, 64, 3}, Grid{64, 32, 0.2}, Grid{17, 1, 1}}) {
    HalfOrderPyramid pyramid(grid.nx, grid.ny, grid.aspect, Boundary::periodic, 0.5);
    EXPECT_EQ(pyramid.transform_share(), 1);
    HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.aspect, Boundary::periodic);
    const Field a = noise(grid.nx, grid.ny, 1);
    Field exact(grid.nx, grid.ny);
    compliance.apply_inverse(a.values(), exact.values());
    const CostScope scope;
    const Field b = applied(pyramid, a);
    EXPECT_DOUBLE_EQ(scope.so_far().transforms, 1.0);
    const double size = std::sqrt(dot(exact, exact) / static_cast<double>(exact.size()));
    for (std::size_t k = 0; k < b.size(); ++k) ASSERT_NEAR(b[k], exact[k], 1e-5 * size + 1e-6);
  }
}

TEST(HalfOrderPyramid, TransformsOnlyTheCoarsestGrid) {
  HalfOrderPyramid pyramid(512, 512, 1, Boundary::periodic);
  EXPECT_LT(pyramid.transform_share(), 1e-3);
  const CostScope scope;
  applied(pyramid, Field(512, 512, 1.0));
  EXPECT_EQ(scope.so_far().transforms, 0);
  EXPECT_LT(HalfOrderPyramid(521, 521, 1, Boundary::periodic).transform_share(), 1e-3);
  EXPECT_LT(HalfOrderPyramid(1000, 1000, 1, Boundary::periodic).transform_share(), 0.02);
  EXPECT_LT(HalfOrderPyramid(511, 511, 1, Boundary::free).transform_share(), 0.01);
}

TEST(HalfOrderPyramid, AFreeRimIsNoNeighbour) {
  const int n = 45;
  HalfOrderPyramid pyramid(n, n, 1, Boundary::free);
  Field a(n, n);
  a(0, 20) = 1;
  const Field b = applied(pyramid, a);
  EXPECT_GT(b(0, 20), 0.5);
  EXPECT_LT(std::abs(b(n - 1, 20)), 1e-3);
}

TEST(HalfOrderPyramid, ThreadsDoNotChangeABit) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const Field a = noise(160, 224, 1);
    HalfOrderPyramid pyramid(160, 224, 1, boundary);
    set_thread_count(1);
    const Field alone = applied(pyramid, a);
    for (const int threads : {2, 3}) {
      set_thread_count(threads);
      const Field shared = applied(pyramid, a);
      for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(alone[k], shared[k]);
    }
    set_thread_count(0);
  }
}

}  // namespace
}  // namespace asperity::half_order_pyramid_test
