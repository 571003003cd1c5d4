// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/self_affine_modes.hpp"

#include <algorithm>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

// Relative tolerance for a wave on a bound.
constexpr double on_the_bound = 1e-12;

void check_scale(const SelfAffineOptions& options) {
  const int given =
      int{options.rms_height.has_value()} + int{options.rms_slope.has_value()} + int{options.ra.has_value()};
  if (given != 1)
    refuse(given == 0 ? "the surface has no height: none of `rms_height`, `rms_slope`, `ra` is given"
                      : "the height of the surface is given more than once",
           "give exactly one of `rms_height`, `rms_slope`, `ra`");
  require_positive("rms_height", options.rms_height);
  require_positive("rms_slope", options.rms_slope);
  require_positive("ra", options.ra);
}

}  // namespace

SelfAffineBand checked_band(const SelfAffineOptions& options, const Grid& grid) {
  const double side = std::max(grid.size_x, grid.size_y);
  if (!(options.hurst > 0 && options.hurst <= 1))
    refuse("`hurst` is " + format_short(options.hurst), "give a number above 0 and at most 1");
  check_scale(options);
  SelfAffineBand band{};
  band.long_wave = options.long_wave.value_or(side);
  require_positive("long_wave", band.long_wave);
  band.roll_off = options.roll_off.value_or(band.long_wave);
  require_positive("roll_off", band.roll_off);
  band.short_wave = options.short_wave;
  require_positive("short_wave", band.short_wave);
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

void refuse_empty(const SelfAffineBand& band) {
  refuse("no wave of the surface lies between `long_wave`, " + metres(band.long_wave) +
             ", and `short_wave`, " + metres(band.short_wave),
         "give a shorter `short_wave`");
}

double self_affine_scale(const SelfAffineOptions& options, double rms_height, double rms_slope) {
  if (options.rms_height) return *options.rms_height / rms_height;
  if (options.rms_slope) return *options.rms_slope / rms_slope;
  return 1 / rms_height;
}

SelfAffineModes::SelfAffineModes(const SelfAffineOptions& options, const Grid& grid,
                                 const SelfAffineBand& band)
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

std::complex<double> SelfAffineModes::amplitude(int a, int b, double wave_number_squared) const {
  const auto zigzag = static_cast<std::uint64_t>(b >= 0 ? 2 * std::int64_t{b} : -2 * std::int64_t{b} - 1);
  const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | zigzag;
  const double fall =
      wave_number_squared > roll_ ? elementary::pow(wave_number_squared / roll_, -0.5 * (1 + hurst_)) : 1.0;
  // Complex normal: exponential power, uniform phase.
  const double modulus = std::sqrt(-elementary::log(1.0 - stream_.uniform(2 * key)));
  const elementary::SineCosine phase = elementary::sincos(two_pi * stream_.uniform(2 * key + 1));
  return {fall * modulus * phase.cosine, fall * modulus * phase.sine};
}

}  // namespace asperity
