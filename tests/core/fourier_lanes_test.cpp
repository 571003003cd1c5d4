// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms in lanes against the defining sum.
#include "engine/core/fourier/fourier_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"

namespace asperity::fourier_lanes_test {
namespace {

template <class Real>
class InLanes : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(InLanes, Precisions);

template <class Real>
Array<typename Lanes<Real>::Complex> noise(int n) {
  const Stream stream(1, "lanes");
  Array<typename Lanes<Real>::Complex> values(static_cast<std::size_t>(n));
  std::uint64_t k = 0;
  for (auto& value : values)
    for (int l = 0; l < Lanes<Real>::count; ++l) {
      value.re[l] = static_cast<Real>(stream.normal(k++));
      value.im[l] = static_cast<Real>(stream.normal(k++));
    }
  return values;
}

constexpr int lengths[] = {1,   2,   3,   4,   5,   6,  7,  8,  9,  14, 16, 21, 25,  32,  49,  60, 64,
                           105, 128, 210, 343, 512, 11, 13, 17, 19, 23, 29, 31, 143, 374, 527, 957};

TYPED_TEST(InLanes, BinsAreTheSumOfTheDefinition) {
  using Real = TypeParam;
  for (const int n : lengths) {
    const LaneFourier<Real> fourier(n);
    EXPECT_EQ(fourier.length(), n);
    const auto in = noise<Real>(n);
    auto out = in;
    fourier.forward(out.data());
    for (int l = 0; l < Lanes<Real>::count; ++l)
      for (int k = 0; k < n; ++k) {
        std::complex<long double> sum = 0;
        for (int j = 0; j < n; ++j) {
          const auto& value = in[static_cast<std::size_t>(j)];
          const long double angle = -2 * std::numbers::pi_v<long double> * (j * k % n) / n;
          sum += std::complex<long double>(value.re[l], value.im[l]) * std::polar(1.0L, angle);
        }
        const auto& bin = out[static_cast<std::size_t>(fourier.place(k))];
        const auto error =
            static_cast<double>(std::abs(std::complex<long double>(bin.re[l], bin.im[l]) - sum));
        ASSERT_LE(error, 16 * std::sqrt(n) * static_cast<double>(std::numeric_limits<Real>::epsilon()))
            << n << ", bin " << k << ", lane " << l;
      }
  }
}

TYPED_TEST(InLanes, ThereAndBackIsTheLength) {
  using Real = TypeParam;
  for (const int n : {1, 2, 12, 105, 1024, 1250}) {
    const LaneFourier<Real> fourier(n);
    const auto in = noise<Real>(n);
    auto out = in;
    fourier.forward(out.data());
    fourier.inverse(out.data());
    for (std::size_t k = 0; k < in.size(); ++k)
      for (int l = 0; l < Lanes<Real>::count; ++l) {
        const Real tolerance = 16 * std::numeric_limits<Real>::epsilon() * static_cast<Real>(n);
        ASSERT_NEAR(out[k].re[l], in[k].re[l] * static_cast<Real>(n), tolerance) << n;
        ASSERT_NEAR(out[k].im[l], in[k].im[l] * static_cast<Real>(n), tolerance) << n;
      }
  }
}

TYPED_TEST(InLanes, PlacesAreAPermutation) {
  for (const int n : lengths) {
    const LaneFourier<TypeParam> fourier(n);
    std::vector<int> places;
    for (int k = 0; k < n; ++k) places.push_back(fourier.place(k));
    std::sort(places.begin(), places.end());
    for (int k = 0; k < n; ++k) ASSERT_EQ(places[static_cast<std::size_t>(k)], k);
  }
}

TYPED_TEST(InLanes, LanesAreIndependent) {
  using Real = TypeParam;
  const int n = 660, last = Lanes<Real>::count - 1;
  const LaneFourier<Real> fourier(n);
  auto all = noise<Real>(n), one = all;
  for (auto& value : one)
    for (int l = 0; l < last; ++l) value.re[l] = value.im[l] = std::numeric_limits<Real>::quiet_NaN();
  fourier.forward(all.data());
  fourier.forward(one.data());
  for (std::size_t k = 0; k < all.size(); ++k) {
    ASSERT_EQ(all[k].re[last], one[k].re[last]);
    ASSERT_EQ(all[k].im[last], one[k].im[last]);
  }
}

TEST(LaneFourier, OneSignalAloneHasTheBitsOfALane) {
  constexpr int last = Lanes<double>::count - 1;
  for (const int n : lengths) {
    const LaneFourier<double> in_lanes(n);
    const LaneFourier<double, 1> alone(n);
    auto all = noise<double>(n);
    std::vector<Lanes<double, 1>::Complex> one;
    for (const auto& value : all) one.push_back({value.re[last], value.im[last]});
    const auto compare = [&] {
      for (std::size_t k = 0; k < all.size(); ++k) {
        ASSERT_EQ(all[k].re[last], one[k].re) << n;
        ASSERT_EQ(all[k].im[last], one[k].im) << n;
      }
    };
    in_lanes.forward(all.data());
    alone.forward(one.data());
    compare();
    in_lanes.inverse(all.data());
    alone.inverse(one.data());
    compare();
  }
}

TEST(LaneFourier, TakesLengthsWithoutAPrimeAbove31) {
  for (const int n : {1, 2, 7, 490, 8192, 11, 520, 31 * 29 * 23})
    EXPECT_TRUE(LaneFourier<double>::possible(n)) << n;
  for (const int n : {37, 74, 8191, 521, 0, -4}) {
    EXPECT_FALSE(LaneFourier<double>::possible(n)) << n;
    EXPECT_THROW(LaneFourier<float>{n}, Error) << n;
  }
}

TEST(SmoothLength, IsTheLeastWithoutAPrimeAbove7) {
  EXPECT_EQ(smooth_length(-3), 1);
  EXPECT_EQ(smooth_length(1), 1);
  EXPECT_EQ(smooth_length(11), 12);
  EXPECT_EQ(smooth_length(210), 210);
  EXPECT_EQ(smooth_length(1041), 1050);
}

}  // namespace
}  // namespace asperity::fourier_lanes_test
