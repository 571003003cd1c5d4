// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/self_affine.hpp"

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/generators/recalled_heights.hpp"

namespace asperity {

namespace {

MadeHeights heights_of(const SelfAffineOptions& options, const Grid& grid, const SelfAffineBand& band,
                       Monitor& monitor) {
  SelfAffineModes modes(options, grid, band);
  HalfSpectrum spectrum(grid.nx, grid.ny);
  constexpr int transform_share = 4;  // in turns, for progress only
  Task task(monitor, "self-affine surface", modes.turns() + 2 * transform_share);
  modes.fill(0, grid.nx, task, [&](int a, int b, std::complex<double> z) { spectrum(a, b) = z; });
  const double rms_height = modes.rms_height();
  if (rms_height == 0) refuse_empty(band);

  const double scale = self_affine_scale(options, rms_height, modes.rms_slope());
  const double bin_scale = scale * static_cast<double>(grid.nodes());
  for (std::complex<double>& bin : spectrum.bins()) bin *= bin_scale;
  task.advance(transform_share);
  MadeHeights made{fourier_inverse(std::move(spectrum))};
  task.advance(transform_share);

  if (options.ra) {
    Field absolute = made.heights;
    for (double& z : absolute.values()) z = std::abs(z);
    made.scale = *options.ra / mean(absolute.values());  // waves have an rms of 1
    for (double& z : made.heights.values()) z *= made.scale;
  }
  return made;
}

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

void require_makeable(const SelfAffineOptions& options) {
  const Grid& grid = options.grid;
  (void)checked_band(options, make_grid(grid.nx, grid.ny, grid.size_x, grid.size_y));
}

Surface self_affine_surface(const SelfAffineOptions& options, Monitor& monitor) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  const SelfAffineBand band = checked_band(options, grid);
  MadeHeights made = recall_or_make(
      "self-affine",
      [&] {
        Digester key;
        key.add(grid.nx).add(grid.ny).add(grid.size_x).add(grid.size_y).add(options.hurst);
        for (const std::optional<double>& height : {options.rms_height, options.rms_slope, options.ra})
          key.add(height.value_or(0));  // positive if given
        key.add(band.long_wave).add(band.roll_off).add(band.short_wave);
        return key.add(static_cast<std::int64_t>(options.seed)).hex();
      },
      monitor, [&] { return heights_of(options, grid, band, monitor); });

  SelfAffineOptions same = options;
  if (options.ra) {
    same.rms_height = made.scale;
    same.ra.reset();
  }
  same.long_wave = band.long_wave;
  return Surface(grid, std::move(made.heights), {.periodic = true, .aliased_share = 0.0})
      .made_by([same](int nx, int ny, Monitor& watching) {
        SelfAffineOptions on_other_cells = same;
        on_other_cells.grid.nx = nx;
        on_other_cells.grid.ny = ny;
        return self_affine_surface(on_other_cells, watching);
      });
}

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
  refuse("no wave of the surface is between `long_wave`, " + metres(band.long_wave) + ", and `short_wave`, " +
             metres(band.short_wave),
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
