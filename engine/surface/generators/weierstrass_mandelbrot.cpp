// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/exact_phase.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/generators/plane_waves.hpp"
#include "engine/surface/generators/recalled_heights.hpp"

namespace asperity {

namespace {

[[noreturn]] void refuse(const char* key, double found, const char* wanted) {
  throw Error(ErrorCode::bad_value, quoted(key) + " is " + format_exact(found), wanted);
}

Grid check(const WeierstrassMandelbrotOptions& o) {
  if (!(o.D >= 2 && o.D <= 3)) refuse("D", o.D, "give a fractal dimension from 2 to 3");
  if (!(std::isfinite(o.L) && o.L > 0)) refuse("L", o.L, "give a finite length above zero");
  if (!(std::isfinite(o.G) && o.G > 0)) refuse("G", o.G, "give a finite length above zero");
  if (!(std::isfinite(o.span) && o.span > 0)) refuse("span", o.span, "give a finite number above 0");
  if (o.phases == WavePhases::function && !o.phase_function)
    throw Error(ErrorCode::bad_value, "`phases` asks for a function and has none",
                "give a function of m and n that returns radians");
  const double size_x = o.span * o.L;
  if (!(std::isfinite(size_x) && size_x > 0))
    throw Error(
        ErrorCode::bad_value,
        "`span` of " + format_exact(o.span) + " times `L` of " + format_exact(o.L) + " m is no length",
        "the size of the surface, span*L, must be finite and above zero");
  const double size_y = o.nx == o.ny ? size_x : size_x * o.ny / o.nx;
  return make_grid(o.nx, o.ny, size_x, size_y);
}

// γ^((D−3)n) without γⁿ; 0 on underflow.
double relative_amplitude(double D, double log_gamma, int n) {
  return elementary::exp((D - 3.0) * n * log_gamma);
}

// Later waves cannot change a bit of the heights.
int last_audible_order(const WeierstrassMandelbrotOptions& o) {
  constexpr double inaudible = 0x1p-60;
  const double log_gamma = elementary::log(o.gamma);
  double tail = 0;
  for (int n = o.n_max; n > 0; --n) {
    tail += relative_amplitude(o.D, log_gamma, n);
    if (tail >= inaudible) return n;
  }
  return 0;
}

double phase(const WeierstrassMandelbrotOptions& o, int m, int n) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  switch (o.phases) {
    case WavePhases::seeded:
      return full_turn * seeded_phase_turns(o.seed, o.M, m, n);
    case WavePhases::golden:
      return full_turn * golden_phase_turns(o.n_max, m, n);
    case WavePhases::function:
      break;
  }
  const double radians = o.phase_function(m, n);
  if (!std::isfinite(radians))
    throw Error(ErrorCode::bad_value,
                "`phases`(" + std::to_string(m) + ", " + std::to_string(n) + ") is " + format_short(radians),
                "the function must return a finite number of radians for every m and n");
  return radians;
}

// Amplitudes relative to order 0.
Array<PlaneWave> plane_waves(const WeierstrassMandelbrotOptions& o, const PhaseIncrements& increments,
                             int kept) {
  const double log_gamma = elementary::log(o.gamma);
  const int last = std::min(last_audible_order(o), kept);
  Array<PlaneWave> waves;
  waves.reserve(static_cast<std::size_t>(o.M) * static_cast<std::size_t>(last + 1));
  for (int n = 0; n <= o.n_max; ++n) {
    // A phase function's results must not depend on the grid.
    if (n > last && o.phases != WavePhases::function) break;
    const double amplitude = relative_amplitude(o.D, log_gamma, n);
    for (int m = 1; m <= o.M; ++m) {
      const double radians = phase(o, m, n);
      const std::size_t k = increments.index(m, n);
      if (n <= last) waves.push_back({increments.x[k], increments.y[k], amplitude, radians});
    }
  }
  return waves;
}

// Stores the function's phases for the recipe.
std::function<double(int, int)> remembered(const WeierstrassMandelbrotOptions& o) {
  auto phases = std::make_shared<Array<double>>();
  phases->reserve(static_cast<std::size_t>(o.M) * static_cast<std::size_t>(o.n_max + 1));
  for (int n = 0; n <= o.n_max; ++n)
    for (int m = 1; m <= o.M; ++m) phases->push_back(phase(o, m, n));
  return [phases, M = o.M](int m, int n) {
    return (
        *phases)[static_cast<std::size_t>(n) * static_cast<std::size_t>(M) + static_cast<std::size_t>(m - 1)];
  };
}

Surface summed(const WeierstrassMandelbrotOptions& options, const Grid& grid,
               const PhaseIncrements& increments, int kept, Monitor& monitor) {
  const Array<PlaneWave> waves = plane_waves(options, increments, kept);
  Field heights = recall_or_make(
                      "plane waves",
                      [&] {
                        Digester key;
                        key.add(grid.nx).add(grid.ny);
                        for (const PlaneWave& wave : waves)
                          key.add(static_cast<std::int64_t>(wave.step_x))
                              .add(static_cast<std::int64_t>(wave.step_y))
                              .add(wave.amplitude)
                              .add(wave.phase);
                        return key.hex();
                      },
                      monitor,
                      [&] {
                        return MadeHeights{sum_of_plane_waves(grid.nx, grid.ny, waves, monitor,
                                                              "Weierstrass-Mandelbrot surface")};
                      })
                      .heights;

  // L (G/L)^(D−2) without G/L, which could overflow.
  const double scale = elementary::pow(options.L, 3.0 - options.D) *
                       elementary::pow(options.G, options.D - 2.0) *
                       std::sqrt(elementary::log(options.gamma) / options.M);
  // Makes z(0, 0) exactly zero.
  const double base = heights(0, 0);
  constexpr std::size_t block = 1 << 16;
  const std::span<double> z = heights.values();
  parallel_for(static_cast<std::int64_t>((z.size() + block - 1) / block), [&](std::int64_t b) {
    const std::size_t first = static_cast<std::size_t>(b) * block;
    for (double& value : z.subspan(first, std::min(block, z.size() - first))) value = scale * (base - value);
  });

  SurfaceTraits traits;
  traits.material = options.material;
  traits.periodic = false;
  traits.aliased_share =
      increments.last_resolved >= kept
          ? 0.0
          : share_of_variance_beyond(increments.last_resolved, options.D, options.gamma, kept);
  return Surface(grid, std::move(heights), std::move(traits));
}

}  // namespace

