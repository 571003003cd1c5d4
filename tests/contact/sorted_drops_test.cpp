// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over sorted heights against extended precision; radix sort around its smallest size.
#include "engine/contact/elasticity/box/sorted_drops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/contact/contacts.hpp"

namespace asperity::sorted_drops_test {

namespace {

std::vector<double> random_heights(std::size_t n, std::uint64_t seed) {
  const Stream stream(seed, "drops");
  std::vector<double> heights;
  for (std::size_t k = 0; k < n; ++k) heights.push_back(stream.normal(k));
  return heights;
}

long double plain(const std::vector<double>& heights, double d, int power, bool gaps) {
  const double peak = *std::max_element(heights.begin(), heights.end());
  long double sum = 0;
  for (const double h : heights) {
    const long double x =
        gaps ? static_cast<long double>(peak - h) - d : d - static_cast<long double>(peak - h);
    if (x > 0) sum += power == 2 ? x * x : x;
  }
  return sum;
}

TEST(SortedDrops, SumsAgreeWithPlainOnesAtEveryDepth) {
  for (const std::size_t n : {1UL, 2UL, 255UL, 256UL, 257UL, 512UL, 513UL, 5000UL}) {
    const std::vector<double> heights = random_heights(n, n);
    const SortedDrops drops(heights);
    for (std::size_t k = 0; k < n; k += n / 64 + 1)
      for (const double d :
           {drops.drops()[k], std::nextafter(drops.drops()[k], 100.0), drops.drops()[k] * 1.001 + 1e-9}) {
        const auto total = static_cast<double>(plain(heights, d, 1, false));
        EXPECT_NEAR(drops.shortening(d), total, 1e-15 * total * 8);
        const auto squares = static_cast<double>(plain(heights, d, 2, false));
        EXPECT_NEAR(drops.squared_shortening(d), squares, 1e-14 * squares);
        const auto gap = static_cast<double>(plain(heights, d, 1, true));
        EXPECT_NEAR(drops.remaining_gap(d), gap, 1e-15 * gap * 8);
        EXPECT_EQ(
            static_cast<std::ptrdiff_t>(drops.touched(d)),
            std::count_if(heights.begin(), heights.end(), [&](double h) { return drops.peak() - h < d; }));
      }
  }
}

TEST(SortedDrops, DepthInvertsShorteningAcrossBlocks) {
  for (const std::size_t n : {1UL, 3UL, 256UL, 257UL, 5000UL}) {
    const SortedDrops drops(random_heights(n, 7));
    for (double d = 1e-6; d < 20; d *= 1.3) EXPECT_NEAR(drops.depth(drops.shortening(d)), d, 1e-14 * d) << n;
  }
}

TEST(SortedDrops, DepthAtATouchedDropIsThatDrop) {
  const SortedDrops drops(random_heights(1000, 9));
  for (std::size_t k = 1; k < 1000; ++k) {
    const double d = drops.drops()[k];
    EXPECT_NEAR(drops.depth(drops.shortening(d)), d, 4e-16 * d);
  }
}

TEST(SortedDrops, ALonelySpikeDoesNotSpoilTheRest) {
  // Differences of large sums would cancel.
  std::vector<double> heights = {1};
  for (int k = 0; k < 3000; ++k) heights.push_back(1e-12 * k);
  const SortedDrops drops(heights);
  for (const double d : {1 - 2e-9, 1 - 1e-9, 1 - 1e-12, 1.0, 1 + 1e-9}) {
    const auto total = static_cast<double>(plain(heights, d, 1, false));
    EXPECT_NEAR(drops.shortening(d), total, 1e-14 * total);
    EXPECT_NEAR(drops.depth(total), d, 4e-16);
  }
}

TEST(SortedDrops, RmsIsAboutTheMean) {
  const SortedDrops drops(std::vector<double>{1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(drops.rms(), std::sqrt(1.25));
  EXPECT_EQ(SortedDrops(std::vector<double>{3, 3}).rms(), 0);
  EXPECT_EQ(SortedDrops(std::vector<double>{3}).peak_to_valley(), 0);
}

TEST(SortedDrops, BytesAreWhatIsHeld) {
  const std::vector<double> heights = random_heights(100000, 1);
  const std::int64_t before = memory::held();
  const SortedDrops drops(heights);
  EXPECT_EQ(memory::held() - before, SortedDrops::bytes(heights.size()));
}

TEST(AscendingSort, AgreesWithTheLibrary) {
  for (const std::size_t n : {0UL, 1UL, 2UL, 2047UL, 2048UL, 2049UL, 50000UL})
    for (const double spread : {0.0, 1.0, 300.0}) {
      const Stream stream(n, "sort");
      Array<double> values;
      for (std::size_t k = 0; k < n; ++k)
        values.push_back(stream.uniform(2 * k) * std::pow(10.0, spread * (stream.uniform(2 * k + 1) - 0.5)));
      Array<double> expected = values;
      std::sort(expected.begin(), expected.end());
      sort_ascending(values);
      EXPECT_EQ(values, expected) << n << " " << spread;
    }
}

TEST(AscendingSort, ManyEqualValuesAndExtremes) {
  Array<double> values;
  for (int k = 0; k < 5000; ++k) values.push_back(k % 3);
  values.push_back(std::numeric_limits<double>::max());
  values.push_back(std::numeric_limits<double>::denorm_min());
  Array<double> expected = values;
  std::sort(expected.begin(), expected.end());
  sort_ascending(values);
  EXPECT_EQ(values, expected);
  Array<double> same(5000, 0.7);
  sort_ascending(same);
  EXPECT_EQ(same, Array<double>(5000, 0.7));
}

TEST(Accumulator, KeepsWhatAPlainSumLoses) {
  Accumulator sum(1);
  double plain = 1;
  for (int k = 0; k < 1000000; ++k) {
    sum.add(1e-17);
    plain += 1e-17;
  }
  EXPECT_EQ(plain, 1);
  EXPECT_EQ(sum.value(), 1 + 1e-11);
  sum.add(-1);
  EXPECT_NEAR(sum.value(), 1e-11, 1e-26);
}

TEST(Accumulator, ProductsAreNotRounded) {
  const double a = 1 + 0x1p-30;
  Accumulator sum;
  sum.add_product(a, a);
  sum.add(-(1 + 0x1p-29));
  EXPECT_EQ(sum.value(), 0x1p-60);
}

TEST(Accumulator, SumsOfSumsKeepBothParts) {
  Accumulator big(1), small(0x1p-60);
  small.add(0x1p-120);
  big.subtract(small);
  big.add(-1);
  EXPECT_EQ(big.value(), -0x1p-60);
}

}  // namespace

}  // namespace asperity::sorted_drops_test
