// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/roughness.hpp"

#include "engine/core/parallel.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "tests/metrology/test_fields.hpp"

namespace asperity::roughness_test {
namespace {

using testing::make_profile;
using testing::make_surface;

TEST(Roughness, OfACosineProfile) {
  const int n = 256;
  const double A = 2.5e-6;
  const Roughness r =
      roughness(make_profile(n, 1.0 / n, [&](int i) { return A * std::cos(2 * pi * i / n); }));
  EXPECT_NEAR(r.Rq / A, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(r.Ra / A, 2 / pi, 1e-4);
  EXPECT_NEAR(r.kurtosis, 1.5, 1e-12);
  EXPECT_NEAR(r.skewness, 0, 1e-12);
  EXPECT_NEAR(r.mean / A, 0, 1e-12);
  EXPECT_DOUBLE_EQ(r.amplitude, 2 * A);
  EXPECT_DOUBLE_EQ(r.peak, A);
  EXPECT_DOUBLE_EQ(r.valley, -A);
}

// The slope of forward differences is that of the wave times sinc(π/n).
TEST(Roughness, OfASineProductSurface) {
  const int n = 256;
  const double h = 3e-6, L = 2e-3;
  const auto wave = [&](int i, int j) { return h * std::sin(2 * pi * i / n) * std::sin(2 * pi * j / n); };
  const Roughness r = roughness(make_surface(n, n, L, L, wave));
  EXPECT_NEAR(r.Rq / h, 0.5, 1e-12);
  EXPECT_NEAR(r.kurtosis, 2.25, 1e-12);
  EXPECT_NEAR(r.rms_slope / (pi * h * std::sqrt(2.0) / L), 1, 1e-4);
}

// Ra/Rq = √(2/π), skewness 0, kurtosis 3, each within three standard errors of n samples.
TEST(Roughness, OfGaussianHeights) {
  const int n = 512;
  const Roughness r = roughness(testing::white_noise(n, n, 1, 1, 7));
  EXPECT_NEAR(r.Ra / r.Rq, 0.79788, 3 * std::sqrt(1 - 3 / pi) / n);
  EXPECT_NEAR(r.Rq, 1, 3 * std::sqrt(0.5) / n);
  EXPECT_NEAR(r.skewness, 0, 3 * std::sqrt(6.0) / n);
  EXPECT_NEAR(r.kurtosis, 3, 3 * std::sqrt(24.0) / n);
}

// Phases 2π frac(0.6180339887498949 (10 n + m)), n_max = 7, span 3.
TEST(Roughness, OfAWeierstrassMandelbrotSurface) {
  WeierstrassMandelbrotOptions options;
  options.nx = options.ny = 150;
  options.D = 2.5;
  options.span = 3;
  options.n_max = 7;
  options.phases = WavePhases::function;
  options.phase_function = [](int m, int n) {
    const double turns = 0.6180339887498949 * (10 * n + m);
    return 2 * pi * (turns - std::floor(turns));
  };
  const Roughness r = roughness(weierstrass_mandelbrot(options));
  EXPECT_NEAR(r.mean, -2.2579597274, 1e-8);
  EXPECT_NEAR(r.Rq, 11.9812989022, 1e-8);
  EXPECT_NEAR(r.Ra, 9.4256615568, 1e-8);
  EXPECT_NEAR(r.skewness, -0.0183142689, 1e-8);
  EXPECT_NEAR(r.kurtosis, 3.4457650805, 1e-8);
  EXPECT_NEAR(r.amplitude, 108.3493302162, 1e-8);
}

TEST(Roughness, OfFourHeights) {
  const Roughness r = roughness(Profile(0.5, {0, 1, 3, 8}));
  EXPECT_DOUBLE_EQ(r.mean, 3);
  EXPECT_DOUBLE_EQ(r.Ra, 2.5);
  EXPECT_DOUBLE_EQ(r.Rq, std::sqrt(9.5));
  EXPECT_DOUBLE_EQ(r.skewness, 22.5 / (9.5 * std::sqrt(9.5)));
  EXPECT_DOUBLE_EQ(r.kurtosis, 0.25 * (81 + 16 + 625) / (9.5 * 9.5));
  EXPECT_DOUBLE_EQ(r.rms_slope, std::sqrt((4.0 + 16 + 100) / 3));
  EXPECT_DOUBLE_EQ(r.peak, 8);
  EXPECT_DOUBLE_EQ(r.valley, 0);
  EXPECT_DOUBLE_EQ(r.amplitude, 8);
}

TEST(Roughness, SlopeNeverCrossesTheRim) {
  const Roughness r = roughness(make_surface(7, 5, 7, 10, [](int i, int j) { return 3.0 * i - 4.0 * j; }));
  EXPECT_DOUBLE_EQ(r.rms_slope, std::sqrt(9.0 + 4.0));
}

// Only node (0, 0) has both neighbours in a 2 x 2 surface.
TEST(Roughness, SlopeIsOverNodesWithBothDifferences) {
  const Surface s =
      make_surface(2, 2, 2, 2, [](int i, int j) { return i == 1 && j == 1 ? 100.0 : 2.0 * i + 1.0 * j; });
  EXPECT_DOUBLE_EQ(roughness(s).rms_slope, std::sqrt(5.0));
}

TEST(Roughness, OfASurfaceOneNodeWideIsThatOfItsProfile) {
  const auto height = [](int k) { return std::sin(0.3 * k * k); };
  const Roughness p = roughness(make_profile(37, 0.25, height));
  const Roughness x = roughness(make_surface(37, 1, 37 * 0.25, 1, [&](int i, int) { return height(i); }));
  const Roughness y = roughness(make_surface(1, 37, 1, 37 * 0.25, [&](int, int j) { return height(j); }));
  EXPECT_NEAR(x.rms_slope, p.rms_slope, 1e-14 * p.rms_slope);
  EXPECT_NEAR(y.rms_slope, p.rms_slope, 1e-14 * p.rms_slope);
  EXPECT_EQ(x.Ra, p.Ra);
  EXPECT_EQ(y.kurtosis, p.kurtosis);
}

TEST(Roughness, OfEqualHeightsIsZeroAndNeverNaN) {
  for (const double height : {0.0, 0.1, -1e300, 1e-320}) {
    const Roughness r = roughness(make_surface(13, 3, 1, 1, [&](int, int) { return height; }));
    for (const double value : {r.Ra, r.Rq, r.amplitude, r.skewness, r.kurtosis, r.rms_slope})
      EXPECT_EQ(value, 0);
    for (const double value : {r.mean, r.peak, r.valley}) EXPECT_EQ(value, height);
  }
  EXPECT_EQ(roughness(Profile(1, {0.1})).Rq, 0);
  EXPECT_EQ(roughness(Profile(1, {0.1})).mean, 0.1);
}

// Heights scaled by a power of two give the same digits from 1e-160 m to 1e150 m.
TEST(Roughness, ScalesExactly) {
  const auto height = [](int i, int j) { return std::sin(1.0 * i * i + j) + 0.2 * j; };
  const Roughness one = roughness(make_surface(31, 17, 1, 1, height));
  for (const int e : {-530, -900, 500, 1000}) {
    const Roughness r =
        roughness(make_surface(31, 17, 1, 1, [&](int i, int j) { return std::ldexp(height(i, j), e); }));
    EXPECT_EQ(r.Ra, std::ldexp(one.Ra, e));
    EXPECT_EQ(r.Rq, std::ldexp(one.Rq, e));
    EXPECT_EQ(r.mean, std::ldexp(one.mean, e));
    EXPECT_EQ(r.skewness, one.skewness);
    EXPECT_EQ(r.kurtosis, one.kurtosis);
    EXPECT_EQ(r.rms_slope, std::ldexp(one.rms_slope, e));
  }
}

// Heights that are whole multiples of 2^-20 stay exact on an offset of 2^30: nothing else may differ.
TEST(Roughness, IsIndifferentToAnOffset) {
  const Stream stream(3, "offset");
  const auto height = [&](int i, int j) {
    return std::floor(stream.uniform(static_cast<std::uint64_t>(100 * j + i)) * 0x1p20) * 0x1p-20;
  };
  const Roughness r = roughness(make_surface(50, 40, 1, 1, height));
  const Roughness far =
      roughness(make_surface(50, 40, 1, 1, [&](int i, int j) { return 0x1p30 + height(i, j); }));
  EXPECT_NEAR(far.Rq / r.Rq, 1, 1e-12);
  EXPECT_NEAR(far.Ra / r.Ra, 1, 1e-12);
  EXPECT_NEAR(far.kurtosis / r.kurtosis, 1, 1e-12);
  EXPECT_NEAR(far.skewness, r.skewness, 1e-12);
  EXPECT_NEAR(far.rms_slope / r.rms_slope, 1, 1e-12);
  EXPECT_EQ(far.amplitude, r.amplitude);
}

TEST(Roughness, SameBitsForAnyNumberOfThreads) {
  const Surface s = testing::white_noise(301, 257, 1, 1, 5);
  set_thread_count(1);
  const Roughness one = roughness(s);
  set_thread_count(2);
  const Roughness two = roughness(s);
  set_thread_count(0);
  EXPECT_EQ(one.Ra, two.Ra);
  EXPECT_EQ(one.kurtosis, two.kurtosis);
  EXPECT_EQ(one.rms_slope, two.rms_slope);
}

}  // namespace
}  // namespace asperity::roughness_test
