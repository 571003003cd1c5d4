// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/exact_phase.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/generators/recalled_heights.hpp"
#include "engine/surface/generators/table_product.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace {

// All waves of one pair of steps, up to signs:
// cc·cosα·cosβ + cs·cosα·sinβ + sc·sinα·cosβ + ss·sinα·sinβ, with α along x and β along y.
struct Standing {
  std::uint64_t step_x = 0, step_y = 0;  // at most half a turn
  double cc = 0, cs = 0, sc = 0, ss = 0;
};

Standing standing(const PlaneWave& wave) {
  constexpr std::uint64_t half_turn = std::uint64_t{1} << 63;
  const elementary::SineCosine phase = elementary::sincos(wave.phase);
  const double c = wave.amplitude * phase.cosine;
  const double s = wave.amplitude * phase.sine;
  Standing w{wave.step_x, wave.step_y, c, -s, -s, -c};
  if (w.step_x > half_turn) {
    w.step_x = 0 - w.step_x;
    w.sc = -w.sc;
    w.ss = -w.ss;
  }
  if (w.step_y > half_turn) {
    w.step_y = 0 - w.step_y;
    w.cs = -w.cs;
    w.ss = -w.ss;
  }
  return w;
}

// Sorted, duplicates added: waves along y, then x, then the others.
Array<Standing> standing_waves(std::span<const PlaneWave> waves) {
  Array<Standing> sorted;
  sorted.reserve(waves.size());
  for (const PlaneWave& wave : waves) sorted.push_back(standing(wave));
  std::stable_sort(sorted.begin(), sorted.end(), [](const Standing& a, const Standing& b) {
    return std::tuple(a.step_x != 0, a.step_y != 0, a.step_x, a.step_y) <
           std::tuple(b.step_x != 0, b.step_y != 0, b.step_x, b.step_y);
  });
  std::size_t kept = 0;
  for (const Standing& w : sorted) {
    if (kept > 0 && sorted[kept - 1].step_x == w.step_x && sorted[kept - 1].step_y == w.step_y) {
      Standing& same = sorted[kept - 1];
      same.cc += w.cc;
      same.cs += w.cs;
      same.sc += w.sc;
      same.ss += w.ss;
    } else {
      sorted[kept++] = w;
    }
  }
  sorted.resize(kept);
  return sorted;
}

struct Mix {
  double of_cosine = 0, of_sine = 0;
};

// At phases 0, step, 2·step … i = coarse + fine: both phases are exact, and the addition theorem saves a sine
// and a cosine.
void fill_rows(std::uint64_t step, int count, Mix first, double* first_row, Mix second, double* second_row) {
  constexpr int longest = 256;
  static_assert(longest * longest >= max_cells);
  const int block = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::sqrt(count))));
  std::array<double, longest> cosine, sine;
  const int fine = std::min(block, count);
  for (int b = 0; b < fine; ++b) {
    const UnitPhase p = unit_phase(step * static_cast<std::uint64_t>(b));
    cosine[b] = p.cosine;
    sine[b] = p.sine;
  }
  for (int start = 0; start < count; start += block) {
    const UnitPhase p = unit_phase(step * static_cast<std::uint64_t>(start));
    const double a1 = first.of_cosine * p.cosine + first.of_sine * p.sine;
    const double b1 = first.of_sine * p.cosine - first.of_cosine * p.sine;
    const double a2 = second.of_cosine * p.cosine + second.of_sine * p.sine;
    const double b2 = second.of_sine * p.cosine - second.of_cosine * p.sine;
    const int here = std::min(block, count - start);
    for (int b = 0; b < here; ++b) {
      first_row[start + b] = a1 * cosine[b] + b1 * sine[b];
      second_row[start + b] = a2 * cosine[b] + b2 * sine[b];
    }
  }
}

void add(Array<double>& sum, const Array<double>& row) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += row[k];
}

