// SPDX-License-Identifier: GPL-3.0-or-later
// Continuous and line spectra, and method `psd`. Weierstrass–Mandelbrot profiles have lines at γⁿ cos θ; in
// the gaps a periodogram shows its window.
#include "engine/metrology/spectrum.hpp"

#include <cmath>

#include "engine/metrology/fractal_dimension.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::spectral_bands_test {
namespace {

FractalDimension by_spectrum(const Surface& surface) {
  FractalDimensionOptions options;
  options.method = DimensionMethod::psd;
  return fractal_dimension(surface, options);
}

Surface lines(double D, int M, double gamma, std::uint64_t seed) {
  WeierstrassMandelbrotOptions options;
  options.nx = options.ny = 512;
  options.D = D;
  options.M = M;
  options.gamma = gamma;
  options.L = 1e-3;
  options.G = 1e-6;
  options.seed = seed;
  options.band = WaveBand::resolved;
  return weierstrass_mandelbrot(options);
}

constexpr double euler = 0.57721566490153286;

// ψ(1) = -γ, ψ(2) = 1 - γ, ψ(3/2) = 2 - γ - 2 ln 2, ψ(11) = H₁₀ - γ; for large ν 1/(2ν) + 1/(12ν²).
TEST(LogMeanDeficit, OfKnownDigammas) {
  EXPECT_NEAR(log_mean_deficit(1), euler, 1e-13);
  EXPECT_NEAR(log_mean_deficit(2), std::log(2.0) - 1 + euler, 1e-13);
  EXPECT_NEAR(log_mean_deficit(1.5), std::log(1.5) - 2 + euler + 2 * std::log(2.0), 1e-13);
  EXPECT_NEAR(log_mean_deficit(11), std::log(11.0) - 7381.0 / 2520 + euler, 1e-13);
  EXPECT_NEAR(log_mean_deficit(1e4), 0.5e-4 + 1e-8 / 12, 1e-14);
}

// ψ'(1) = π²/6, ψ'(3/2) = π²/2 - 4; for large ν 1/ν + 1/(2ν²) + 1/(6ν³).
TEST(LogMeanScatter, OfKnownTrigammas) {
  EXPECT_NEAR(log_mean_scatter(1), pi / std::sqrt(6.0), 1e-14);
  EXPECT_NEAR(log_mean_scatter(1.5), std::sqrt(pi * pi / 2 - 4), 1e-14);
  EXPECT_NEAR(log_mean_scatter(1e4), std::sqrt(1e-4 + 0.5e-8 + 1e-12 / 6), 1e-15);
}

TEST(IndependentOrdinates, AreFewerUnderAHannWindow) {
  for (const bool hann : {false, true}) EXPECT_EQ(independent_ordinates(1, hann), 1);
  EXPECT_EQ(independent_ordinates(40, false), 40);
  EXPECT_DOUBLE_EQ(independent_ordinates(2, true), 18.0 / 13);
  EXPECT_DOUBLE_EQ(independent_ordinates(3, true), 54.0 / 29);
  // 1 + 2·(4/9 + 1/36) = 35/18 ordinates count as one.
  EXPECT_NEAR(independent_ordinates(1 << 20, true) / (1 << 20), 18.0 / 35, 1e-6);
}

// Expected ordinate: Σ window², 3n/8 or n.
TEST(BandLogPowers, OfWhiteNoiseAreRightInTheMean) {
  const int n = 128, count = 2000;
  for (const bool wrap : {false, true}) {
    const std::size_t width = band_wavelengths(n, wrap).size();
    std::vector<double> sum(width), squares(width), one(width);
    for (int p = 0; p < count; ++p) {
      const Surface noise = testing::white_noise(n, 1, 1, 1, static_cast<std::uint64_t>(p) + 1);
      band_log_powers(noise.heights().values(), 1, wrap, one);
      for (std::size_t b = 0; b < width; ++b) {
        sum[b] += one[b] / count;
        squares[b] += one[b] * one[b] / count;
      }
    }
    for (std::size_t b = 0; b < width; ++b)
      EXPECT_NEAR(sum[b], std::log(wrap ? n : 0.375 * n),
                  3 * std::sqrt((squares[b] - sum[b] * sum[b]) / count))
          << b << (wrap ? " without" : " with") << " a window";
  }
}

// Means of four are within 0.1 of D, single surfaces within twice their scatter. Means of logarithms were
// 0.4 (M = 40) and 0.9 (M = 10) too low.
TEST(SpectralDimension, OfWeierstrassMandelbrotSurfaces) {
  for (const int M : {10, 40})
    for (const double D : {2.3, 2.5, 2.7, 2.9}) {
      double sum = 0;
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const FractalDimension d = by_spectrum(lines(D, M, 1.5, seed));
        EXPECT_TRUE(d.resolved) << d.reason;
        EXPECT_NEAR(d.D, D - 1, 2 * d.error) << M << " " << seed;
        sum += d.D / 4;
      }
      EXPECT_NEAR(sum, D - 1, 0.1) << M;
    }
}

