// SPDX-License-Identifier: GPL-3.0-or-later
// The random stream against published values and its moments.
#include "engine/core/arithmetic/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

namespace asperity::random_test {
namespace {

TEST(Random, SplitMixOfPublishedSeeds) {
  EXPECT_EQ(splitmix64(0, 0), 0xE220A8397B1DCDAFULL);
  EXPECT_EQ(splitmix64(0, 1), 0x6E789E6AA1B965F4ULL);
  EXPECT_EQ(splitmix64(0, 2), 0x06C45D188009454FULL);
  EXPECT_EQ(splitmix64(1234567, 0), 6457827717110365317ULL);
  EXPECT_EQ(splitmix64(1234567, 1), 3203168211198807973ULL);
}

// Phases of the Weierstrass–Mandelbrot surface, in turns.
TEST(Random, PhasesOfSeedOne) {
  EXPECT_DOUBLE_EQ(unit_interval(splitmix64(1, 0)), 0.5665615751722809);
  EXPECT_DOUBLE_EQ(unit_interval(splitmix64(1, 1)), 0.74578175726270124);
  EXPECT_DOUBLE_EQ(unit_interval(splitmix64(1, 9)), 0.79399660566230557);
  EXPECT_DOUBLE_EQ(unit_interval(splitmix64(1, 10)), 0.40414216905022571);
  EXPECT_DOUBLE_EQ(unit_interval(splitmix64(1, 1009)), 0.17650913360524823);
}

TEST(Random, UnitIntervalIsHalfOpen) {
  EXPECT_EQ(unit_interval(0), 0.0);
  EXPECT_EQ(unit_interval(~0ULL), 1.0 - 0x1p-53);
}

TEST(Random, DrawsDependOnSeedNameAndKeyOnly) {
  const Stream a(1, "dents");
  EXPECT_EQ(a.bits(7), Stream(1, "dents").bits(7));
  EXPECT_NE(a.bits(7), a.bits(8));
  EXPECT_NE(a.bits(7), Stream(2, "dents").bits(7));
  EXPECT_NE(a.bits(7), Stream(1, "dent").bits(7));
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    for (const char* name : {"a", "b", ""})
      for (std::uint64_t k = 0; k < 20; ++k) seen.insert(Stream(seed, name).bits(k));
  EXPECT_EQ(seen.size(), 50u * 3 * 20);
}

TEST(Random, UniformMoments) {
  const Stream stream(3, "moments");
  constexpr int n = 200000;
  double sum = 0, squares = 0, products = 0;
  for (int k = 0; k < n; ++k) {
    const double u = stream.uniform(k) - 0.5;
    sum += u;
    squares += u * u;
    products += u * (stream.uniform(k + 1) - 0.5);
  }
  const double sigma = 1 / std::sqrt(12.0 * n);
  EXPECT_LT(std::abs(sum / n), 4 * sigma);
  EXPECT_NEAR(squares / n, 1 / 12.0, 4 * std::sqrt(1 / 180.0 / n));
  EXPECT_LT(std::abs(products / n), 4 / 12.0 / std::sqrt(n));
}

TEST(Random, UniformBetweenBounds) {
  const Stream stream(3, "bounds");
  for (int k = 0; k < 1000; ++k) {
    const double u = stream.uniform(k, -2, 5);
    EXPECT_GE(u, -2);
    EXPECT_LT(u, 5);
    EXPECT_EQ(stream.uniform(k, 4, 4), 4);
  }
}

TEST(Random, BelowCoversItsRange) {
  const Stream stream(5, "below");
  int count[6] = {};
  constexpr int n = 60000;
  for (int k = 0; k < n; ++k) {
    const std::uint64_t draw = stream.below(k, 6);
    ASSERT_LT(draw, 6u);
    ++count[draw];
  }
  for (const int c : count) EXPECT_NEAR(c, n / 6.0, 4 * std::sqrt(n * 5 / 36.0));
  EXPECT_EQ(stream.below(0, 1), 0u);
}

TEST(Random, NormalMoments) {
  const Stream stream(7, "normal");
  constexpr int n = 200000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (int k = 0; k < n; ++k) {
    const double x = stream.normal(k);
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
  }
  EXPECT_LT(std::abs(m1 / n), 4 / std::sqrt(n));
  EXPECT_NEAR(m2 / n, 1, 4 * std::sqrt(2.0 / n));
  EXPECT_LT(std::abs(m3 / n), 4 * std::sqrt(15.0 / n));
  EXPECT_NEAR(m4 / n, 3, 4 * std::sqrt(96.0 / n));
}

}  // namespace
}  // namespace asperity::random_test