std::size_t sum_axis_waves(std::span<const Standing> waves, Array<double>& along_x, Array<double>& along_y) {
  const std::size_t longer = std::max(along_x.size(), along_y.size());
  Array<double> row(longer), unused(longer);
  std::size_t k = 0;
  for (; k < waves.size() && (waves[k].step_x == 0 || waves[k].step_y == 0); ++k) {
    stop_flag().check();
    const Standing& w = waves[k];
    const bool is_y = w.step_x == 0;
    Array<double>& sum = is_y ? along_y : along_x;
    fill_rows(is_y ? w.step_y : w.step_x, static_cast<int>(sum.size()), {w.cc, is_y ? w.cs : w.sc},
              row.data(), {}, unused.data());
    add(sum, row);
  }
  return k;
}

constexpr int tile = 240;  // nodes a side
static_assert(tile % table_product::row_step == 0 && tile % table_product::column_step == 0);
constexpr std::int64_t tiles_between_looks = 64;

std::int64_t waves_at_once(int nx, int ny) {
  constexpr std::int64_t table_doubles = std::int64_t{1} << 22;
  constexpr std::int64_t most = 256, fewest = 32;
  return std::clamp(table_doubles / (2 * (std::int64_t{nx} + ny)), fewest, most);
}

std::int64_t whole_steps(std::int64_t count, int step) { return (count + step - 1) / step * step; }

// Partial steps use a larger temporary tile.
void add_tile(const double* left, std::int64_t left_stride, const double* right, std::int64_t right_stride,
              int depth, double* heights, std::int64_t stride, int rows, int columns) {
  const auto all_rows = static_cast<int>(whole_steps(rows, table_product::row_step)),
             all_columns = static_cast<int>(whole_steps(columns, table_product::column_step));
  if (all_rows == rows && all_columns == columns) {
    table_product::add(rows, columns, depth, left, left_stride, right, right_stride, heights, stride);
    return;
  }
  Array<double> larger(static_cast<std::size_t>(all_rows) * static_cast<std::size_t>(all_columns));
  for (int b = 0; b < columns; ++b)
    std::copy_n(heights + b * stride, rows, larger.data() + std::ptrdiff_t{b} * all_rows);
  table_product::add(all_rows, all_columns, depth, left, left_stride, right, right_stride, larger.data(),
                     all_rows);
  for (int b = 0; b < columns; ++b)
    std::copy_n(larger.data() + std::ptrdiff_t{b} * all_rows, rows, heights + b * stride);
}

[[noreturn]] void refuse_value(const char* key, double found, const char* wanted) {
  refuse(quoted(key) + " is " + format_exact(found), wanted);
}

