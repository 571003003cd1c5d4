// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/generators/table_product.hpp"

namespace asperity::plane_waves_test {
namespace {

std::vector<PlaneWave> random_waves(int count, std::uint64_t seed) {
  const Stream stream(seed, "waves");
  std::vector<PlaneWave> waves;
  for (int k = 0; k < count; ++k) {
    const auto key = static_cast<std::uint64_t>(k) * 4;
    waves.push_back(
        {stream.bits(key), stream.bits(key + 1), stream.uniform(key + 2), 7 * stream.uniform(key + 3)});
  }
  return waves;
}

double direct(const std::vector<PlaneWave>& waves, int i, int j) {
  long double sum = 0;
  for (const PlaneWave& w : waves) {
    const std::uint64_t turns =
        w.step_x * static_cast<std::uint64_t>(i) + w.step_y * static_cast<std::uint64_t>(j);
    const long double angle = static_cast<long double>(turns) * 0x1p-63L * std::numbers::pi_v<long double>;
    sum += w.amplitude * std::cos(angle + w.phase);
  }
  return static_cast<double>(sum);
}

Field sum(const std::vector<PlaneWave>& waves, int nx, int ny) {
  return sum_of_plane_waves(nx, ny, waves, Monitor::silent(), "waves");
}

// With fused operations, most of these sums would differ in the last bit.
TEST(TableProduct, RoundsEachProductAndEachSum) {
  constexpr int rows = 2 * table_product::row_step, columns = 2 * table_product::column_step, depth = 100;
  const Stream stream(11, "tables");
  std::vector<double> left(rows * depth), right(columns * depth), sum(rows * columns), wanted(rows * columns);
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = stream.uniform(k) - .5;
  for (std::size_t k = 0; k < right.size(); ++k) right[k] = stream.uniform(left.size() + k) - .5;
  for (std::size_t place = 0; place < wanted.size(); ++place) {
    const std::size_t row = place % rows, column = place / rows;
    for (std::size_t k = 0; k < depth; ++k) {
      const volatile double product = left[k * rows + row] * right[k * columns + column];
      wanted[place] += product;
    }
  }
  table_product::add(rows, columns, depth, left.data(), rows, right.data(), columns, sum.data(), rows);
  EXPECT_EQ(sum, wanted);
}

// About twenty places, including both ends.
std::vector<int> probes(int n) {
  std::vector<int> places;
  for (int k = 0; k < n; k += std::max(1, n / 19)) places.push_back(k);
  if (places.back() != n - 1) places.push_back(n - 1);
  return places;
}

void expect_direct_sum(const std::vector<PlaneWave>& waves, int nx, int ny, double tolerance) {
  const Field field = sum(waves, nx, ny);
  ASSERT_EQ(field.nx(), nx);
  ASSERT_EQ(field.ny(), ny);
  for (const int j : probes(ny))
    for (const int i : probes(nx))
      ASSERT_NEAR(field(i, j), direct(waves, i, j), tolerance)
          << nx << " x " << ny << " at " << i << " " << j;
}

TEST(PlaneWaves, EqualTheDirectSumOnGridsOfAnyShape) {
  const std::vector<PlaneWave> waves = random_waves(40, 1);
  for (const auto& [nx, ny] :
       {std::pair{1, 1}, {1, 300}, {300, 1}, {2, 3}, {16, 16}, {17, 257}, {255, 31}, {521, 64}})
    expect_direct_sum(waves, nx, ny, 3e-14);
}

TEST(PlaneWaves, EqualTheDirectSumOverSeveralPasses) {
  expect_direct_sum(random_waves(257, 2), 61, 37, 2e-13);
  expect_direct_sum(random_waves(700, 3), 31, 29, 4e-13);
}

TEST(PlaneWaves, ReachTheLastCellOfTheLongestSide) { expect_direct_sum(random_waves(5, 4), 65536, 1, 1e-14); }

TEST(PlaneWaves, AddMirrorImagesRightly) {
  std::vector<PlaneWave> waves = random_waves(6, 5);
  for (int k = 0; k < 6; ++k) {
    PlaneWave w = waves[static_cast<std::size_t>(k)];
    w.phase += 1 + k;
    if (k % 3 != 1) w.step_x = 0 - w.step_x;
    if (k % 3 != 0) w.step_y = 0 - w.step_y;
    waves.push_back(w);
  }
  waves.push_back(waves.front());  // the same wave twice
  expect_direct_sum(waves, 40, 50, 2e-14);
}

TEST(PlaneWaves, TakeWavesAlongTheAxesAndStandingStill) {
  constexpr std::uint64_t half_turn = std::uint64_t{1} << 63;
  std::vector<PlaneWave> waves = random_waves(5, 6);
  waves[0].step_x = 0;
  waves[1].step_y = 0;
  waves[2].step_x = waves[2].step_y = 0;
  waves[3].step_x = half_turn;
  waves[4].step_x = half_turn + 1;
  expect_direct_sum(waves, 30, 41, 1e-14);
  expect_direct_sum({waves[0], waves[1], waves[2]}, 300, 270, 1e-14);
}

TEST(PlaneWaves, AreZeroWhenThereAreNone) {
  const Field field = sum({}, 3, 2);
  for (const double value : field.values()) EXPECT_EQ(value, 0);
}

TEST(PlaneWaves, AreTheSameBitsForAnyNumberOfThreads) {
  const std::vector<PlaneWave> waves = random_waves(300, 7);
  set_thread_count(1);
  const Field one = sum(waves, 517, 301);
  for (const int threads : {2, 5}) {
    set_thread_count(threads);
    const Field more = sum(waves, 517, 301);
    EXPECT_TRUE(std::ranges::equal(one.values(), more.values())) << threads;
  }
  set_thread_count(0);
}

TEST(PlaneWaves, StopWhenAsked) {
  stop_flag().raise(StopReason::interrupt);
  EXPECT_THROW(sum(random_waves(3, 8), 10, 10), Error);
  stop_flag().clear();
}

}  // namespace
}  // namespace asperity::plane_waves_test
