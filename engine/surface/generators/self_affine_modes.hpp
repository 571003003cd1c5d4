// SPDX-License-Identifier: GPL-3.0-or-later
// Unscaled waves of a self-affine surface, drawn from seed and wave numbers.
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
// Applies defaults. Throws Error{bad_value} for options out of range.
SelfAffineBand checked_band(const SelfAffineOptions& options, const Grid& grid);
[[noreturn]] void refuse_empty(const SelfAffineBand& band);
// Scales to the requested height or slope; for `ra` to an rms of 1.
double self_affine_scale(const SelfAffineOptions& options, double rms_height, double rms_slope);

class SelfAffineModes {
 public:
  SelfAffineModes(const SelfAffineOptions& options, const Grid& grid, const SelfAffineBand& band);

  // Waves with b in [-most_b, most_b] are in row b + most_b.
  int rows() const { return 2 * most_b_ + 1; }

  // Calls put(a, b or b + ny, amplitude) for a in [first_a, first_a + count). Rows may run in parallel.
  template <class Put>
  void fill_row(int row, int first_a, int count, Put put) {
    const int b = row - most_b_;
    const int into = b >= 0 ? b : b + grid_.ny;
    const int last = std::min(most_a_, first_a + count - 1);
    double heights = 0, slopes = 0;
    for (int a = first_a; a <= last; ++a) {
      const double wave_number_squared = square(a / grid_.size_x) + square(b / grid_.size_y);  // 1/m², no 2π
      if (!(wave_number_squared >= low_ && wave_number_squared < high_)) continue;
      // Column a = 0 holds both waves of a pair, conjugate to each other.
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

  // Over all waves put.
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
