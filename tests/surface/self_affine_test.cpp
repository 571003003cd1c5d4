// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/self_affine.hpp"
#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/parallel.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::self_affine_test {
namespace {

SelfAffineOptions example(int nx = 64, int ny = 64) {
  SelfAffineOptions options;
  options.grid = Grid{nx, ny, 1e-3, 1e-3};
  options.hurst = 0.8;
  options.rms_height = 1e-6;
  options.roll_off = 250e-6;
  options.short_wave = 1e-3 / 24;
  return options;
}

std::string refusal(const SelfAffineOptions& options) {
  return test::refusal([&] { self_affine_surface(options); });
}

double rms(const Field& field) {
  double sum = 0;
  for (const double z : field.values()) sum += z * z;
  return std::sqrt(sum / static_cast<double>(field.size()));
}

struct Wave {
  int a, b;
  double length;  // m
  double power;   // m², with the conjugate if stored only once
};

std::vector<Wave> waves_of(const Surface& surface) {
  const Grid& grid = surface.grid();
  const HalfSpectrum spectrum = fourier_forward(surface.heights());
  std::vector<Wave> waves;
  for (int b = 0; b < grid.ny; ++b)
    for (int a = 0; a < spectrum.bins_x(); ++a) {
      const int wb = spectrum.wave_y(b);
      const double q = std::hypot(a / grid.size_x, wb / grid.size_y);
      const bool once = a > 0 && 2 * a != grid.nx;
      waves.push_back(
          {a, wb, 1 / q, (once ? 2 : 1) * std::norm(spectrum(a, b) / static_cast<double>(grid.nodes()))});
    }
  return waves;
}

TEST(SelfAffine, RmsHeightIsMetExactly) {
  for (const auto& [nx, ny] : {std::pair{64, 64}, {61, 67}, {128, 50}}) {
    const Surface surface = self_affine_surface(example(nx, ny));
    EXPECT_NEAR(rms(surface.heights()), 1e-6, 1e-6 * 1e-13) << nx << " x " << ny;
    EXPECT_LT(std::abs(mean(surface.heights().values())), 1e-6 * 1e-14);
    EXPECT_TRUE(surface.traits().periodic);
    EXPECT_EQ(surface.traits().aliased_share, 0.0);
  }
}

TEST(SelfAffine, RmsSlopeIsMetExactly) {
  SelfAffineOptions options = example(61, 80);
  options.rms_height.reset();
  options.rms_slope = 0.12;
  double slope_squared = 0;
  for (const Wave& wave : waves_of(self_affine_surface(options)))
    if (std::isfinite(wave.length)) slope_squared += wave.power * std::pow(2 * pi / wave.length, 2);
  EXPECT_NEAR(std::sqrt(slope_squared), 0.12, 0.12 * 1e-12);
}

TEST(SelfAffine, RaIsMetExactly) {
  SelfAffineOptions options = example();
  options.rms_height.reset();
  options.ra = 3e-6;
  const Surface surface = self_affine_surface(options);
  double sum = 0;
  for (const double z : surface.heights().values()) sum += std::abs(z);
  EXPECT_NEAR(sum / 4096, 3e-6, 3e-6 * 1e-13);
}

TEST(SelfAffine, AFinerGridIsTheSameSurface) {
  const Surface coarse = self_affine_surface(example(50, 64));
  for (const auto& [kx, ky] : {std::pair{1, 2}, {3, 1}, {2, 3}}) {
    const Surface fine = self_affine_surface(example(50 * kx, 64 * ky));
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 50; ++i)
        ASSERT_NEAR(fine.height(kx * i, ky * j), coarse.height(i, j), 1e-12 * 1e-6) << i << ", " << j;
  }
  SelfAffineOptions slope = example(50, 64);
  slope.rms_height.reset();
  slope.rms_slope = 0.1;
  const Surface coarse_slope = self_affine_surface(slope);
  slope.grid.nx = 100;
  const Surface fine_slope = self_affine_surface(slope);
  EXPECT_NEAR(fine_slope.height(66, 5), coarse_slope.height(33, 5), 1e-12 * rms(fine_slope.heights()));
}

TEST(SelfAffine, ShorterWavesLeaveLongOnesInProportion) {
  SelfAffineOptions options = example(128, 128);
  const std::vector<Wave> before = waves_of(self_affine_surface(options));
  options.short_wave = 1e-3 / 60;
  const std::vector<Wave> after = waves_of(self_affine_surface(options));
  const double ratio = after[1].power / before[1].power;
  EXPECT_LT(ratio, 1);
  for (std::size_t k = 1; k < before.size(); ++k)
    if (before[k].length > 1e-3 / 23) {
      EXPECT_NEAR(after[k].power / before[k].power, ratio, 1e-9 * ratio) << k;
    }
}

