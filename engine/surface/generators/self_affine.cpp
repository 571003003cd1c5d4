// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/self_affine.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/fourier.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/random.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// A wave whose length differs from a bound by rounding alone lies on the bound.
constexpr double on_the_bound = 1e-12;

std::string metres(double value) { return format_quantity(value, dimension::length); }

[[noreturn]] void refuse(std::string sentence, std::string hint) {
  throw Error(ErrorCode::bad_value, std::move(sentence), std::move(hint));
}

void check_positive(const char* key, double value) {
  if (std::isfinite(value) && value > 0) return;
  refuse(quoted(key) + " is " + format_short(value), "give a finite value above zero");
}

struct Band {
  double long_wave, roll_off, short_wave;
};

Band checked_band(const SelfAffineOptions& options, const Grid& grid) {
  const double side = std::max(grid.size_x, grid.size_y);
  Band band{};
  band.long_wave = options.long_wave.value_or(side);
  check_positive("long_wave", band.long_wave);
  band.roll_off = options.roll_off.value_or(band.long_wave);
  check_positive("roll_off", band.roll_off);
  band.short_wave = options.short_wave;
  check_positive("short_wave", band.short_wave);
  if (band.long_wave > side * (1 + on_the_bound))
    refuse("`long_wave` is " + metres(band.long_wave) + ", longer than the size of " + metres(side),
           "a periodic surface has no wave longer than its size; give at most " + metres(side));
  if (band.roll_off > band.long_wave * (1 + on_the_bound))
    refuse("`roll_off` is " + metres(band.roll_off) + ", longer than `long_wave`, " + metres(band.long_wave),
           "give at most " + metres(band.long_wave));
  if (band.short_wave > band.roll_off * (1 + on_the_bound))
    refuse(
        "`short_wave` is " + metres(band.short_wave) + ", longer than `roll_off`, " + metres(band.roll_off),
        "give at most " + metres(band.roll_off));
  const double cell = std::max(grid.hx(), grid.hy());
  if (band.short_wave < 2 * cell * (1 - 0.1 * on_the_bound))
    refuse("`short_wave` is " + metres(band.short_wave) + ", under two cells of " + metres(cell),
           "give at least " + metres(2 * cell) + ", or more `cells`");
  return band;
}

void check_scale(const SelfAffineOptions& options) {
  const int given =
      int{options.rms_height.has_value()} + int{options.rms_slope.has_value()} + int{options.ra.has_value()};
  if (given != 1)
    refuse(given == 0 ? "the surface has no height: none of `rms_height`, `rms_slope`, `ra` is given"
                      : "the height of the surface is given more than once",
           "give exactly one of `rms_height`, `rms_slope`, `ra`");
  if (options.rms_height) check_positive("rms_height", *options.rms_height);
  if (options.rms_slope) check_positive("rms_slope", *options.rms_slope);
  if (options.ra) check_positive("ra", *options.ra);
}

// The amplitudes before scaling, written into a spectrum, and the sums that scale them.
class Modes {
 public:
  Modes(const SelfAffineOptions& options, const Grid& grid, const Band& band)
      : grid_(grid),
        stream_(options.seed, "self_affine"),
        hurst_(options.hurst),
        low_(square(1 / band.long_wave) * (1 - on_the_bound)),
        roll_(square(1 / band.roll_off)),
        high_(square(1 / band.short_wave) * (1 - on_the_bound)),
        most_a_(static_cast<int>(std::floor(grid.size_x / band.short_wave))),
        most_b_(static_cast<int>(std::floor(grid.size_y / band.short_wave))),
        heights_(static_cast<std::size_t>(most_b_) * 2 + 1),
        slopes_(heights_.size()) {}

  // Waves with b in [-most_b, most_b], row b + most_b of rows().
  int rows() const { return 2 * most_b_ + 1; }

