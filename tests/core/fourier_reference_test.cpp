// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of lengths 1 to 1100 in both precisions against double-precision FFTW.
#include <fftw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/fourier/fourier_lane_filter.hpp"
#include "engine/core/fourier/fourier_lanes.hpp"

namespace asperity::fourier_reference_test {
namespace {

constexpr int longest = 1100;
using Complex = std::complex<double>;

std::vector<double> noise(int n) {
  const Stream stream(static_cast<std::uint64_t>(n), "reference");
  std::vector<double> values(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = stream.normal(k);
  return values;
}

fftw_complex* raw(std::vector<Complex>& values) { return reinterpret_cast<fftw_complex*>(values.data()); }

// ny rows of nx values to ny rows of nx/2 + 1 bins.
std::vector<Complex> by_fftw(std::vector<double> values, int nx, int ny) {
  std::vector<Complex> bins(static_cast<std::size_t>(nx / 2 + 1) * static_cast<std::size_t>(ny));
  const fftw_plan plan = fftw_plan_dft_r2c_2d(ny, nx, values.data(), raw(bins), FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  return bins;
}

// Both errors grow at most as √length.
double tolerance(double epsilon, double values) {
  return 8 * epsilon * std::sqrt(values) * std::log2(values + 2);
}
constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(AgainstFftw, OneSignalOfEveryLength) {
  for (int n = 1; n <= longest; ++n) {
    const std::vector<double> values = noise(n);
    const std::vector<Complex> expected = by_fftw(values, n, 1);
    const auto bins = fourier_forward(values);
    ASSERT_EQ(bins.size(), expected.size());
    for (std::size_t k = 0; k < bins.size(); ++k)
      ASSERT_LE(std::abs(bins[k] - expected[k]), tolerance(epsilon, n)) << n << ", bin " << k;
    const auto back = fourier_inverse(bins, n);
    for (std::size_t k = 0; k < back.size(); ++k)
      ASSERT_NEAR(back[k], values[k], tolerance(epsilon, n) / std::sqrt(n)) << n;
  }
}

TEST(AgainstFftw, FieldsOfEveryLengthAlongBothSides) {
  for (int n = 1; n <= longest; ++n)
    for (const bool along_x : {true, false}) {
      constexpr int other = 19;  // more rows than a batch
      const int nx = along_x ? n : other, ny = along_x ? other : n;
      const std::vector<double> values = noise(nx * ny);
      const std::vector<Complex> expected = by_fftw(values, nx, ny);
      Field field(nx, ny);
      std::copy(values.begin(), values.end(), field.values().begin());
      HalfSpectrum spectrum = fourier_forward(field);
      const auto bins = spectrum.bins();
      ASSERT_EQ(bins.size(), expected.size());
      for (std::size_t k = 0; k < bins.size(); ++k)
        ASSERT_LE(std::abs(bins[k] - expected[k]), tolerance(epsilon, nx * ny)) << nx << " x " << ny;
      const Field back = fourier_inverse(std::move(spectrum));
      for (std::size_t k = 0; k < back.size(); ++k)
        ASSERT_NEAR(back[k], values[k], tolerance(epsilon, nx * ny) / std::sqrt(nx * ny))
            << nx << " x " << ny;
    }
}

template <class Real>
class InEveryLane : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(InEveryLane, Precisions);

TYPED_TEST(InEveryLane, ComplexSignalsOfEveryLengthWithoutALargePrime) {
  using Real = TypeParam;
  constexpr int lanes = Lanes<Real>::count;
  const double most = static_cast<double>(std::numeric_limits<Real>::epsilon());
  int lengths = 0;
  for (int n = 1; n <= longest; ++n) {
    if (!LaneFourier<Real>::possible(n)) continue;
    ++lengths;
    const LaneFourier<Real> fourier(n);
    const std::vector<double> values = noise(2 * n * lanes);
    const auto value = [&](int k, int l) {
      const auto at = static_cast<std::size_t>(2 * (k * lanes + l));
      return Complex(static_cast<Real>(values[at]), static_cast<Real>(values[at + 1]));
    };
    std::vector<typename Lanes<Real>::Complex> in_lanes(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k)
      for (int l = 0; l < lanes; ++l) {
        in_lanes[static_cast<std::size_t>(k)].re[l] = static_cast<Real>(value(k, l).real());
        in_lanes[static_cast<std::size_t>(k)].im[l] = static_cast<Real>(value(k, l).imag());
      }
    fourier.forward(in_lanes.data());
    std::vector<Complex> signal(static_cast<std::size_t>(n));
    const fftw_plan plan = fftw_plan_dft_1d(n, raw(signal), raw(signal), FFTW_FORWARD, FFTW_ESTIMATE);
    for (int l = 0; l < lanes; ++l) {
      for (int k = 0; k < n; ++k) signal[static_cast<std::size_t>(k)] = value(k, l);
      fftw_execute(plan);
      for (int k = 0; k < n; ++k) {
        const auto& bin = in_lanes[static_cast<std::size_t>(fourier.place(k))];
        ASSERT_LE(std::abs(Complex(bin.re[l], bin.im[l]) - signal[static_cast<std::size_t>(k)]),
                  tolerance(most, 2 * n))
            << n << ", bin " << k << ", lane " << l;
      }
    }
    fftw_destroy_plan(plan);
    fourier.inverse(in_lanes.data());
    for (int k = 0; k < n; ++k)
      for (int l = 0; l < lanes; ++l) {
        const auto& back = in_lanes[static_cast<std::size_t>(k)];
        ASSERT_LE(std::abs(Complex(back.re[l], back.im[l]) / static_cast<double>(n) - value(k, l)),
                  tolerance(most, 2 * n) / std::sqrt(n))
            << n;
      }
  }
  EXPECT_EQ(lengths, 463);
}

// As in contacts, forward and inverse.
TYPED_TEST(InEveryLane, FiltersOfEveryPeriod) {
  using Real = TypeParam;
  const auto factor = [](int a, int b) { return 1 / (1.0 + 0.01 * a + 0.3 * b); };
  const double most = static_cast<double>(std::numeric_limits<Real>::epsilon());
  for (int n = 1; n <= longest; ++n)
    for (const bool along_x : {true, false}) {
      const int nx = along_x ? n : 6, ny = along_x ? 6 : n;
      if (!FourierLaneFilter<Real>::possible(nx, ny)) continue;
      const std::vector<double> values = noise(nx * ny);
      std::vector<Complex> bins = by_fftw(values, nx, ny);
      for (int b = 0; b < ny; ++b)
        for (int a = 0; a <= nx / 2; ++a)
          bins[static_cast<std::size_t>(b * (nx / 2 + 1) + a)] *= factor(a, std::min(b, ny - b)) / (nx * ny);
      std::vector<double> expected(values.size()), out(values.size());
      const fftw_plan plan = fftw_plan_dft_c2r_2d(ny, nx, raw(bins), expected.data(), FFTW_ESTIMATE);
      fftw_execute(plan);
      fftw_destroy_plan(plan);
      FourierLaneFilter<Real> filter(nx, ny, nx, ny, [&](int a, std::span<double> factors) {
        for (std::size_t b = 0; b < factors.size(); ++b) factors[b] = factor(a, static_cast<int>(b));
      });
      filter.apply(values, out);
      for (std::size_t k = 0; k < out.size(); ++k)
        ASSERT_NEAR(out[k], expected[k], tolerance(most, nx * ny) / std::sqrt(nx * ny)) << nx << " x " << ny;
    }
}

}  // namespace
}  // namespace asperity::fourier_reference_test
