// SPDX-License-Identifier: GPL-3.0-or-later
// Refining splits the Nyquist wave equally between its signs; coarsening adds both, which inverts refining.
#include "engine/surface/operations/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/core/fourier/fourier.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

// Outside nodes are extrapolated by the parabola through the last three nodes (Keys' boundary condition).

CubicWeights cubic_weights(double place, int n, bool wraps) {
  CubicWeights result;
  if (n == 1) {
    result.weight[0] = 1;
    return result;
  }
  if (!wraps && place >= n - 1) {
    const double t = place - (n - 1);
    result.node = {n - 2, n - 1, 0, 0};
    result.weight = {-t, 1 + t, 0, 0};
    return result;
  }
  const double below = std::floor(place), t = place - below;
  const std::array<double, 4> keys{((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1,
                                   ((-1.5 * t + 2) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
  if (wraps) {
    const int start = static_cast<int>(std::fmod(std::fmod(below, n) + n, n));
    for (int k = 0; k < 4; ++k) {
      result.node[static_cast<std::size_t>(k)] = ((start + k - 1) % n + n) % n;
      result.weight[static_cast<std::size_t>(k)] = keys[static_cast<std::size_t>(k)];
    }
    return result;
  }
  const int start = static_cast<int>(below) - 1;
  const int first = std::clamp(start, 0, std::max(0, n - 4));
  const int held = std::min(n, 4);
  for (int k = 0; k < held; ++k) result.node[static_cast<std::size_t>(k)] = first + k;
  const auto give = [&](int node, double weight) {
    result.weight[static_cast<std::size_t>(node - first)] += weight;
  };
  for (int k = 0; k < 4; ++k) {
    const int node = start + k;
    const double weight = keys[static_cast<std::size_t>(k)];
    if (node >= 0 && node < n) {
      give(node, weight);
      continue;
    }
    const int inward = node < 0 ? 1 : -1;
    const int rim = node < 0 ? 0 : n - 1;
    if (n == 2) {
      give(rim, 2 * weight);
      give(rim + inward, -weight);
    } else {
      give(rim, 3 * weight);
      give(rim + inward, -3 * weight);
      give(rim + 2 * inward, weight);
    }
  }
  return result;
}

double cubic_height(const Field& heights, const CubicWeights& x, const CubicWeights& y, bool holes) {
  double sum = 0;
  for (std::size_t b = 0; b < 4; ++b) {
    if (holes && y.weight[b] == 0) continue;
    double line = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      if (holes && x.weight[a] == 0) continue;
      line += x.weight[a] * heights(x.node[a], y.node[b]);
    }
    sum += y.weight[b] * line;
  }
  return sum;
}

BandWeights mean_weights(double place, double half, int n) {
  half = std::min({half, place, n - place});
  BandWeights result;
  const double low = place - half, high = place + half;
  if (half <= 0) {
    result.first = static_cast<int>(place);
    result.weight = {1.0};
    return result;
  }
  const int last_stretch = std::max(0, n - 2);
  result.first = std::min(static_cast<int>(low), last_stretch);
  const int last = std::min(static_cast<int>(std::ceil(high)), n - 1);
  result.weight.assign(static_cast<std::size_t>(std::max(last, result.first) - result.first + 1), 0.0);
  if (n == 1) {
    result.weight[0] = 1;
    return result;
  }
  for (int k = result.first; k <= std::min(last, last_stretch); ++k) {
    const double from = std::max(low, static_cast<double>(k));
    const double to = k == last_stretch ? high : std::min(high, k + 1.0);
    if (to <= from) continue;
    const double part = (to - from) / (2 * half), t = 0.5 * (from + to) - k;
    const auto at = static_cast<std::size_t>(k - result.first);
    result.weight[at] += part * (1 - t);
    result.weight[at + 1] += part * t;
  }
  return result;
}

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

Field sampled(const Field& heights, int nx, int ny) {
  const auto at = [](int k, int old, int now) {
    return static_cast<int>(static_cast<std::int64_t>(k) * old / now);
  };
  Field result(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) result(i, j) = heights(at(i, heights.nx(), nx), at(j, heights.ny(), ny));
  return result;
}

AtCells at_cells(const Surface& surface, int nx, int ny, Monitor& monitor) {
  const Grid& old = surface.grid();
  const Grid grid = make_grid(nx, ny, old.size_x, old.size_y);
  if (grid == old) return {surface, AtCells::How::unchanged};
  if (old.nx % nx == 0 && old.ny % ny == 0) {
    SurfaceTraits traits = surface.traits();
    traits.aliased_share.reset();
    Surface coarser(grid, sampled(surface.heights(), nx, ny), std::move(traits));
    return {surface.recipe() ? coarser.made_by(*surface.recipe()) : coarser, AtCells::How::sampled};
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
  return remade_with(holes, grid, std::move(heights), {.material = surface.material(), .periodic = periodic});
}

}  // namespace asperity
