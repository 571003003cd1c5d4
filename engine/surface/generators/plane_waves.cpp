// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/plane_waves.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/exact_phase.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/generators/table_product.hpp"

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

// At phases 0, step, 2·step … With i = coarse + fine both phases are exact, and the addition theorem saves
// a sine and a cosine.
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

// Returns the number of waves along an axis.
std::size_t sum_axis_waves(std::span<const Standing> waves, Array<double>& along_x, Array<double>& along_y) {
  const std::size_t longer = std::max(along_x.size(), along_y.size());
  Array<double> row(longer), unused(longer);
  std::size_t k = 0;
  for (; k < waves.size() && (waves[k].step_x == 0 || waves[k].step_y == 0); ++k) {
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

}  // namespace

Field sum_of_plane_waves(int nx, int ny, std::span<const PlaneWave> waves, Monitor& monitor,
                         std::string_view what) {
  const Array<Standing> all = standing_waves(waves);
  Array<double> along_x(static_cast<std::size_t>(nx)), along_y(static_cast<std::size_t>(ny));
  const std::size_t axis_waves = sum_axis_waves(all, along_x, along_y);
  const std::span<const Standing> oblique = std::span(all).subspan(axis_waves);

  // Equal passes avoid a small last pass.
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

}  // namespace asperity
