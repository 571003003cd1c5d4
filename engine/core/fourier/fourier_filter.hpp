// SPDX-License-Identifier: GPL-3.0-or-later
// Applies a real, even Fourier multiplier to a real field: after the row transforms, by blocks of columns
// within the cache. Periodic, or zero-padded to a longer period (convolution without wrap-around) without
// stored zero rows. Any period.
#pragma once

#include <complex>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/core/fourier/fourier_batch.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

class FourierFilter {
 public:
  // The factors of waves (a, b), b = 0 … period_y/2, for one a of 0 … period_x/2. Called concurrently.
  using Multiplier = std::function<void(int a, std::span<double> factors)>;

  // 1 <= nx <= period_x, 1 <= ny <= period_y.
  FourierFilter(int nx, int ny, int period_x, int period_y);
  ~FourierFilter();

  // `in` and `out` may be the same. Uses threads but is not thread-safe. Counts no transforms.
  void apply(std::span<const double> in, std::span<double> out, const Multiplier& multiplier);

  int bins_x() const { return period_x_ / 2 + 1; }
  int bins_y() const { return period_y_ / 2 + 1; }

  // Upper bound; little if the transform fits into `out`.
  static std::int64_t bytes(int nx, int ny, int period_x, int period_y);

 private:
  struct Scratch;
  ScratchPool<Scratch>::Loan borrow();
  void rows_forward(std::span<const double> in);
  void columns(const Multiplier& multiplier);
  void multiply_packed(Scratch& scratch, const Multiplier& multiplier) const;
  void rows_inverse(std::span<double> out);
  std::complex<double>* row(int j) { return spectrum_ + static_cast<std::ptrdiff_t>(j) * stride_; }

  int nx_, ny_, period_x_, period_y_;
  // Per row; the real first and (even period) last bins share a place.
  int bins_;
  int stride_;                                // between rows of the spectrum
  std::complex<double>* spectrum_ = nullptr;  // in `out` or in own_
  Array<std::complex<double>> own_;
  const BatchFourier &along_, &across_;
  ScratchPool<Scratch> scratch_;
};

// Smallest even length >= `least` (1 for 1) with prime factors 2, 3, 5 and 7.
int good_fourier_length(int least);

}  // namespace asperity
