// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/slabs/slab_surface.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/generators/self_affine_modes.hpp"

namespace asperity {

namespace {

// Combines the digests of all slabs.
std::string digest_of(Team& team, const Grid& grid, const Array<double>& heights) {
  Digester own;
  std::array<double, 32> letters{};
  team.work([&] {
    own.add(std::span<const double>(heights));
    const std::string hex = own.hex();
    std::copy(hex.begin(), hex.end(), letters.begin());
  });
  const Array<double> all = team.gather(letters);
  Digester together;
  together.add(grid.nx).add(grid.ny).add(grid.size_x).add(grid.size_y).add(std::span<const double>(all));
  return together.hex();
}

void check_finite(const Slab& slab, const Array<double>& heights) {
  for (std::size_t k = 0; k < heights.size(); ++k)
    if (!std::isfinite(heights[k]))
      refuse("the height of node (" + std::to_string(k % slab.width()) + ", " +
                 std::to_string(static_cast<std::size_t>(slab.first()) + k / slab.width()) + ") is " +
                 format_short(heights[k]),
             "every height must be a finite number of metres");
}

SlabSurface finish(Team& team, const Grid& grid, std::shared_ptr<Array<double>> heights) {
  SlabSurface surface;
  surface.grid = grid;
  surface.slab = team.slab(grid.nx, grid.ny);
  std::array<double, 3> own{0, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::infinity()};
  team.work([&] {
    check_finite(surface.slab, *heights);
    own[0] = block_sum(*heights);
    if (heights->empty()) return;
    const Range between = range(*heights);
    own[1] = between.min;
    own[2] = -between.max;
  });
  const auto found = team.reduce<1, 2>(own);
  const double n = surface.slab.all_nodes();
  surface.mean = found[0] / n;
  surface.valley = found[1];
  surface.peak = -found[2];
  std::array<double, 1> squares{};
  for (const double h : *heights) squares[0] += (h - surface.mean) * (h - surface.mean);
  surface.rms = std::sqrt(team.reduce<1>(squares)[0] / n);
  surface.digest = digest_of(team, grid, *heights);
  surface.heights = std::move(heights);
  return surface;
}

}  // namespace

SlabSurface slab_surface(Team& team, const Grid& asked, const SlabRow& row, Monitor& monitor) {
  const Grid grid = make_grid(asked.nx, asked.ny, asked.size_x, asked.size_y);
  const Slab slab = team.slab(grid.nx, grid.ny);
  std::shared_ptr<Array<double>> heights;
  team.work([&] {
    heights = std::make_shared<Array<double>>(slab.nodes());
    Task task(monitor, "heights in slabs", std::max(1, slab.rows()));
    for (int j = 0; j < slab.rows(); ++j, task.advance())
      row(slab.first() + j, heights->data() + static_cast<std::size_t>(j) * slab.width());
  });
  team.agree();
  return finish(team, grid, std::move(heights));
}

SlabSurface slab_flat(Team& team, const Grid& grid, Monitor& monitor) {
  return slab_surface(
      team, grid, [&](int, double* to) { std::fill_n(to, grid.nx, 0.0); }, monitor);
}

SlabSurface slab_sine(Team& team, const SineOptions& options, Monitor& monitor) {
  const SineFactors factors = sine_factors(options);
  const auto row = [&](int j, double* to) {
    for (std::size_t i = 0; i < factors.x.size(); ++i)
      to[i] = options.amplitude * (factors.x[i] * factors.y[static_cast<std::size_t>(j)]);
  };
  return slab_surface(team, options.grid, row, monitor);
}

SlabSurface slab_self_affine(Team& team, const SelfAffineOptions& options, Monitor& monitor) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  const SelfAffineBand band = checked_band(options, grid);
  const Slab slab = team.slab(grid.nx, grid.ny);
  const std::unique_ptr<SlabFourier> fourier = team.fourier(grid.nx, grid.ny);
  std::array<double, 2> sums{};
  team.work([&] {
    SelfAffineModes modes(options, grid, band);
    const int waves = fourier->waves(), first = fourier->first_wave();
    parallel_for(waves, [&](std::int64_t a) {
      for (int b = 0; b < grid.ny; ++b) fourier->bin(first + static_cast<int>(a), b) = 0;
    });
    constexpr int rows_a_turn = 64;
    Task task(monitor, "self-affine surface in slabs", (modes.rows() + rows_a_turn - 1) / rows_a_turn);
    for (int begin = 0; begin < modes.rows(); begin += rows_a_turn, task.advance())
      parallel_for(std::min(rows_a_turn, modes.rows() - begin), [&](std::int64_t k) {
        modes.fill_row(begin + static_cast<int>(k), first, waves,
                       [&](int a, int b, std::complex<double> z) { fourier->bin(a, b) = z; });
      });
    sums = {modes.mean_square_height(), modes.mean_square_slope()};
  });
  sums = team.reduce<2>(sums);
  if (sums[0] == 0) refuse_empty(band);
  double scale = self_affine_scale(options, std::sqrt(sums[0]), std::sqrt(sums[1]));
  fourier->inverse();
  if (options.ra) {
    std::array<double, 1> absolute{};
    for (int j = 0; j < slab.rows(); ++j)
      for (int i = 0; i < grid.nx; ++i) absolute[0] += std::abs(scale * fourier->row(j)[i]);
    scale *= *options.ra / (team.reduce<1>(absolute)[0] / slab.all_nodes());
  }
  std::shared_ptr<Array<double>> heights;
  team.work([&] {
    heights = std::make_shared<Array<double>>(slab.nodes());
    for (int j = 0; j < slab.rows(); ++j)
      std::transform(fourier->row(j), fourier->row(j) + grid.nx,
                     heights->begin() + static_cast<std::ptrdiff_t>(j) * grid.nx,
                     [scale](double z) { return z * scale; });
  });
  team.agree();
  return finish(team, grid, std::move(heights));
}

}  // namespace asperity
