// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/blocked_sums.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace asperity::blocked_sums_test {
namespace {

TEST(BlockedSums, AddEveryTermOnceAroundTheBlockSize) {
  for (const std::size_t n : {0u, 1u, 1023u, 1024u, 1025u, 65536u, 65537u}) {
    const auto [ones, indices] = blocked_sums<2>(n, [](std::size_t k) {
      return std::array{1.0, static_cast<double>(k)};
    });
    EXPECT_EQ(ones, static_cast<double>(n));
    EXPECT_EQ(indices, n == 0 ? 0 : 0.5 * static_cast<double>(n) * static_cast<double>(n - 1));
  }
}

TEST(ExactMean, IsExactForEqualValuesAndNeverOverflows) {
  const Array<double> same(1000, 0.1), huge(3, std::numeric_limits<double>::max());
  EXPECT_EQ(exact_mean(same, range(same)), 0.1);
  EXPECT_EQ(exact_mean(huge, range(huge)), std::numeric_limits<double>::max());
  const Array<double> ends = {-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  EXPECT_EQ(exact_mean(ends, range(ends)), 0);
  EXPECT_EQ(exact_mean({}, {}), 0);
}

TEST(ExactMean, KeepsItsDigitsOnAnOffset) {
  Array<double> values(1000, 1e9);
  values[500] += 1;
  EXPECT_DOUBLE_EQ(exact_mean(values, range(values)), 1e9 + 0.001);
}

TEST(ScaleExponent, BringsAValueUnderOne) {
  EXPECT_EQ(scale_exponent(1.0), 1);
  EXPECT_EQ(scale_exponent(0.75), 0);
  EXPECT_EQ(scale_exponent(0.0), 0);
  EXPECT_EQ(scale_exponent(std::numeric_limits<double>::denorm_min()), -1000);
  EXPECT_EQ(scale_exponent(std::numeric_limits<double>::max()), 1024);
}

}  // namespace
}  // namespace asperity::blocked_sums_test