TEST(SelfAffine, HoldsOnlyTheWavesOfItsBand) {
  SelfAffineOptions options = example(64, 48);
  options.grid.size_y = 0.6e-3;
  options.long_wave = 0.5e-3;
  for (const Wave& wave : waves_of(self_affine_surface(options))) {
    const bool inside = wave.length <= 0.5e-3 * (1 + 1e-9) && wave.length > 1e-3 / 24 * (1 + 1e-9);
    if (inside) {
      EXPECT_GT(wave.power, 1e-22) << wave.a << ", " << wave.b;
    } else {
      EXPECT_LT(wave.power, 1e-40) << wave.a << ", " << wave.b;
    }
  }
}

TEST(SelfAffine, SameBitsForAnyNumberOfThreads) {
  set_thread_count(1);
  const std::string one = self_affine_surface(example(301, 400)).digest();
  set_thread_count(2);
  EXPECT_EQ(self_affine_surface(example(301, 400)).digest(), one);
  set_thread_count(0);
}

TEST(SelfAffine, SeedsDiffer) {
  SelfAffineOptions options = example();
  const Surface first = self_affine_surface(options);
  options.seed = 2;
  const Surface second = self_affine_surface(options);
  double product = 0;
  for (std::size_t k = 0; k < first.heights().size(); ++k)
    product += first.heights()[k] * second.heights()[k];
  EXPECT_LT(std::abs(product / 4096 / 1e-12), 0.5);
  EXPECT_NE(first.digest(), second.digest());
}

// Bands against the discrete sum of the theoretical spectrum; the mean over N independent exponential
// powers scatters by 1/√N.
TEST(SelfAffine, SpectrumIsThatOfTheory) {
  constexpr int n = 128, seeds = 40;
  const double size = 1e-3, hurst = 0.7, roll_off = size / 12, short_wave = size / 60;
  const double edges[] = {0.5, 12, 20, 32, 60};
  double measured[4] = {}, theory[4] = {};
  int count[4] = {};
  for (int seed = 1; seed <= seeds; ++seed) {
    SelfAffineOptions options = example(n, n);
    options.hurst = hurst;
    options.roll_off = roll_off;
    options.short_wave = short_wave;
    options.seed = static_cast<std::uint64_t>(seed);
    for (const Wave& wave : waves_of(self_affine_surface(options))) {
      const double waves = size / wave.length;
      for (int band = 0; band < 4; ++band) {
        if (!(waves >= edges[band] && waves < edges[band + 1] * (1 - 1e-9))) continue;
        measured[band] += wave.power;
        theory[band] += (wave.a > 0 ? 2 : 1) * (waves > 12 ? std::pow(waves / 12, -2 - 2 * hurst) : 1);
        ++count[band];
      }
    }
  }
  const double scale = (measured[0] + measured[1] + measured[2] + measured[3]) /
                       (theory[0] + theory[1] + theory[2] + theory[3]);
  for (int band = 0; band < 4; ++band)
    EXPECT_NEAR(measured[band] / theory[band] / scale, 1, 4 * 1.3 / std::sqrt(count[band]))
        << "band " << band;
}

// h² = C_r q_r²/(4π) [1 + 1/H - (q_L/q_r)² - (1/H)(q_s/q_r)^(-2H)]; C_r: mean flat power times the area.
TEST(SelfAffine, HeightOfTheory) {
  constexpr int n = 128, seeds = 30;
  const double size = 1e-3, hurst = 0.8, flat_waves = 20, most_waves = 60;
  double flat_power = 0;
  int flat_count = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    SelfAffineOptions options = example(n, n);
    options.hurst = hurst;
    options.roll_off = size / flat_waves;
    options.short_wave = size / most_waves;
    options.seed = static_cast<std::uint64_t>(seed);
    for (const Wave& wave : waves_of(self_affine_surface(options)))
      if (wave.a > 0 && size / wave.length <= flat_waves) {
        flat_power += wave.power / 2;
        ++flat_count;
      }
  }
  const double spectrum = flat_power / flat_count * size * size;
  const double q_r = 2 * pi * flat_waves / size;
  const double h_squared =
      spectrum * q_r * q_r / (4 * pi) *
      (1 + 1 / hurst - std::pow(1 / flat_waves, 2) - std::pow(most_waves / flat_waves, -2 * hurst) / hurst);
  // 30 x 600 exponential powers scatter by 0.8 %, a circle of 1250 lattice points by 1 %.
  EXPECT_NEAR(h_squared / 1e-12, 1, 0.04);
}