// By chance one ordinate may be e^-5.49 below the line, but 43 (22.4 independent) only e^-1.75.
TEST(EmptyBand, IsTheFarthestBelowWhatChanceAllows) {
  const std::vector<SpectralBand> bands = spectral_bands(512, false);
  std::vector<double> above_line(bands.size());
  EXPECT_FALSE(empty_band(512, false, above_line));
  ASSERT_EQ(bands.front().ordinates(), 1);
  above_line.front() = -1 - 3.5 * pi / std::sqrt(6.0) + 1e-12;
  EXPECT_FALSE(empty_band(512, false, above_line));
  above_line.front() -= 2e-12;
  EXPECT_EQ(empty_band(512, false, above_line), 0u);
  const double most = 1 + 3.5 * log_mean_scatter(independent_ordinates(bands[11].ordinates(), true));
  above_line[11] = -most + 1e-12;
  EXPECT_EQ(empty_band(512, false, above_line), 0u);
  above_line[11] = -most - 1e-12;
  EXPECT_EQ(empty_band(512, false, above_line), 0u);
  above_line.front() = 0;
  EXPECT_EQ(empty_band(512, false, above_line), 11u);
  above_line[11] = 50;
  EXPECT_FALSE(empty_band(512, false, above_line));
}

// Bands of ratio √2 fall between lines of ratio 1.5, 3 or 5; equal profiles have no scatter.
TEST(SpectralDimension, SaysWhenBandsLieBetweenLines) {
  const FractalDimension d = by_spectrum(lines(2.5, 1, 1.5, 1));
  EXPECT_FALSE(d.resolved);
  EXPECT_EQ(d.reason.substr(0, 15), "waves of about ") << d.reason;
  EXPECT_NE(d.reason.find(" of the power on the fitted line: the spectrum has gaps, ends or bends; draw "
                          "`spectrum`, or use the method `structure`"),
            std::string::npos)
      << d.reason;
  for (const double gamma : {3.1, 5.2})
    for (const int M : {1, 10}) EXPECT_FALSE(by_spectrum(lines(2.5, M, gamma, 1)).resolved) << gamma;
}

// The shortest wave is 3.9 cells, bands reach three: D = 1.1 instead of 1.5.
TEST(SpectralDimension, SaysWhenASpectrumEnds) {
  SelfAffineOptions options = test::self_affine(make_grid(256, 256, 1e-3, 1e-3), 0.5, 3.9e-3 / 256);
  options.rms_height = 1e-6;
  const FractalDimension d = by_spectrum(Surface(self_affine_surface(options)));
  EXPECT_FALSE(d.resolved);
  EXPECT_EQ(d.reason.substr(0, 32), "waves of about 3.4 samples hold ") << d.reason;
}

TEST(SpectralDimension, OfContinuousSpectraIsResolved) {
  for (const int n : {150, 512, 4096})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      FractalDimensionOptions options;
      options.method = DimensionMethod::psd;
      const FractalDimension d =
          fractal_dimension(Profile(1, testing::fractional_brownian(n, 0.5, seed)), options);
      EXPECT_TRUE(d.resolved) << n << " " << seed << " " << d.reason;
    }
}

// Near the shortest wave, a section loses waves of the isotropic spectrum.
TEST(SpectralDimension, OfSelfAffineSurfaces) {
  for (const double hurst : {0.3, 0.5, 0.8}) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SelfAffineOptions options = test::self_affine(make_grid(512, 512, 1e-3, 1e-3), hurst, 2e-3 / 512, seed);
      options.rms_height = 1e-6;
      const FractalDimension d = by_spectrum(Surface(self_affine_surface(options)));
      EXPECT_TRUE(d.resolved) << d.reason;
      sum += d.D / 4;
    }
    EXPECT_NEAR(sum, 2 - hurst, 0.06);
  }
}

}  // namespace
}  // namespace asperity::spectral_bands_test
