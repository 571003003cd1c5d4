// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/operations/holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/parallel.hpp"
#include "tests/surface/files.hpp"

namespace asperity::holes_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A square hole, `share` of each side.
template <class Height>
Field with_hole(int n, double share, Height&& height) {
  Field field(n, n);
  const int rim = static_cast<int>(n * (1 - share) / 2);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const bool inside = i >= rim && i < n - rim && j >= rim && j < n - rim;
      field(i, j) = inside ? nan : height(i, j);
    }
  return field;
}

double worst(const Field& a, const Field& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

// Five-point Laplacian over missing nodes.
double worst_residual(const Field& before, const Field& after) {
  double most = 0;
  for (int j = 0; j < after.ny(); ++j)
    for (int i = 0; i < after.nx(); ++i) {
      if (!std::isnan(before(i, j))) continue;
      double sum = 0;
      if (i > 0) sum += after(i - 1, j) - after(i, j);
      if (j > 0) sum += after(i, j - 1) - after(i, j);
      if (i + 1 < after.nx()) sum += after(i + 1, j) - after(i, j);
      if (j + 1 < after.ny()) sum += after(i, j + 1) - after(i, j);
      most = std::max(most, std::abs(sum));
    }
  return most;
}

TEST(Holes, FewIterationsForAnyHole) {
  for (const int n : {50, 201, 800}) {
    Field field = with_hole(n, 0.8, [](int i, int j) { return std::sin(0.3 * i) + std::cos(0.2 * j); });
    const int turns = fill_harmonic(field, 1e-6, 1e-6, Monitor::silent());
    EXPECT_GT(turns, 0) << n;
    EXPECT_LE(turns, 30) << n;
  }
}

// These polynomials are harmonic for the five-point Laplacian too.
TEST(Holes, HarmonicFunctionsComeBack) {
  const int n = 301;
  const auto height = [](int i, int j) {
    const double x = i / 301.0, y = j / 301.0;
    return x * x - y * y + 3 * x * y + x * x * x - 3 * x * y * y;
  };
  Field field = with_hole(n, 0.8, height), whole(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) whole(i, j) = height(i, j);
  const double span = range(whole.values()).span();
  fill_harmonic(field, 1e-6, 1e-6, Monitor::silent());
  EXPECT_LT(worst(field, whole), 3e-12 * span);
}

// hx^2 times the second difference in x balances hy^2 in y.
TEST(Holes, LongCells) {
  for (const double ratio : {0.01, 0.3, 4.0, 100.0}) {
    const int n = 120;
    const auto height = [&](int i, int j) {
      const double x = i * ratio, y = j;
      return (x * x - y * y + x * y) / (n * n * std::max(1.0, ratio * ratio));
    };
    Field field = with_hole(n, 0.8, height), whole(n, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) whole(i, j) = height(i, j);
    const double span = range(whole.values()).span();
    EXPECT_LE(fill_harmonic(field, ratio * 1e-6, 1e-6, Monitor::silent()), 30) << ratio;
    EXPECT_LT(worst(field, whole), 1e-11 * span) << ratio;
  }
}

TEST(Holes, ScatteredPointsLinesAndRims) {
  const int n = 257;
  const Stream stream(5, "holes");
  const auto height = [](int i, int j) { return std::sin(0.11 * i) * std::cos(0.07 * j); };
  for (const double share : {0.05, 0.5, 0.95, 0.999}) {
    Field field(n, n - 1);
    for (int j = 0; j < n - 1; ++j)
      for (int i = 0; i < n; ++i) {
        const bool missing = stream.uniform(static_cast<std::uint64_t>(j * n + i)) < share || j % 16 == 5 ||
                             (i > 200 && j > 100 && (i != 240 || j != 200));
        field(i, j) = missing ? nan : height(i, j);
      }
    const Field before = field;
    EXPECT_LE(fill_harmonic(field, 1, 1, Monitor::silent()), 60) << share;
    EXPECT_LT(worst_residual(before, field), 1e-11) << share;
  }
}

// The solution is a straight line.
TEST(Holes, OneRowAndOneColumn) {
  const int n = 4097;
  for (const bool upright : {false, true}) {
    Field field(upright ? 1 : n, upright ? n : 1, nan);
    field[0] = 1;
    field[n - 1] = 3;
    EXPECT_LE(fill_harmonic(field, 1e-6, 1e-3, Monitor::silent()), 20);
    for (std::size_t k = 0; k < field.size(); ++k)
      ASSERT_NEAR(field[k], 1 + 2.0 * static_cast<double>(k) / (n - 1), 1e-11) << k;
  }
}

TEST(Holes, SameBitsForAnyNumberOfThreads) {
  const auto height = [](int i, int j) { return std::sin(0.3 * i) + std::cos(0.2 * j); };
  Field one = with_hole(200, 0.8, height), three = one;
  const int threads = thread_count();
  set_thread_count(1);
  fill_harmonic(one, 1, 1, Monitor::silent());
  set_thread_count(3);
  fill_harmonic(three, 1, 1, Monitor::silent());
  set_thread_count(threads);
  EXPECT_EQ(worst(one, three), 0);
}

TEST(Holes, NothingMissingAndNothingMeasured) {
  Field whole(3, 3, 2.0), empty(3, 3, nan), level(3, 3, nan);
  level(1, 1) = 7;
  EXPECT_EQ(fill_harmonic(whole, 1, 1, Monitor::silent()), 0);
  EXPECT_EQ(fill_harmonic(level, 1, 1, Monitor::silent()), 0);
  EXPECT_EQ(level(2, 0), 7);
  EXPECT_NE(testing::message_of([&] {
              fill_harmonic(empty, 1, 1, Monitor::silent());
            }).find("every height is missing"),
            std::string::npos);
}

TEST(Holes, HeightsWhoseRangeIsBeyondAnyDoubleAreRefused) {
  Field field(3, 2, 0.0);
  field(0, 0) = 1e308;
  field(1, 1) = -1e308;
  field(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(testing::message_of([&] { fill_harmonic(field, 1, 1, Monitor::silent()); }),
            "the heights run from -1e+308 m to 1e+308 m, too far apart to interpolate between; mark missing "
            "points with nan, and check the unit");
  field(1, 1) = -7e307;
  fill_harmonic(field, 1, 1, Monitor::silent());
  EXPECT_TRUE(std::isfinite(field(2, 0)));
}

TEST(Holes, HolesBeyondTheLimitOfMemoryAreRefused) {
  Field field = with_hole(100, 0.8, [](int i, int j) { return std::sin(0.3 * i) + std::cos(0.2 * j); });
  memory::set_limit(memory::held() + 1'000'000);
  const auto error = testing::error_of([&] { fill_harmonic(field, 1, 1, Monitor::silent()); });
  memory::set_limit(0);
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::out_of_memory);
  EXPECT_NE(error->sentence().find("6724 missing heights"), std::string::npos);
  EXPECT_TRUE(std::isnan(field(50, 50)));
}

class Stopper final : public Monitor {
 public:
  void progress(std::string_view what, double done) override {
    what_ = what;
    done_ = done;
    stop_flag().raise(StopReason::interrupt);
  }
  void warn(std::string_view) override {}
  std::string what_;
  double done_ = -1;
};

TEST(Holes, StopFlagEndsTheWork) {
  const auto height = [](int i, int j) { return std::sin(0.3 * i) + std::cos(0.2 * j); };
  Field field = with_hole(60, 0.8, height);
  stop_flag().raise(StopReason::interrupt);
  const auto error = testing::error_of([&] { fill_harmonic(field, 1, 1, Monitor::silent()); });
  stop_flag().clear();
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::interrupted);

  Field large = with_hole(1200, 0.8, height);
  Stopper stopper;
  const auto second = testing::error_of([&] { fill_harmonic(large, 1, 1, stopper); });
  stop_flag().clear();
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->code(), ErrorCode::interrupted);
  EXPECT_EQ(stopper.what_, "filling missing points");
  EXPECT_GE(stopper.done_, 0);
  EXPECT_LT(stopper.done_, 1);
  EXPECT_TRUE(std::isnan(large(600, 600)));  // unchanged
}

}  // namespace
}  // namespace asperity::holes_test
