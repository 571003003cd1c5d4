// SPDX-License-Identifier: GPL-3.0-or-later
// The filter in lanes against rows and columns; streamed rows; memory.
#include "engine/core/fourier/fourier_lane_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::fourier_lane_filter_test {
namespace {

struct Shape {
  int nx, ny, period_x, period_y;
};

Array<double> noise(const Shape& shape) {
  const Stream stream(1, "lane filter");
  Array<double> values(static_cast<std::size_t>(shape.nx) * static_cast<std::size_t>(shape.ny));
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = stream.normal(k);
  return values;
}

double factor(int a, int b) { return 1 / (1.0 + a + 0.3 * b * b) - 0.2; }

void factors_of(int a, std::span<double> factors) {
  for (std::size_t b = 0; b < factors.size(); ++b) factors[b] = factor(a, static_cast<int>(b));
}

class LaneFilter : public ::testing::TestWithParam<Shape> {
 protected:
  void TearDown() override { set_thread_count(0); }
};

template <class Real>
void compare(const Shape& shape, double tolerance) {
  const Array<double> in = noise(shape);
  Array<double> expected(in.size()), out(in.size());
  FourierFilter(shape.nx, shape.ny, shape.period_x, shape.period_y).apply(in, expected, factors_of);
  FourierLaneFilter<Real> filter(shape.nx, shape.ny, shape.period_x, shape.period_y, factors_of);
  for (int repeat = 0; repeat < 2; ++repeat) filter.apply(in, out);  // second run on used work space
  for (std::size_t k = 0; k < in.size(); ++k) ASSERT_NEAR(out[k], expected[k], tolerance) << k;
  Array<double> same = in;
  filter.apply(same, same);
  EXPECT_EQ(same, out);
}

TEST_P(LaneFilter, IsTheFilter) {
  compare<double>(GetParam(), 1e-14);
  compare<float>(GetParam(), 5e-6);
}

template <class Real>
void row_by_row(const Shape& shape) {
  const Array<double> in = noise(shape);
  Array<double> expected(in.size()), out(in.size()), taken(in.size());
  FourierLaneFilter<Real> filter(shape.nx, shape.ny, shape.period_x, shape.period_y, factors_of);
  filter.apply(in, expected);
  for (const bool kept : {true, false}) {
    std::vector<std::atomic<int>> asked(static_cast<std::size_t>(shape.ny)), given(asked.size());
    const auto row = [&](auto& field, int j) {
      return field.data() + static_cast<std::ptrdiff_t>(j) * shape.nx;
    };
    filter.apply(
        [&](int j, double* scratch) -> const double* {
          ++asked[static_cast<std::size_t>(j)];
          if (j % 2 == 0) return row(in, j);
          std::copy_n(row(in, j), shape.nx, scratch);
          return scratch;
        },
        [&](int j, const double* values) {
          ++given[static_cast<std::size_t>(j)];
          std::copy_n(values, shape.nx, row(taken, j));
        },
        kept ? std::span<double>(out) : std::span<double>());
    EXPECT_EQ(taken, expected);
    EXPECT_EQ(out, expected);  // first pass
    for (std::size_t j = 0; j < asked.size(); ++j) {
      EXPECT_EQ(asked[j], 1);
      EXPECT_EQ(given[j], 1);
    }
  }
}

TEST_P(LaneFilter, TakesAndGivesRows) {
  row_by_row<double>(GetParam());
  row_by_row<float>(GetParam());
}

template <class Real>
void threads(const Shape& shape) {
  const Array<double> in = noise(shape);
  Array<double> alone(in.size()), shared(in.size());
  set_thread_count(1);
  FourierLaneFilter<Real>(shape.nx, shape.ny, shape.period_x, shape.period_y, factors_of).apply(in, alone);
  for (const int count : {2, 3}) {
    set_thread_count(count);
    FourierLaneFilter<Real>(shape.nx, shape.ny, shape.period_x, shape.period_y, factors_of).apply(in, shared);
    EXPECT_EQ(shared, alone);
  }
}

TEST_P(LaneFilter, ThreadsChangeNoBit) {
  threads<double>(GetParam());
  threads<float>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, LaneFilter,
                         ::testing::Values(Shape{2, 1, 2, 1}, Shape{2, 2, 2, 2}, Shape{64, 48, 64, 48},
                                           Shape{64, 1, 64, 1}, Shape{30, 49, 30, 49},
                                           Shape{100, 21, 100, 21}, Shape{96, 160, 96, 160},
                                           Shape{17, 31, 36, 64}, Shape{33, 50, 70, 105}, Shape{1, 1, 2, 1},
                                           Shape{5, 3, 18, 6}));

TEST(FourierLaneFilter, SinglePrecisionIsScaledIntoItsRange) {
  const Shape shape{32, 24, 32, 24};
  Array<double> in = noise(shape), expected(in.size()), out(in.size());
  FourierLaneFilter<float> filter(32, 24, 32, 24, factors_of);
  filter.apply(in, expected);
  for (const int power : {-900, -200, 200, 900}) {
    Array<double> scaled = in;
    for (double& value : scaled) value = std::ldexp(value, power);
    filter.apply(scaled, out, std::ldexp(1.0, -power));
    for (std::size_t k = 0; k < out.size(); ++k) ASSERT_EQ(std::ldexp(out[k], -power), expected[k]);
  }
}

TEST(FourierLaneFilter, HoldsItsMultiplier) {
  const FourierLaneFilter<double> filter(20, 12, 20, 12, factors_of);
  for (int a = 0; a <= 10; ++a)
    for (int b = 0; b <= 6; ++b) EXPECT_DOUBLE_EQ(filter.factor(a, b), factor(a, b)) << a << ", " << b;
}

TEST(FourierLaneFilter, HoldsAGridAndAHalfAtMostAndSingleIsHalf) {
  set_thread_count(1);
  std::int64_t held[2];
  for (const bool single : {false, true}) {
    const Shape shape{256, 192, 256, 192};
    Array<double> field = noise(shape);
    const std::int64_t before = memory::held();
    const auto apply = [&](auto& filter) {
      filter.apply(field, field);
      held[single] = memory::held() - before;
    };
    if (single) {
      FourierLaneFilter<float> filter(256, 192, 256, 192, factors_of);
      apply(filter);
    } else {
      FourierLaneFilter<double> filter(256, 192, 256, 192, factors_of);
      apply(filter);
    }
  }
  set_thread_count(0);
  // The spectrum, a quarter for the multiplier, a few rows and columns.
  const std::int64_t grid = 256 * 192 * sizeof(double);
  EXPECT_GE(held[0], grid);
  EXPECT_LE(held[0], grid * 3 / 2);
  EXPECT_LT(static_cast<double>(held[1]), 0.65 * static_cast<double>(held[0]));
}

TEST(FourierLaneFilter, TakesEvenPeriodsOfSmallPrimes) {
  EXPECT_TRUE(FourierLaneFilter<float>::possible(14, 75));
  EXPECT_TRUE(FourierLaneFilter<float>::possible(62, 11));
  EXPECT_FALSE(FourierLaneFilter<float>::possible(15, 75));
  EXPECT_FALSE(FourierLaneFilter<float>::possible(74, 75));
  EXPECT_FALSE(FourierLaneFilter<float>::possible(14, 37));
}

TEST(FourierLaneFilter, RefusesAnotherGridsValuesAndOutlivesAFailure) {
  FourierLaneFilter<double> filter(32, 32, 32, 32, factors_of);
  Array<double> field(32 * 32), other(32 * 31), again(field.size());
  EXPECT_THROW(filter.apply(field, other), Error);
  EXPECT_THROW(filter.apply(other, other), Error);
  field[3] = 1;
  filter.apply(field, again);
  EXPECT_THROW(
      filter.apply([](int, double*) -> const double* { throw Error(ErrorCode::interrupted, "stop"); }, {}),
      Error);
  Array<double> after(field.size());
  filter.apply(field, after);
  EXPECT_EQ(after, again);
}

}  // namespace
}  // namespace asperity::fourier_lane_filter_test