  void fill_row(int row, HalfSpectrum& spectrum) {
    const int b = row - most_b_;
    const int into = b >= 0 ? b : b + spectrum.ny();
    double heights = 0, slopes = 0;
    for (int a = 0; a <= most_a_; ++a) {
      const double wave_number_squared = square(a / grid_.size_x) + square(b / grid_.size_y);  // 1/m², no 2π
      if (!(wave_number_squared >= low_ && wave_number_squared < high_)) continue;
      // The column a = 0 holds both waves of each pair; the second is the conjugate of the first.
      const std::complex<double> z = a == 0 && b < 0 ? std::conj(amplitude(0, -b, wave_number_squared))
                                                     : amplitude(a, b, wave_number_squared);
      spectrum(a, into) = z;
      const double share = (a == 0 ? 1 : 2) * std::norm(z);
      heights += share;
      slopes += share * wave_number_squared;
    }
    heights_[row] = heights;
    slopes_[row] = slopes;
  }

  double rms_height() const { return std::sqrt(block_sum(heights_)); }
  double rms_slope() const { return two_pi * std::sqrt(block_sum(slopes_)); }

 private:
  static double square(double x) { return x * x; }

  std::complex<double> amplitude(int a, int b, double wave_number_squared) const {
    const auto zigzag = static_cast<std::uint64_t>(b >= 0 ? 2 * std::int64_t{b} : -2 * std::int64_t{b} - 1);
    const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | zigzag;
    const double fall =
        wave_number_squared > roll_ ? std::pow(wave_number_squared / roll_, -0.5 * (1 + hurst_)) : 1.0;
    // A complex normal: exponential power, uniform phase.
    const double modulus = std::sqrt(-std::log(1.0 - stream_.uniform(2 * key)));
    return std::polar(fall * modulus, two_pi * stream_.uniform(2 * key + 1));
  }

  Grid grid_;
  Stream stream_;
  double hurst_, low_, roll_, high_;
  int most_a_, most_b_;
  Array<double> heights_, slopes_;
};

}  // namespace

Surface self_affine_surface(const SelfAffineOptions& options, Monitor& monitor) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  if (!(options.hurst > 0 && options.hurst <= 1))
    refuse("`hurst` is " + format_short(options.hurst), "give a number above 0 and at most 1");
  check_scale(options);
  const Band band = checked_band(options, grid);

  Modes modes(options, grid, band);
  HalfSpectrum spectrum(grid.nx, grid.ny);
  constexpr int rows_a_turn = 64;
  constexpr int transform_share = 4;  // in turns, for the progress report only
  const int turns = (modes.rows() + rows_a_turn - 1) / rows_a_turn;
  Task task(monitor, "self-affine surface", turns + 2 * transform_share);
  for (int first = 0; first < modes.rows(); first += rows_a_turn) {
    const int rows = std::min(rows_a_turn, modes.rows() - first);
    parallel_for(rows, [&](std::int64_t k) { modes.fill_row(first + static_cast<int>(k), spectrum); });
    task.advance();
  }
  const double rms_height = modes.rms_height();
  if (rms_height == 0)
    refuse("no wave of the surface lies between `long_wave`, " + metres(band.long_wave) +
               ", and `short_wave`, " + metres(band.short_wave),
           "give a shorter `short_wave`");

  SelfAffineOptions same = options;  // what other cells are filled by: Ra is not met again on each
  double scale = 1 / rms_height;
  if (options.rms_height) scale = *options.rms_height / rms_height;
  if (options.rms_slope) scale = *options.rms_slope / modes.rms_slope();
  const double bin_scale = scale * static_cast<double>(grid.nodes());
  for (std::complex<double>& bin : spectrum.bins()) bin *= bin_scale;
  task.advance(transform_share);
  Field heights = fourier_inverse(std::move(spectrum));
  task.advance(transform_share);

  if (options.ra) {
    Field absolute = heights;
    for (double& z : absolute.values()) z = std::abs(z);
    const double factor = *options.ra / mean(absolute.values());
    for (double& z : heights.values()) z *= factor;
    same.rms_height = factor;  // of waves scaled to an rms of 1
    same.ra.reset();
  }
  SurfaceTraits traits;
  traits.periodic = true;
  traits.aliased_share = 0.0;
  same.long_wave = band.long_wave;
  return Surface(grid, std::move(heights), std::move(traits))
      .made_by([same](int nx, int ny, Monitor& watching) {
        SelfAffineOptions on_other_cells = same;
        on_other_cells.grid.nx = nx;
        on_other_cells.grid.ny = ny;
        return self_affine_surface(on_other_cells, watching);
      });
}

}  // namespace asperity
