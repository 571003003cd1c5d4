// SPDX-License-Identifier: GPL-3.0-or-later
// Shuffles and conversions of 2, 4 and 8 doubles, on any processor.
#include "engine/core/arithmetic/register_vectors.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace asperity::register_vectors_test {
namespace {

using namespace register_vectors;

template <class Number, int count>
struct Kind {
  using Vector = typename Of<Number, count>::Vector;
  static constexpr int lanes = count;
};

template <class Kind>
class Shuffles : public ::testing::Test {};
using All = ::testing::Types<Kind<double, 2>, Kind<double, 4>, Kind<double, 8>, Kind<float, 4>,
                             Kind<float, 8>, Kind<float, 16>>;
TYPED_TEST_SUITE(Shuffles, All);

TYPED_TEST(Shuffles, TransposeExchangesRowsAndLanes) {
  constexpr int lanes = TypeParam::lanes;
  typename TypeParam::Vector x[lanes];
  for (int i = 0; i < lanes; ++i)
    for (int l = 0; l < lanes; ++l) x[i][l] = static_cast<float>(100 * i + l);
  transpose(x);
  for (int i = 0; i < lanes; ++i)
    for (int l = 0; l < lanes; ++l) EXPECT_EQ(x[i][l], 100 * l + i) << i << ", " << l;
}

TYPED_TEST(Shuffles, SeparateIsTheInverseOfInterleave) {
  constexpr int lanes = TypeParam::lanes;
  typename TypeParam::Vector a, b, low, high;
  for (int l = 0; l < lanes; ++l) {
    a[l] = static_cast<float>(l);
    b[l] = static_cast<float>(100 + l);
  }
  interleave(a, b, low, high);
  for (int k = 0; k < 2 * lanes; ++k)
    EXPECT_EQ(k < lanes ? low[k] : high[k - lanes], k % 2 == 0 ? k / 2 : 100 + k / 2) << k;
  separate(low, high, low, high);
  for (int l = 0; l < lanes; ++l) {
    EXPECT_EQ(low[l], a[l]);
    EXPECT_EQ(high[l], b[l]);
  }
}

template <class Kind>
class Conversions : public ::testing::Test {};
using Doubles = ::testing::Types<Kind<double, 2>, Kind<double, 4>, Kind<double, 8>>;
TYPED_TEST_SUITE(Conversions, Doubles);

// Rounding, unaligned addresses, untouched neighbours.
TYPED_TEST(Conversions, OfFloatsRoundAsACast) {
  constexpr int lanes = TypeParam::lanes;
  const double values[] = {1.0 / 3, -2.5e-40, 3e38, 1e39, -0.0, 16777217, 1e-50, -7};
  float floats[lanes + 2] = {};
  floats[lanes + 1] = 42;
  typename TypeParam::Vector vector;
  read(values, vector);
  write(vector, floats + 1);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(floats[l + 1], static_cast<float>(values[l])) << l;
  EXPECT_EQ(floats[0], 0);
  EXPECT_EQ(floats[lanes + 1], 42);
  read(floats + 1, vector);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(vector[l], static_cast<double>(floats[l + 1])) << l;
}

TYPED_TEST(Conversions, OfBytesTakeAllValues) {
  constexpr int lanes = TypeParam::lanes;
  std::uint8_t bytes[256 + 1], back[256 + 2] = {};
  for (int k = 0; k < 256; ++k) bytes[k + 1] = static_cast<std::uint8_t>(k);
  back[256 + 1] = 42;
  for (int k = 0; k < 256; k += lanes) {
    typename TypeParam::Vector vector;
    read(bytes + 1 + k, vector);
    for (int l = 0; l < lanes; ++l) ASSERT_EQ(vector[l], k + l);
    vector += 0.75;
    write(vector, back + 1 + k);
  }
  for (int k = 0; k < 256; ++k) ASSERT_EQ(back[k + 1], k);
  EXPECT_EQ(back[256 + 1], 42);
}

}  // namespace
}  // namespace asperity::register_vectors_test
