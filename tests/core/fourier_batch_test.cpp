// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of any length in lanes against the defining sum; the same bits in any batch.
#include "engine/core/fourier/fourier_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/random.hpp"

namespace asperity::fourier_batch_test {
namespace {

constexpr int lengths[] = {1, 2, 3, 7, 11, 13, 16, 22, 33, 60, 97, 101, 121, 128, 143, 202, 211};
constexpr int rows = BatchFourier::rows;

struct Signals {
  std::array<Array<double>, rows> values;
  std::array<const double*, rows> in;
  Signals(int n, std::uint64_t seed) {
    const Stream stream(seed, "batch");
    std::uint64_t draw = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      for (int i = 0; i < n; ++i) values[r].push_back(stream.normal(draw++));
      in[r] = values[r].data();
    }
  }
};

struct Spectra {
  std::array<Array<std::complex<double>>, rows> bins;
  std::array<std::complex<double>*, rows> out;
  std::array<const std::complex<double>*, rows> in;
  explicit Spectra(const BatchFourier& batch) {
    for (std::size_t r = 0; r < rows; ++r) {
      bins[r].resize(static_cast<std::size_t>(batch.bins()));
      in[r] = out[r] = bins[r].data();
    }
  }
};

TEST(BatchFourier, RealBinsAreTheSumOfTheDefinition) {
  for (const int n : lengths) {
    const BatchFourier batch(n);
    EXPECT_EQ(batch.length(), n);
    BatchFourier::Work work(batch);
    const Signals signals(n, 1);
    Spectra spectra(batch);
    batch.real_forward(work, signals.in.data(), n, rows, spectra.out.data());
    for (std::size_t r = 0; r < rows; r += 5)
      for (int k = 0; k < batch.bins(); ++k) {
        std::complex<long double> sum = 0;
        for (int i = 0; i < n; ++i)
          sum += std::complex<long double>(signals.values[r][static_cast<std::size_t>(i)]) *
                 std::polar(1.0L, -2 * std::numbers::pi_v<long double> * (static_cast<long>(i) * k % n) / n);
        const std::complex<double> bin = spectra.bins[r][static_cast<std::size_t>(k)];
        ASSERT_LT(static_cast<double>(std::abs(std::complex<long double>(bin) - sum)), 2e-15 * n)
            << n << ", bin " << k << ", signal " << r;
      }
    // Inverse, partial and scaled.
    const int wanted = (n + 1) / 2;
    Signals back(n, 2);
    std::array<double*, rows> to;
    for (std::size_t r = 0; r < rows; ++r) to[r] = back.values[r].data();
    batch.real_inverse(work, spectra.in.data(), rows, wanted, 1.0 / n, to.data());
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t i = 0; i < static_cast<std::size_t>(wanted); ++i)
        ASSERT_NEAR(back.values[r][i], signals.values[r][i], 4e-15 * std::sqrt(n)) << n << ", " << i;
  }
}

TEST(BatchFourier, ZerosFollowTheValuesGiven) {
  for (const int n : {30, 31}) {
    const BatchFourier batch(n);
    BatchFourier::Work work(batch);
    Signals signals(n, 1);
    Spectra given(batch), padded(batch);
    batch.real_forward(work, signals.in.data(), 13, rows, given.out.data());
    for (Array<double>& values : signals.values) std::fill(values.begin() + 13, values.end(), 0.0);
    batch.real_forward(work, signals.in.data(), n, rows, padded.out.data());
    for (std::size_t r = 0; r < rows; ++r) EXPECT_EQ(given.bins[r], padded.bins[r]);
  }
}

TEST(BatchFourier, ColumnsThereAndBack) {
  for (const int n : lengths)
    for (const int count : {1, 3, BatchFourier::columns}) {
      const BatchFourier batch(n);
      BatchFourier::Work work(batch);
      const Stream stream(1, "columns");
      constexpr int stride = 11;
      Array<std::complex<double>> field(static_cast<std::size_t>(n) * stride);
      for (std::size_t k = 0; k < field.size(); ++k)
        field[k] = {stream.normal(2 * k), stream.normal(2 * k + 1)};
      const auto before = field;
      batch.transform(work, field.data(), stride, count, true);
      for (int k = 0; k < n; k += 1 + n / 7) {
        std::complex<long double> sum = 0;
        for (int i = 0; i < n; ++i)
          sum += std::complex<long double>(before[static_cast<std::size_t>(i) * stride]) *
                 std::polar(1.0L, -2 * std::numbers::pi_v<long double> * (static_cast<long>(i) * k % n) / n);
        const std::complex<long double> bin(field[static_cast<std::size_t>(k) * stride]);
        ASSERT_LT(static_cast<double>(std::abs(bin - sum)), 2e-15 * n) << n << ", bin " << k;
      }
      batch.transform(work, field.data(), stride, count, false);
      for (std::size_t k = 0; k < field.size(); ++k) {
        const bool touched = static_cast<int>(k % stride) < count;
        if (touched)
          ASSERT_LT(std::abs(field[k] / static_cast<double>(n) - before[k]), 4e-15 * std::sqrt(n)) << n;
        else
          ASSERT_EQ(field[k], before[k]);
      }
    }
}

TEST(BatchFourier, AnEvenFactorIsAConvolution) {
  for (const int n : {12, 13}) {
    const BatchFourier batch(n);
    BatchFourier::Work work(batch);
    const Signals signals(n, 1);
    Signals out(n, 2);
    std::array<double*, rows> to;
    for (std::size_t r = 0; r < rows; ++r) to[r] = out.values[r].data();
    Array<double> factors(static_cast<std::size_t>(batch.bins()));
    for (std::size_t b = 0; b < factors.size(); ++b)  // of (x[i−1] + x[i+1])/2
      factors[b] = std::cos(2 * std::numbers::pi * static_cast<double>(b) / n) / n;
    batch.load_reals(work, signals.in.data(), n, rows);
    batch.forward(work);
    batch.multiply_even(work, factors.data());
    batch.inverse(work);
    batch.store_reals(work, rows, n, 1, to.data());
    for (std::size_t r = 0; r < rows; ++r)
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int k) { return signals.values[r][static_cast<std::size_t>((k + n) % n)]; };
        ASSERT_NEAR(out.values[r][static_cast<std::size_t>(i)], 0.5 * (at(i - 1) + at(i + 1)), 1e-14);
      }
  }
}

}  // namespace
}  // namespace asperity::fourier_batch_test
