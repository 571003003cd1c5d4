// SPDX-License-Identifier: GPL-3.0-or-later
// The waves of a self-affine surface before they are scaled, drawn one by one from the seed and their wave
// numbers, for generators that hold all of the spectrum or a part of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/memory.hpp"
#include "engine/surface/generators/self_affine.hpp"

namespace asperity {

struct SelfAffineBand {
  double long_wave, roll_off, short_wave;  // m
};
// The wavelengths with their defaults. Throws Error{bad_value} for an option out of range.
SelfAffineBand checked_band(const SelfAffineOptions& options, const Grid& grid);
// Of a band that no wave of the tile lies in.
[[noreturn]] void refuse_empty(const SelfAffineBand& band);
// What brings waves of these sums to the height or slope asked for; to an rms of 1 where it is `ra`.
double self_affine_scale(const SelfAffineOptions& options, double rms_height, double rms_slope);

// Amplitudes, and their sums.
class SelfAffineModes {
 public:
  SelfAffineModes(const SelfAffineOptions& options, const Grid& grid, const SelfAffineBand& band);

  // Waves with b in [-most_b, most_b], row b + most_b of rows().
  int rows() const { return 2 * most_b_ + 1; }

  // put(a, b or b + ny, amplitude) for the waves of a row with a in [first_a, first_a + count), and their
  // share of the sums. Rows from several threads.
  template <class Put>
  void fill_row(int row, int first_a, int count, Put put) {
    const int b = row - most_b_;
    const int into = b >= 0 ? b : b + grid_.ny;
    const int last = std::min(most_a_, first_a + count - 1);
    double heights = 0, slopes = 0;
    for (int a = first_a; a <= last; ++a) {
      const double wave_number_squared = square(a / grid_.size_x) + square(b / grid_.size_y);  // 1/m², no 2π
      if (!(wave_number_squared >= low_ && wave_number_squared < high_)) continue;
      // The column a = 0 holds both waves of each pair; the second is the conjugate of the first.
      const std::complex<double> z = a == 0 && b < 0 ? std::conj(amplitude(0, -b, wave_number_squared))
                                                     : amplitude(a, b, wave_number_squared);
      put(a, into, z);
      const double share = (a == 0 ? 1 : 2) * std::norm(z);
      heights += share;
      slopes += share * wave_number_squared;
    }
    heights_[static_cast<std::size_t>(row)] = heights;
    slopes_[static_cast<std::size_t>(row)] = slopes;
  }

  // Of the waves that were put.
  double mean_square_height() const { return block_sum(heights_); }
  double mean_square_slope() const { return square(2 * std::numbers::pi) * block_sum(slopes_); }
  double rms_height() const { return std::sqrt(block_sum(heights_)); }
  double rms_slope() const { return 2 * std::numbers::pi * std::sqrt(block_sum(slopes_)); }

 private:
  static double square(double x) { return x * x; }
  std::complex<double> amplitude(int a, int b, double wave_number_squared) const;

  Grid grid_;
  Stream stream_;
  double hurst_, low_, roll_, high_;
  int most_a_, most_b_;
  Array<double> heights_, slopes_;
};

}  // namespace asperity
