// SPDX-License-Identifier: GPL-3.0-or-later
// The fused filter against whole transforms, periodic and padded.
#include "engine/core/fourier/fourier_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/grid.hpp"

namespace asperity::fourier_filter_test {
namespace {

Field noise(int nx, int ny) {
  const Stream stream(1, "filter test");
  Field field(nx, ny);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = stream.normal(k);
  return field;
}

double factor(int a, int b) { return 1 / (1.0 + a + 0.3 * b * b) - 0.2; }

struct Shape {
  int nx, ny, period_x, period_y;
};

class Filter : public ::testing::TestWithParam<Shape> {};

TEST_P(Filter, IsTransformMultiplyAndBack) {
  const auto [nx, ny, period_x, period_y] = GetParam();
  const Field in = noise(nx, ny);
  Field padded(period_x, period_y);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) padded(i, j) = in(i, j);
  HalfSpectrum spectrum = fourier_forward(padded);
  for (int b = 0; b < period_y; ++b)
    for (int a = 0; a < spectrum.bins_x(); ++a) spectrum(a, b) *= factor(a, std::min(b, period_y - b));
  const Field expected = fourier_inverse(std::move(spectrum));

  FourierFilter filter(nx, ny, period_x, period_y);
  EXPECT_EQ(filter.bins_x(), period_x / 2 + 1);
  EXPECT_EQ(filter.bins_y(), period_y / 2 + 1);
  Field out(nx, ny);
  for (int repeat = 0; repeat < 2; ++repeat)  // second run on used work space
    filter.apply(in.values(), out.values(), [&](int a, std::span<double> factors) {
      ASSERT_EQ(factors.size(), static_cast<std::size_t>(filter.bins_y()));
      for (std::size_t b = 0; b < factors.size(); ++b) factors[b] = factor(a, static_cast<int>(b));
    });
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) ASSERT_NEAR(out(i, j), expected(i, j), 1e-14) << i << ", " << j;
}

INSTANTIATE_TEST_SUITE_P(Shapes, Filter,
                         ::testing::Values(Shape{64, 48, 64, 48}, Shape{64, 1, 64, 1}, Shape{1, 64, 1, 64},
                                           Shape{1, 1, 1, 1}, Shape{2, 2, 2, 2}, Shape{17, 31, 17, 31},
                                           Shape{30, 15, 30, 15}, Shape{15, 30, 15, 30},
                                           Shape{20, 33, 40, 70}, Shape{1, 5, 2, 10}, Shape{33, 7, 65, 13},
                                           Shape{128, 96, 128, 192}, Shape{3, 4100, 6, 8192}));

TEST(FourierFilter, RefusesAnotherGridsValues) {
  FourierFilter filter(8, 8, 8, 8);
  Array<double> in(64), out(63);
  EXPECT_THROW(filter.apply(in, out, [](int, std::span<double>) {}), Error);
}

TEST(FourierFilter, AFailingMultiplierLeavesItUsable) {
  FourierFilter filter(32, 32, 32, 32);
  Array<double> values(32 * 32, 1.0);
  EXPECT_THROW(filter.apply(values, values,
                            [](int a, std::span<double>) {
                              if (a == 3) throw Error(ErrorCode::internal, "no");
                            }),
               Error);
  std::fill(values.begin(), values.end(), 1.0);
  filter.apply(values, values,
               [](int, std::span<double> factors) { std::fill(factors.begin(), factors.end(), 2.0); });
  for (const double value : values) ASSERT_NEAR(value, 2, 1e-14);
}

TEST(GoodFourierLength, IsTheLeastEvenSmoothOne) {
  EXPECT_EQ(good_fourier_length(0), 1);
  EXPECT_EQ(good_fourier_length(1), 1);
  EXPECT_EQ(good_fourier_length(3), 4);
  EXPECT_EQ(good_fourier_length(11), 12);
  EXPECT_EQ(good_fourier_length(22), 24);
  EXPECT_EQ(good_fourier_length(1021), 1024);
  EXPECT_EQ(good_fourier_length(1023), 1024);
  EXPECT_EQ(good_fourier_length(1025), 1050);
  EXPECT_EQ(good_fourier_length(131071), 131072);
}

}  // namespace
}  // namespace asperity::fourier_filter_test
