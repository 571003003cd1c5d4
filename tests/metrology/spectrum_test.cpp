// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/spectrum.hpp"

#include <numeric>

#include "engine/core/parallel.hpp"
#include "engine/metrology/dimension_scaling.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::spectrum_test {
namespace {

using testing::error_text;
using testing::make_profile;
using testing::make_surface;

double sum_of_modes(const Spectrum& s) {
  double sum = 0;
  for (std::size_t k = 0; k < s.C.size(); ++k) sum += static_cast<double>(s.count[k]) * s.C[k];
  return sum;
}

// Parseval on even, odd, prime and narrow grids.
TEST(Spectrum, OfAPeriodicSurfaceHoldsItsVariance) {
  const int sizes[][2] = {{64, 64}, {63, 48}, {61, 37}, {1, 50}, {50, 1}, {2, 2}};
  for (const auto& [nx, ny] : sizes) {
    const Surface noise = testing::white_noise(nx, ny, 2e-3, 1e-3, 11);
    const Surface s(noise.grid(), noise.heights(), testing::periodic());
    for (const int bins : {0, 1, 10}) {
      SpectrumOptions options;
      options.bins = bins;
      const Spectrum spectrum_of_s = spectrum(s, options);
      const double Rq = roughness(s).Rq;
      EXPECT_EQ(spectrum_of_s.window, Window::none);
      EXPECT_NEAR(spectrum_of_s.rms_height / Rq, 1, 1e-12) << nx << " " << ny;
      EXPECT_NEAR(sum_of_modes(spectrum_of_s) / s.grid().area() / (Rq * Rq), 1, 1e-12) << nx << " " << ny;
      EXPECT_EQ(std::accumulate(spectrum_of_s.count.begin(), spectrum_of_s.count.end(), std::int64_t{0}),
                nx * ny - 1);
    }
  }
}

// Amplitude A: |z_q|² = A²/4 twice. Shell 5, |q| in [4.5, 5.5), has 28 modes.
TEST(Spectrum, OfOneWave) {
  const int n = 32;
  const double A = 1e-6, L = 1e-3;
  const Spectrum s = spectrum(make_surface(
      n, n, L, L, [&](int i, int j) { return 7e-3 + A * std::cos(2 * pi * (3 * i + 4 * j) / n); },
      testing::periodic()));
  const double q = 2 * pi * 5 / L;
  EXPECT_NEAR(s.rms_height, A / std::sqrt(2.0), 1e-12 * A);
  EXPECT_NEAR(s.rms_slope, q * A / std::sqrt(2.0), 1e-12 * q * A);
  EXPECT_EQ(s.count[4], 28);
  EXPECT_NEAR(s.C[4] / (L * L * A * A / 2 / 28), 1, 1e-11);
  double sum = 0;
  for (int a = -6; a <= 6; ++a)
    for (int b = -6; b <= 6; ++b) {
      const double mode = std::hypot(a, b);
      if (mode >= 4.5 && mode < 5.5) sum += mode;
    }
  EXPECT_NEAR(s.q[4] / (sum / 28 * 2 * pi / L), 1, 1e-12);
  for (std::size_t k = 0; k < s.C.size(); ++k)
    if (k != 4) {
      EXPECT_LT(s.C[k], 1e-20 * s.C[4]);
    }
}

// Variance σ²: C = σ² · cell area (surface) or σ² · spacing (profile), with any window.
TEST(Spectrum, OfWhiteNoiseIsFlatAtItsLevel) {
  const Surface s = testing::white_noise(256, 128, 2.56, 2.56, 2);
  const Array<double> heights(s.heights().values().begin(), s.heights().values().end());
  for (const Window window : {Window::none, Window::hann}) {
    SpectrumOptions options;
    options.window = window;
    options.bins = 6;
    const Spectrum surface_spectrum = spectrum(s, options);
    const Spectrum profile_spectrum = spectrum(Profile(0.01, heights), options);
    // Nearly all modes; a window halves their information.
    const auto check = [](const Spectrum& found, double level) {
      const auto modes = static_cast<double>(found.count.back());
      EXPECT_NEAR(found.C.back() / level, 1, 3 * 2 / std::sqrt(modes));
    };
    check(surface_spectrum, s.grid().cell_area());
    check(profile_spectrum, 0.01);
    EXPECT_NEAR(surface_spectrum.rms_height, 1, 0.02);
  }
}

// Slope -2 - 2H between roll-off and cut-off; exact rms slope.
TEST(Spectrum, OfASelfAffineSurface) {
  SelfAffineOptions options = test::self_affine(make_grid(512, 512, 1e-3, 1e-3), 0.8, 1e-3 / 64);
  options.rms_slope = 0.1;
  options.roll_off = 0.25e-3;
  const Surface surface = self_affine_surface(options);
  const Spectrum s = spectrum(surface);
  EXPECT_NEAR(s.rms_slope, 0.1, 1e-13);
  std::vector<double> x, y;
  for (std::size_t k = 0; k < s.q.size(); ++k) {
    const double mode = s.q[k] * 1e-3 / (2 * pi);
    if (mode < 6 || mode > 60) continue;
    x.push_back(std::log(s.q[k]));
    y.push_back(std::log(s.C[k]));
  }
  const LineFit line = fit_line(x, y);
  EXPECT_NEAR(line.slope, -3.6, 3 * line.slope_error);
  EXPECT_LT(line.slope_error, 0.05);
  for (std::size_t k = 0; k < s.q.size(); ++k)
    if (s.q[k] * 1e-3 / (2 * pi) > 65) {
      EXPECT_LT(s.C[k], 1e-20 * s.C[10]);
    }
}

// The step at the rim fills the spectrum as q^-2 along its axis.
TEST(Spectrum, WindowKeepsTheRimOut) {
  const Surface tilted = make_surface(128, 128, 1, 1, [](int i, int) { return 1.0 * i; });
  SpectrumOptions plain;
  plain.window = Window::none;
  const Spectrum with = spectrum(tilted), without = spectrum(tilted, plain);
  EXPECT_EQ(with.window, Window::hann);
  EXPECT_LT(with.C[40], 1e-4 * without.C[40]);
}

TEST(Spectrum, ScalesWithTheHeights) {
  const auto height = [](int i, int j) { return std::sin(1.0 * i * i + j); };
  const Spectrum one = spectrum(make_surface(16, 12, 1, 1, height));
  const Spectrum tiny =
      spectrum(make_surface(16, 12, 1, 1, [&](int i, int j) { return std::ldexp(height(i, j), -532); }));
  EXPECT_EQ(tiny.rms_height, std::ldexp(one.rms_height, -532));
  EXPECT_EQ(tiny.rms_slope, std::ldexp(one.rms_slope, -532));
  const Spectrum far = spectrum(make_surface(16, 12, 1, 1, [&](int i, int j) { return 1e6 + height(i, j); }));
  EXPECT_NEAR(far.rms_height / one.rms_height, 1, 1e-9);  // rounding of heights near 1e6
}

TEST(Spectrum, OfEqualHeightsIsZeroAndOfOneNodeEmpty) {
  const Spectrum flat = spectrum(make_surface(8, 8, 1, 1, [](int, int) { return 0.1; }));
  EXPECT_EQ(flat.rms_height, 0);
  EXPECT_EQ(flat.rms_slope, 0);
  for (const double C : flat.C) EXPECT_EQ(C, 0);
  EXPECT_TRUE(spectrum(Profile(1, {3.0})).q.empty());
}

TEST(Spectrum, OfAClosedOutlineHasNoWindow) {
  EXPECT_EQ(spectrum(Profile(1, {0, 1, 0, 2}, 3.0)).window, Window::none);
  EXPECT_EQ(spectrum(Profile(1, {0, 1, 0, 2})).window, Window::hann);
}

TEST(Spectrum, SameBitsForAnyNumberOfThreads) {
  const Surface s = testing::white_noise(101, 67, 1, 1, 5);
  set_thread_count(1);
  const Spectrum one = spectrum(s);
  set_thread_count(2);
  const Spectrum two = spectrum(s);
  set_thread_count(0);
  EXPECT_EQ(one.C, two.C);
  EXPECT_EQ(one.rms_slope, two.rms_slope);
}

TEST(Spectrum, RefusesANegativeNumberOfShells) {
  SpectrumOptions options;
  options.bins = -1;
  EXPECT_EQ(error_text([&] {
              spectrum(Profile(1, {0, 1, 0}), options);
            }),
            "`bins` of a spectrum is -1; give 0 for a shell per mode number, or the number of shells of "
            "equal ratio");
}

}  // namespace
}  // namespace asperity::spectrum_test
