// SPDX-License-Identifier: GPL-3.0-or-later
// Refining splits the Nyquist wave equally between its signs; coarsening adds both, which inverts refining.
#include "engine/surface/operations/resampling.hpp"

#include <algorithm>
#include <complex>
#include <utility>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/operations/interpolation.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

using Complex = std::complex<double>;

// Any signs; Nyquist waves are halved.
Complex coefficient(const HalfSpectrum& s, int a, int b) {
  const int nx = s.nx(), ny = s.ny();
  const bool mirror = a < 0;
  const int p = mirror ? -a : a, q = mirror ? -b : b;
  if (2 * p > nx || 2 * std::abs(q) > ny) return 0.0;
  const Complex bin = s(p, q < 0 ? q + ny : q);
  const double share = (nx > 1 && 2 * p == nx ? 0.5 : 1.0) * (ny > 1 && 2 * std::abs(q) == ny ? 0.5 : 1.0);
  return share * (mirror ? std::conj(bin) : bin);
}

Field through_spectrum(const Field& heights, int nx, int ny) {
  const HalfSpectrum old = fourier_forward(heights);
  HalfSpectrum fresh(nx, ny);
  const double scale = static_cast<double>(nx) * ny / (static_cast<double>(heights.nx()) * heights.ny());
  for (int b = 0; b < ny; ++b) {
    for (int a = 0; a < fresh.bins_x(); ++a) {
      const int wave_y = fresh.wave_y(b);
      const bool rim_x = nx > 1 && 2 * a == nx, rim_y = ny > 1 && 2 * wave_y == ny;
      Complex sum = coefficient(old, a, wave_y);
      if (rim_x) sum += coefficient(old, -a, wave_y);
      if (rim_y) sum += coefficient(old, a, -wave_y);
      if (rim_x && rim_y) sum += coefficient(old, -a, -wave_y);
      fresh(a, b) = scale * sum;
    }
  }
  return fourier_inverse(std::move(fresh));
}

std::vector<BandWeights> weights(int from, int to) {
  std::vector<BandWeights> result(static_cast<std::size_t>(to));
  const double ratio = static_cast<double>(from) / to;  // old cells per new cell
  for (int k = 0; k < to; ++k) {
    BandWeights& band = result[static_cast<std::size_t>(k)];
    const double place = std::min(k * ratio, static_cast<double>(from));
    if (to < from) {
      band = mean_weights(place, 0.5 * ratio, from);
      continue;
    }
    const CubicWeights cubic = cubic_weights(place, from, false);
    band.first = cubic.node[0];
    band.weight.assign(static_cast<std::size_t>(std::min(4, from - band.first)), 0.0);
    for (std::size_t m = 0; m < 4; ++m)
      if (cubic.weight[m] != 0)
        band.weight[static_cast<std::size_t>(cubic.node[m] - band.first)] += cubic.weight[m];
  }
  return result;
}

// With `holes`, NaN of nonzero weight gives NaN.
Field along_axes(const Field& heights, int nx, int ny, bool holes) {
  const std::vector<BandWeights> across = weights(heights.nx(), nx), up = weights(heights.ny(), ny);
  Field narrow(nx, heights.ny());
  parallel_for(heights.ny(), [&](std::int64_t j) {
    const auto from = heights.row(static_cast<int>(j));
    const auto to = narrow.row(static_cast<int>(j));
    for (std::size_t i = 0; i < to.size(); ++i) {
      const BandWeights& band = across[i];
      double sum = 0;
      for (std::size_t m = 0; m < band.weight.size(); ++m) {
        if (holes && band.weight[m] == 0) continue;
        sum += band.weight[m] * from[static_cast<std::size_t>(band.first) + m];
      }
      to[i] = sum;
    }
  });
  Field result(nx, ny);
  parallel_for(ny, [&](std::int64_t j) {
    const BandWeights& band = up[static_cast<std::size_t>(j)];
    const auto to = result.row(static_cast<int>(j));
    for (std::size_t m = 0; m < band.weight.size(); ++m) {
      if (holes && band.weight[m] == 0) continue;
      const auto from = narrow.row(band.first + static_cast<int>(m));
      for (std::size_t i = 0; i < to.size(); ++i) to[i] += band.weight[m] * from[i];
    }
  });
  return result;
}

}  // namespace

AtCells at_cells(const Surface& surface, int nx, int ny, Monitor& monitor) {
  const Grid& old = surface.grid();
  const Grid grid = make_grid(nx, ny, old.size_x, old.size_y);
  if (grid == old) return {surface, AtCells::How::unchanged};
  if (old.nx % nx == 0 && old.ny % ny == 0) {
    const int step_x = old.nx / nx, step_y = old.ny / ny;
    Field heights(nx, ny);
    for (int j = 0; j < ny; ++j) {
      const std::span<const double> from = surface.heights().row(j * step_y);
      const std::span<double> to = heights.row(j);
      for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i * static_cast<std::size_t>(step_x)];
    }
    SurfaceTraits traits = surface.traits();
    traits.aliased_share.reset();
    Surface sampled(grid, std::move(heights), std::move(traits));
    return {surface.recipe() ? sampled.made_by(*surface.recipe()) : sampled, AtCells::How::sampled};
  }
  if (std::optional<Surface> again = surface.remade(nx, ny, monitor))
    return {*std::move(again), AtCells::How::made_again};
  return {resampled(surface, nx, ny), AtCells::How::interpolated};
}

Surface resampled(const Surface& surface, double nx, double ny) {
  const Grid& old = surface.grid();
  const Grid grid = make_grid(nx, ny, old.size_x, old.size_y);
  if (grid == old) return surface;
  const bool holes = !surface.complete(), periodic = surface.traits().periodic && !holes;
  Field heights = periodic ? through_spectrum(surface.heights(), grid.nx, grid.ny)
                           : along_axes(surface.measured_heights(), grid.nx, grid.ny, holes);
  return remade_with(holes, grid, std::move(heights),
                     {.material = surface.material(), .periodic = periodic, .aliased_share = {}});
}

}  // namespace asperity
