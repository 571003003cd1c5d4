// SPDX-License-Identifier: GPL-3.0-or-later
// The running sum in two doubles.
#include "engine/contact/elasticity/box/accumulator.hpp"

#include <gtest/gtest.h>

namespace asperity::accumulator_test {
namespace {

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
  big.add(small);
  big.add(-1);
  EXPECT_EQ(big.value(), 0x1p-60);
}

}  // namespace
}  // namespace asperity::accumulator_test
