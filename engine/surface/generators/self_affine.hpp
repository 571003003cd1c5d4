// SPDX-License-Identifier: GPL-3.0-or-later
// Periodic Gaussian self-affine surface: plane waves with independent complex normal amplitudes. Power is
// flat from q_L = 2π/long_wave (included) to q_r = 2π/roll_off, falls as |q|^(-2-2H) to q_s = 2π/short_wave
// (excluded), and is zero elsewhere (Persson et al. 2005, J. Phys.: Condens. Matter 17 R1). Amplitudes depend
// only on seed and wave numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <optional>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct SelfAffineOptions {
  Grid grid;
  double hurst = 0;  // H, in (0, 1]
  // Exactly one of the three.
  std::optional<double> rms_height;  // m, population rms of the nodes
  std::optional<double> rms_slope;   // √(Σ |q|² |z_q|²), spectral
  std::optional<double> ra;          // m, mean absolute height
  std::optional<double> long_wave;   // m; default the longer side
  std::optional<double> roll_off;    // m; default long_wave
  double short_wave = 0;             // m, at least two cells
  std::uint64_t seed = 1;
};

// The requested measure is exact; the mean is zero. rms_height and rms_slope scale by waves, so shared nodes
// of two grids agree to rounding; ra scales by nodes, and the recipe fixes its scale. O(n log n), 16 bytes a
// node. Throws Error{bad_value} naming an option out of range.
Surface self_affine_surface(const SelfAffineOptions& options, Monitor& monitor = Monitor::silent());

// Throws as self_affine_surface().
void require_makeable(const SelfAffineOptions& options);

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

  // Progress steps of fill().
  int turns() const { return (rows() + rows_a_turn - 1) / rows_a_turn; }

  // Calls put(a, b or b + ny, amplitude), a in [first_a, first_a + count), rows in parallel.
  template <class Put>
  void fill(int first_a, int count, Task& task, const Put& put) {
    for (int begin = 0; begin < rows(); begin += rows_a_turn, task.advance())
      parallel_for(std::min(rows_a_turn, rows() - begin),
                   [&](std::int64_t k) { fill_row(begin + static_cast<int>(k), first_a, count, put); });
  }

  // Over all waves put.
  double mean_square_height() const { return block_sum(heights_); }
  double mean_square_slope() const { return square(2 * std::numbers::pi) * block_sum(slopes_); }
  double rms_height() const { return std::sqrt(block_sum(heights_)); }
  double rms_slope() const { return 2 * std::numbers::pi * std::sqrt(block_sum(slopes_)); }

 private:
  static constexpr int rows_a_turn = 64;

  // Waves with b in [-most_b, most_b] are in row b + most_b.
  int rows() const { return 2 * most_b_ + 1; }

  template <class Put>
  void fill_row(int row, int first_a, int count, const Put& put) {
    const int b = row - most_b_;
    const int into = b >= 0 ? b : b + grid_.ny;
    const int last = std::min(most_a_, first_a + count - 1);
    double heights = 0, slopes = 0;
    for (int a = first_a; a <= last; ++a) {
      const double wave_number_squared = square(a / grid_.size_x) + square(b / grid_.size_y);  // 1/m², no 2π
      if (!(wave_number_squared >= low_ && wave_number_squared < high_)) continue;
      // Column a = 0 holds conjugate pairs.
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

  static double square(double x) { return x * x; }
  std::complex<double> amplitude(int a, int b, double wave_number_squared) const;

  Grid grid_;
  Stream stream_;
  double hurst_, low_, roll_, high_;
  int most_a_, most_b_;
  Array<double> heights_, slopes_;
};

}  // namespace asperity
