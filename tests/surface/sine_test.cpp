// SPDX-License-Identifier: GPL-3.0-or-later
// Cosines of amplitude A: Rq = A/√2, Ra = 2A/π, kurtosis 1.5. Products of height h: Sq = h/2, rms gradient
// πh√2/L.
#include "engine/surface/generators/sine.hpp"
#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::sine_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const SineOptions& options) {
  return test::refusal([&] { sine_surface(options); });
}

double mean_power(const Surface& surface, int power) {
  double sum = 0;
  for (const double z : surface.heights().values()) sum += std::pow(z, power);
  return sum / static_cast<double>(surface.heights().size());
}

TEST(Sine, StatisticsOfOneWave) {
  const double A = 0.3e-6;
  const Surface surface = sine_surface({{256, 4, 1e-3, 1e-4}, A, 1e-3, 1});
  const double rq = std::sqrt(mean_power(surface, 2));
  EXPECT_NEAR(rq, A / std::sqrt(2.0), 1e-12 * A);
  EXPECT_NEAR(mean_power(surface, 4) / std::pow(rq, 4), 1.5, 1e-12);
  EXPECT_NEAR(mean_power(surface, 1), 0, 1e-15 * A);
  double absolute = 0;
  for (const double z : surface.heights().values()) absolute += std::abs(z);
  EXPECT_NEAR(absolute / 1024, 2 * A / pi, 1e-4 * A);
}

TEST(Sine, StatisticsOfAProduct) {
  const double h = 0.3e-6, size = 1e-3;
  const int n = 256;
  const Surface surface = sine_surface({{n, n, size, size}, h, {}, 2});
  EXPECT_NEAR(std::sqrt(mean_power(surface, 2)), h / 2, 1e-12 * h);
  double slopes = 0;
  const Field& z = surface.heights();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      slopes += std::pow(z((i + 1) % n, j) - z(i, j), 2) + std::pow(z(i, (j + 1) % n) - z(i, j), 2);
  EXPECT_NEAR(std::sqrt(slopes) / size, pi * h * std::sqrt(2.0) / size,
              1e-4 * pi * h * std::sqrt(2.0) / size);
}

TEST(Sine, CrestsNodesAndTroughsAreExact) {
  const Surface surface = sine_surface({{16, 16, 1, 1}, 2.0, 0.5, 2});
  EXPECT_EQ(surface.height(0, 0), 2.0);
  EXPECT_EQ(surface.height(8, 8), 2.0);
  EXPECT_EQ(surface.height(4, 0), -2.0);
  EXPECT_EQ(surface.height(4, 4), 2.0);
  EXPECT_EQ(surface.height(2, 5), 0.0);
  EXPECT_EQ(surface.height(6, 0), 0.0);
}

TEST(Sine, IsTheCosineOnAwkwardGrids) {
  for (const double waves : {1.0, 3.0, 2.7, 0.4})
    for (const int n : {13, 31, 100}) {
      const double size = 0.7e-3;
      const Surface surface = sine_surface({{n, n + 2, size, 2 * size}, 1e-6, size / waves, 2});
      for (int j = 0; j < n + 2; ++j)
        for (int i = 0; i < n; ++i)
          EXPECT_NEAR(surface.height(i, j),
                      1e-6 * std::cos(2 * pi * waves * i / n) * std::cos(4 * pi * waves * j / (n + 2)),
                      1e-6 * 1e-13)
              << waves << " " << n;
    }
}

TEST(Sine, MirrorImagesAreTheSameBits) {
  const Surface surface = sine_surface({{1000, 3, 1e-3, 1e-3}, 1e-6, 1e-3 / 7, 1});
  for (int i = 1; i < 1000; ++i) EXPECT_EQ(surface.height(i, 0), surface.height(1000 - i, 2));
}

TEST(Sine, PeriodicWhenWholeWavesFit) {
  EXPECT_TRUE(sine_surface({{64, 64, 1e-3, 1e-3}, 1, 250e-6, 2}).traits().periodic);
  EXPECT_TRUE(
      sine_surface({{64, 64, 0.3, 0.7}, 1, 0.1, 2}).traits().periodic);  // 0.3/0.1 is not 3 in doubles
  EXPECT_FALSE(sine_surface({{64, 64, 1e-3, 1e-3}, 1, 300e-6, 1}).traits().periodic);
  EXPECT_FALSE(sine_surface({{64, 64, 1e-3, 1e-3}, 1, 2e-3, 1}).traits().periodic);
  EXPECT_TRUE(sine_surface({{64, 64, 1e-3, 1.5e-3}, 1, {}, 1}).traits().periodic);
  EXPECT_FALSE(sine_surface({{64, 64, 1e-3, 1.5e-3}, 1, {}, 2}).traits().periodic);
}

TEST(Sine, OneNodeAcross) {
  const Surface line = sine_surface({{9, 1, 9, 1}, 1, {}, 1});
  EXPECT_NEAR(line.height(3, 0), -0.5, 1e-15);
  EXPECT_EQ(refusal({{1, 9, 1, 9}, 1, {}, 1}),
            "`wavelength` is 1 m, under two cells of 1 m along x; give at least 2 m, or more `cells`");
}

TEST(Sine, Refusals) {
  const Grid grid{8, 8, 8e-6, 8e-6};
  EXPECT_EQ(refusal({grid, -1, {}, 1}), "`amplitude` is -1 m; give a finite length, zero or above");
  EXPECT_EQ(refusal({grid, nan, {}, 1}), "`amplitude` is nan m; give a finite length, zero or above");
  EXPECT_EQ(refusal({grid, 0, {}, 1}), "accepted");
  EXPECT_EQ(refusal({grid, 1, 0.0, 1}), "`wavelength` is 0 m; give a finite length above zero");
  EXPECT_EQ(refusal({grid, 1, {}, 3}),
            "`directions` is 3; give 1 for waves along x, or 2 for their product with waves along y");
  EXPECT_EQ(refusal({grid, 1, 2e-6, 2}), "accepted");
  EXPECT_EQ(refusal({grid, 1, 1.99e-6, 2}),
            "`wavelength` is 1.99 um, under two cells of 1 um along x; give at least 2 um, or more `cells`");
  EXPECT_EQ(refusal({{8, 4, 8e-6, 8e-6}, 1, 2e-6, 1}), "accepted");
  EXPECT_EQ(refusal({{8, 4, 8e-6, 8e-6}, 1, 2e-6, 2}),
            "`wavelength` is 2 um, under two cells of 2 um along y; give at least 4 um, or more `cells`");
}

}  // namespace
}  // namespace asperity::sine_test
