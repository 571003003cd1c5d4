// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms against the defining sum, on sizes no fast algorithm likes.
#include "engine/core/fourier/fourier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::fourier_test {
namespace {

using Complex = std::complex<double>;

Field noise(int nx, int ny, std::uint64_t seed = 1) {
  const Stream stream(seed, "fourier test");
  Field field(nx, ny);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = stream.normal(k);
  return field;
}

Complex turn(std::int64_t numerator, std::int64_t denominator) {
  return std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(numerator % denominator) /
                             static_cast<double>(denominator));
}

Complex defining_sum(const Field& f, int a, int b) {
  Complex sum = 0;
  for (int j = 0; j < f.ny(); ++j)
    for (int i = 0; i < f.nx(); ++i)
      sum += f(i, j) * turn(std::int64_t{a} * i, f.nx()) * turn(std::int64_t{b} * j, f.ny());
  return sum;
}

const std::vector<std::pair<int, int>> awkward_sizes = {{1, 1},   {1, 7},   {7, 1},   {2, 2},  {2, 1},
                                                        {1, 2},   {3, 5},   {13, 17}, {16, 9}, {31, 2},
                                                        {10, 64}, {37, 41}, {8, 8}};

TEST(Fourier, EqualsTheDefiningSum) {
  for (const auto& [nx, ny] : awkward_sizes) {
    const Field field = noise(nx, ny);
    const HalfSpectrum spectrum = fourier_forward(field);
    const double scale = std::sqrt(static_cast<double>(field.size()));
    for (int b = 0; b < ny; ++b)
      for (int a = 0; a < spectrum.bins_x(); ++a)
        EXPECT_LT(std::abs(spectrum(a, b) - defining_sum(field, a, b)), 1e-12 * scale)
            << nx << " x " << ny << " bin " << a << ", " << b;
  }
}

TEST(Fourier, InverseUndoesForward) {
  for (const auto& [nx, ny] : awkward_sizes) {
    const Field field = noise(nx, ny);
    const Field back = fourier_inverse(fourier_forward(field));
    ASSERT_EQ(back.nx(), nx);
    ASSERT_EQ(back.ny(), ny);
    for (std::size_t k = 0; k < field.size(); ++k)
      EXPECT_NEAR(back[k], field[k], 1e-14 * 10) << nx << " x " << ny;
  }
}

TEST(Fourier, OneDimensionEqualsTheDefiningSum) {
  for (const int n : {1, 2, 3, 8, 13, 101}) {
    const Field field = noise(n, 1);
    const Array<Complex> bins = fourier_forward(field.values());
    ASSERT_EQ(bins.size(), static_cast<std::size_t>(n / 2 + 1));
    for (int a = 0; a <= n / 2; ++a) EXPECT_LT(std::abs(bins[a] - defining_sum(field, a, 0)), 1e-12 * n);
    const Array<double> back = fourier_inverse(bins, n);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(back[i], field(i, 0), 1e-13);
  }
}

TEST(Fourier, NoValues) {
  EXPECT_TRUE(fourier_forward(std::span<const double>{}).empty());
  EXPECT_TRUE(fourier_inverse(std::span<const Complex>{}, 0).empty());
  EXPECT_THROW(fourier_forward(Field()), Error);
  EXPECT_THROW(fourier_inverse(Array<Complex>(3), 8), Error);
}

TEST(Fourier, WavesFallOnTheirOwnBin) {
  const int nx = 12, ny = 10;
  Field field(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) field(i, j) = std::cos(2 * std::numbers::pi * (3.0 * i / nx - 2.0 * j / ny));
  const HalfSpectrum spectrum = fourier_forward(field);
  for (int b = 0; b < ny; ++b)
    for (int a = 0; a < spectrum.bins_x(); ++a) {
      const bool own = a == 3 && spectrum.wave_y(b) == -2;
      EXPECT_NEAR(std::abs(spectrum(a, b)), own ? nx * ny / 2.0 : 0.0, 1e-12);
    }
}

TEST(Fourier, ImaginaryPartsOfRealBinsAreIgnored) {
  for (const int nx : {7, 8, 13}) {
    const Field field = noise(nx, 6);
    HalfSpectrum spectrum = fourier_forward(field);
    spectrum(0, 0) += Complex(0, 50);
    spectrum(0, 3) += Complex(0, 50);
    if (nx % 2 == 0) spectrum(nx / 2, 0) += Complex(0, 50);
    const Field back = fourier_inverse(std::move(spectrum));
    for (std::size_t k = 0; k < field.size(); ++k) EXPECT_NEAR(back[k], field[k], 1e-13);
  }
}

TEST(Fourier, SameBitsForAnyNumberOfThreads) {
  const Field field = noise(301, 517);
  set_thread_count(1);
  const HalfSpectrum one = fourier_forward(field);
  const Field back_one = fourier_inverse(one);
  for (const int threads : {2, 5}) {
    set_thread_count(threads);
    const HalfSpectrum many = fourier_forward(field);
    const Field back_many = fourier_inverse(many);
    EXPECT_EQ(0, std::memcmp(one.bins().data(), many.bins().data(), one.bins().size_bytes()));
    EXPECT_EQ(0, std::memcmp(back_one.data(), back_many.data(), field.size() * sizeof(double)));
  }
  set_thread_count(0);
}

TEST(Fourier, SameBitsWhereverTheRowsStand) {
  // Rows of odd length start at every alignment.
  Field field(33, 8);
  const Field row = noise(33, 1);
  for (int j = 0; j < 8; ++j) std::copy(row.data(), row.data() + 33, field.row(j).begin());
  const Field back = fourier_inverse(fourier_forward(field));
  const Array<Complex> alone = fourier_forward(row.values());
  for (int j = 0; j < 8; ++j) {
    const Array<Complex> bins = fourier_forward(field.row(j));
    EXPECT_EQ(0, std::memcmp(bins.data(), alone.data(), bins.size() * sizeof(Complex)));
  }
}

TEST(Fourier, EachTransformIsCounted) {
  const Field field = noise(16, 12);
  const CostScope scope;
  const HalfSpectrum spectrum = fourier_forward(field);
  EXPECT_EQ(scope.so_far().transforms, 1.0);
  fourier_inverse(spectrum);
  EXPECT_EQ(scope.so_far().transforms, 2.0);
}

}  // namespace
}  // namespace asperity::fourier_test
