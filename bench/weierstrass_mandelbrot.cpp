// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a Weierstrass–Mandelbrot surface (published parameters γ = 1.5, M = 10, n_max = 100: 1010 waves) on
// one thread, against two references of the same run.
//   direct   loop over nodes and waves with std::cos and tables of wave vectors, amplitudes and cos φ. 150²
//            is summed whole; of larger grids 8 even rows, times ny/8.
//   product  Eigen's product nx × 2K by 2K × ny with K = 1010, without tables or phases. The generator can be
//            faster: mirrored waves share columns, waves along an axis need none.
// Run: bench_weierstrass_mandelbrot. Counters: seconds and ratios of the references, peak counted memory in
// MiB (`heights`: the result).
#include <benchmark/benchmark.h>

// GCC 12 warns about undefined registers in its AVX-512 header (GCC bug 105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <Eigen/Core>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/cost.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

namespace {

using asperity::WeierstrassMandelbrotOptions;
using Clock = std::chrono::steady_clock;

WeierstrassMandelbrotOptions published(int cells) {
  WeierstrassMandelbrotOptions options;
  options.nx = options.ny = cells;
  options.D = 2.5;
  return options;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Wave {
  double along_x, along_y, phase, amplitude, base;
};

// Seconds for all rows of the grid.
double direct_sum(const WeierstrassMandelbrotOptions& o, int rows) {
  constexpr double full_turn = 2 * std::numbers::pi;
  std::vector<Wave> waves;
  for (int n = 0; n <= o.n_max; ++n) {
    for (int m = 1; m <= o.M; ++m) {
      const double number = full_turn * std::pow(o.gamma, n) / o.L;
      const double angle = std::numbers::pi * m / o.M;
      const double phase = full_turn * asperity::seeded_phase_turns(o.seed, o.M, m, n);
      const double amplitude = std::pow(o.gamma, (o.D - 3) * n);
      waves.push_back(
          {number * std::cos(angle), number * std::sin(angle), phase, amplitude, std::cos(phase)});
    }
  }
  const double spacing = o.span * o.L / o.nx;
  const double scale = o.L * std::pow(o.G / o.L, o.D - 2) * std::sqrt(std::log(o.gamma) / o.M);
  std::vector<double> row(static_cast<std::size_t>(o.nx));
  const Clock::time_point start = Clock::now();
  for (int r = 0; r < rows; ++r) {
    const double y = spacing * (r * (o.ny / rows));
    for (int i = 0; i < o.nx; ++i) {
      const double x = spacing * i;
      double sum = 0;
      for (const Wave& w : waves)
        sum += w.amplitude * (w.base - std::cos(w.along_x * x + w.along_y * y + w.phase));
      row[static_cast<std::size_t>(i)] = scale * sum;
    }
    benchmark::DoNotOptimize(row.data());
    benchmark::ClobberMemory();
  }
  return seconds_since(start) * o.ny / rows;
}

// Seconds, minimum of `runs`.
double bare_product(int cells, int waves, int runs) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
  const Matrix left = Matrix::Random(cells, 2 * waves);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> right =
      Matrix::Random(2 * waves, cells);
  Matrix result = Matrix::Zero(cells, cells);
  double best = 1e300;
  for (int run = 0; run < runs; ++run) {
    const Clock::time_point start = Clock::now();
    result.noalias() = left * right;
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
    best = std::min(best, seconds_since(start));
  }
  return best;
}

void surface(benchmark::State& state) {
  const auto cells = static_cast<int>(state.range(0));
  const WeierstrassMandelbrotOptions options = published(cells);
  const asperity::SingleThreaded one_thread;
  constexpr double mebibyte = 1024.0 * 1024.0;
  double best = 1e300;
  std::int64_t peak = 0;
  for (auto _ : state) {
    const asperity::CostScope scope;
    const Clock::time_point start = Clock::now();
    const asperity::Surface made = asperity::weierstrass_mandelbrot(options);
    benchmark::DoNotOptimize(made.heights().data());
    best = std::min(best, seconds_since(start));
    peak = scope.so_far().bytes;
  }
  const int rows = cells <= 150 ? cells : 8;
  const double direct = direct_sum(options, rows);
  const double product = bare_product(cells, options.M * (options.n_max + 1), cells > 2000 ? 2 : 5);
  state.counters["direct_s"] = direct;
  state.counters["direct_ratio"] = direct / best;
  state.counters["product_s"] = product;
  state.counters["product_ratio"] = product / best;
  state.counters["peak_MiB"] = static_cast<double>(peak) / mebibyte;
  state.counters["heights_MiB"] = 8.0 * cells * cells / mebibyte;
}

BENCHMARK(surface)->Arg(150)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