double seeded_phase_turns(std::uint64_t seed, int M, int m, int n) {
  const auto k =
      static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(M) + static_cast<std::uint64_t>(m - 1);
  return unit_interval(splitmix64(seed, k));
}

double golden_phase_turns(int n_max, int m, int n) {
  __extension__ using Wide = unsigned __int128;
  constexpr std::uint64_t ratio = 6180339887498949ULL, one = 10000000000000000ULL;
  const auto k =
      static_cast<std::uint64_t>(m) * static_cast<std::uint64_t>(n_max + 1) + static_cast<std::uint64_t>(n);
  return static_cast<double>(static_cast<std::uint64_t>(static_cast<Wide>(k) * ratio % one)) / 1e16;
}

double share_of_variance_beyond(int last_resolved, double D, double gamma, int n_max) {
  const double log_gamma = elementary::log(gamma);
  double all = 0, beyond = 0;
  for (int n = n_max; n >= 0; --n) {
    const double amplitude = relative_amplitude(D, log_gamma, n);
    all += amplitude * amplitude;
    if (n == last_resolved + 1) beyond = all;
  }
  return beyond / all;
}

Surface weierstrass_mandelbrot(const WeierstrassMandelbrotOptions& options, Monitor& monitor) {
  const Grid grid = check(options);
  const PhaseIncrements increments =
      phase_increments(options.gamma, options.span, options.nx, options.M, options.n_max);
  if (options.band == WaveBand::resolved && increments.last_resolved < 0)
    throw Error(ErrorCode::bad_value,
                "`band` = \"resolved\" leaves no wave: with " + std::to_string(options.nx) +
                    " cells over a span of " + format_short(options.span) +
                    " even n = 0 turns more than half a turn per cell",
                "give more cells, a shorter span, or band = \"all\"");

  WeierstrassMandelbrotOptions same = options;
  if (options.phases == WavePhases::function) same.phase_function = remembered(options);
  const int kept =
      options.band == WaveBand::resolved ? std::min(options.n_max, increments.last_resolved) : options.n_max;
  Surface surface = summed(same, grid, increments, kept, monitor);
  same.material.reset();
  return surface.made_by([same, grid, kept](int nx, int ny, Monitor& watching) {
    if (std::int64_t{nx} * grid.ny != std::int64_t{ny} * grid.nx)
      throw Error(ErrorCode::bad_value, "the cells would not be square",
                  "keep the proportion of the cells along x and y");
    const Grid other = make_grid(nx, ny, grid.size_x, grid.size_y);
    return summed(same, other, phase_increments(same.gamma, same.span, nx, same.M, same.n_max), kept,
                  watching);
  });
}

}  // namespace asperity