Grid check(const WeierstrassMandelbrotOptions& o) {
  if (!(o.D >= 2 && o.D <= 3)) refuse_value("D", o.D, "give a fractal dimension from 2 to 3");
  if (!(std::isfinite(o.L) && o.L > 0)) refuse_value("L", o.L, "give a finite length above zero");
  if (!(std::isfinite(o.G) && o.G > 0)) refuse_value("G", o.G, "give a finite length above zero");
  if (!(std::isfinite(o.span) && o.span > 0)) refuse_value("span", o.span, "give a finite number above 0");
  if (o.phases == WavePhases::function && !o.phase_function)
    refuse("`phases` asks for a function and has none", "give a function of m and n that returns radians");
  const double size_x = o.span * o.L;
  if (!(std::isfinite(size_x) && size_x > 0))
    refuse("`span` of " + format_exact(o.span) + " times `L` of " + format_exact(o.L) + " m is no length",
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
  if (o.phases == WavePhases::seeded) return full_turn * seeded_phase_turns(o.seed, o.M, m, n);
  if (o.phases == WavePhases::golden) return full_turn * golden_phase_turns(o.n_max, m, n);
  const double radians = o.phase_function(m, n);
  if (!std::isfinite(radians))
    refuse("`phases`(" + std::to_string(m) + ", " + std::to_string(n) + ") is " + format_short(radians),
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
    stop_flag().check();
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
  for_each_block(z.size(), block, [&](std::size_t first, std::size_t last) {
    for (double& value : z.subspan(first, last - first)) value = scale * (base - value);
  });

  const double aliased_share =
      increments.last_resolved >= kept
          ? 0.0
          : share_of_variance_beyond(increments.last_resolved, options.D, options.gamma, kept);
  return Surface(grid, std::move(heights), {.material = options.material, .aliased_share = aliased_share});
}

}  // namespace

Field sum_of_plane_waves(int nx, int ny, std::span<const PlaneWave> waves, Monitor& monitor,
                         std::string_view what) {
  const Array<Standing> all = standing_waves(waves);
  Array<double> along_x(static_cast<std::size_t>(nx)), along_y(static_cast<std::size_t>(ny));
  const std::size_t axis_waves = sum_axis_waves(all, along_x, along_y);
  const std::span<const Standing> oblique = std::span(all).subspan(axis_waves);

  const auto count = static_cast<std::int64_t>(oblique.size());
  const std::int64_t most = waves_at_once(nx, ny);
  const std::int64_t passes = std::max<std::int64_t>((count + most - 1) / most, 1);
  const std::int64_t width = (count + passes - 1) / passes;

  Field field(nx, ny);
  const std::int64_t stride_x = whole_steps(nx, table_product::row_step),
                     stride_y = whole_steps(ny, table_product::column_step);
  Array<double> table_x(static_cast<std::size_t>(2 * width * stride_x)),
      table_y(static_cast<std::size_t>(2 * width * stride_y));
  const std::int64_t tiles_x = (nx + tile - 1) / tile, tiles_y = (ny + tile - 1) / tile;
  const std::int64_t tiles = tiles_x * tiles_y;
  Task task(monitor, what, passes * tiles);

  for (std::int64_t pass = 0; pass < passes; ++pass) {
    const std::int64_t first = pass * width, here = std::min(width, count - first);
    parallel_for(here, [&](std::int64_t k) {
      const Standing& w = oblique[static_cast<std::size_t>(first + k)];
      double* x = table_x.data() + 2 * k * stride_x;
      double* y = table_y.data() + 2 * k * stride_y;
      fill_rows(w.step_x, nx, {1, 0}, x, {0, 1}, x + stride_x);
      fill_rows(w.step_y, ny, {w.cc, w.cs}, y, {w.sc, w.ss}, y + stride_y);
    });
    for (std::int64_t band = 0; band < tiles; band += tiles_between_looks) {
      const std::int64_t in_band = std::min(tiles_between_looks, tiles - band);
      parallel_for(in_band, [&](std::int64_t t) {
        const std::int64_t i = (band + t) % tiles_x * tile, j = (band + t) / tiles_x * tile;
        const std::int64_t ni = std::min<std::int64_t>(tile, nx - i),
                           nj = std::min<std::int64_t>(tile, ny - j);
        // Column j of the product is row j of the field.
        if (pass == 0)
          for (std::int64_t b = 0; b < nj; ++b)
            for (std::int64_t a = 0; a < ni; ++a)
              field.data()[(j + b) * nx + i + a] =
                  along_x[static_cast<std::size_t>(i + a)] + along_y[static_cast<std::size_t>(j + b)];
        if (here > 0)
          add_tile(table_x.data() + i, stride_x, table_y.data() + j, stride_y, static_cast<int>(2 * here),
                   field.data() + j * nx + i, nx, static_cast<int>(ni), static_cast<int>(nj));
      });
      task.advance(in_band);
    }
  }
  return field;
}

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
    refuse("`band` = \"resolved\" leaves no wave: with " + std::to_string(options.nx) +
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
      refuse("the cells would not be square", "keep the proportion of the cells along x and y");
    const Grid other = make_grid(nx, ny, grid.size_x, grid.size_y);
    return summed(same, other, phase_increments(same.gamma, same.span, nx, same.M, same.n_max), kept,
                  watching);
  });
}

}  // namespace asperity
