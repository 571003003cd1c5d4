// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/self_affine.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/generators/recalled_heights.hpp"
#include "engine/surface/generators/self_affine_modes.hpp"

namespace asperity {

namespace {

// With the rms height for a given Ra.
MadeHeights heights_of(const SelfAffineOptions& options, const Grid& grid, const SelfAffineBand& band,
                       Monitor& monitor) {
  SelfAffineModes modes(options, grid, band);
  HalfSpectrum spectrum(grid.nx, grid.ny);
  constexpr int rows_a_turn = 64;
  constexpr int transform_share = 4;  // in turns, for progress only
  const int turns = (modes.rows() + rows_a_turn - 1) / rows_a_turn;
  Task task(monitor, "self-affine surface", turns + 2 * transform_share);
  for (int first = 0; first < modes.rows(); first += rows_a_turn) {
    const int rows = std::min(rows_a_turn, modes.rows() - first);
    parallel_for(rows, [&](std::int64_t k) {
      modes.fill_row(first + static_cast<int>(k), 0, grid.nx,
                     [&](int a, int b, std::complex<double> z) { spectrum(a, b) = z; });
    });
    task.advance();
  }
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

  SelfAffineOptions same = options;  // for other cells: their scale is fixed
  if (options.ra) {
    same.rms_height = made.scale;
    same.ra.reset();
  }
  same.long_wave = band.long_wave;
  SurfaceTraits traits;
  traits.periodic = true;
  traits.aliased_share = 0.0;
  return Surface(grid, std::move(made.heights), std::move(traits))
      .made_by([same](int nx, int ny, Monitor& watching) {
        SelfAffineOptions on_other_cells = same;
        on_other_cells.grid.nx = nx;
        on_other_cells.grid.ny = ny;
        return self_affine_surface(on_other_cells, watching);
      });
}

}  // namespace asperity