TEST(SelfAffine, HeightsAreGaussian) {
  SelfAffineOptions options = example(256, 256);
  options.roll_off = 1e-3 / 24;
  options.short_wave = 1e-3 / 100;
  const Surface surface = self_affine_surface(options);
  double absolute = 0, fourth = 0;
  for (const double z : surface.heights().values()) {
    absolute += std::abs(z) / 1e-6;
    fourth += std::pow(z / 1e-6, 4);
  }
  const double nodes = 256 * 256;
  EXPECT_NEAR(absolute / nodes, 0.79788, 0.01);  // Ra/Rq of a Gaussian field
  EXPECT_NEAR(fourth / nodes, 3, 0.15);
}

TEST(SelfAffine, ALineOfCells) {
  SelfAffineOptions options = example();
  options.grid = Grid{1, 256, 2e-6, 512e-6};
  options.roll_off.reset();
  options.short_wave = 8e-6;
  const Surface column = self_affine_surface(options);
  EXPECT_NEAR(rms(column.heights()), 1e-6, 1e-18);
  options.grid = Grid{257, 1, 514e-6, 2e-6};
  const Surface row = self_affine_surface(options);
  EXPECT_NEAR(rms(row.heights()), 1e-6, 1e-18);
}

TEST(SelfAffine, TwoCellsAreTheShortestWave) {
  SelfAffineOptions options = example(64, 64);
  options.short_wave = 2 * options.grid.hx();
  EXPECT_NEAR(rms(self_affine_surface(options).heights()), 1e-6, 1e-18);
  options.short_wave = 20e-6;
  EXPECT_EQ(refusal(options),
            "`short_wave` is 20 um, under two cells of 15.63 um; give at least 31.25 um, or more `cells`");
  options.short_wave = 2 * options.grid.hx() * (1 - 1e-9);
  EXPECT_EQ(refusal(options).substr(0, 49), "`short_wave` is 31.25 um, under two cells of 15.6");
  options = example(64, 32);
  EXPECT_EQ(refusal(options).substr(0, 52), "`short_wave` is 41.67 um, under two cells of 31.25 u");
}

TEST(SelfAffine, HeightIsGivenOnce) {
  SelfAffineOptions options = example();
  const std::string hint = "; give exactly one of `rms_height`, `rms_slope`, `ra`";
  options.rms_slope = 0.1;
  EXPECT_EQ(refusal(options), "the height of the surface is given more than once" + hint);
  options.rms_slope.reset();
  options.rms_height.reset();
  EXPECT_EQ(refusal(options),
            "the surface has no height: none of `rms_height`, `rms_slope`, `ra` is given" + hint);
  options.ra = 0;
  EXPECT_EQ(refusal(options), "`ra` is 0; give a finite value above zero");
  options.ra.reset();
  options.rms_slope = std::nan("");
  EXPECT_EQ(refusal(options), "`rms_slope` is nan; give a finite value above zero");
}

TEST(SelfAffine, HurstRange) {
  SelfAffineOptions options = example();
  const std::string hint = "; give a number above 0 and at most 1";
  options.hurst = 0;
  EXPECT_EQ(refusal(options), "`hurst` is 0" + hint);
  options.hurst = -0.5;
  EXPECT_EQ(refusal(options), "`hurst` is -0.5" + hint);
  options.hurst = std::nextafter(1.0, 2.0);
  EXPECT_EQ(refusal(options), "`hurst` is 1" + hint);
  options.hurst = std::nan("");
  EXPECT_EQ(refusal(options), "`hurst` is nan" + hint);
  for (const double good : {1e-9, 0.5, 1.0}) {
    options.hurst = good;
    EXPECT_EQ(refusal(options), "accepted");
  }
}

TEST(SelfAffine, BandIsInOrder) {
  SelfAffineOptions options = example();
  options.long_wave = 2e-3;
  EXPECT_EQ(refusal(options),
            "`long_wave` is 2 mm, longer than the size of 1 mm; a periodic surface has no wave longer than "
            "its size; "
            "give at most 1 mm");
  options.long_wave = 0.2e-3;
  EXPECT_EQ(refusal(options), "`roll_off` is 250 um, longer than `long_wave`, 200 um; give at most 200 um");
  options.roll_off.reset();
  EXPECT_EQ(refusal(options), "accepted");
  options.short_wave = 0.3e-3;
  EXPECT_EQ(refusal(options), "`short_wave` is 300 um, longer than `roll_off`, 200 um; give at most 200 um");
  options.short_wave = 0;
  EXPECT_EQ(refusal(options), "`short_wave` is 0; give a finite value above zero");
  options.long_wave = options.roll_off = 0.49e-3;
  options.short_wave = 0.48e-3;
  EXPECT_EQ(refusal(options),
            "no wave of the surface is between `long_wave`, 490 um, and `short_wave`, 480 um; give a shorter "
            "`short_wave`");
}

}  // namespace
}  // namespace asperity::self_affine_test
