// SPDX-License-Identifier: GPL-3.0-or-later
// Half-space operators against FFTW's two-dimensional transforms. Run as
//   bench_half_space_operators --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
// Arguments: cells a side, threads. `bare_pair`: in-place r2c and c2r, measured plan, no multiplication.
// `free_compliance`: padded grid of twice the side. Free set of the preconditioner: two fifths of the nodes
// in patches of 8 cells, the longest edge. `signals_by_fftw`, `signals_in_lanes`: complex signals forth and
// back, one or eight at a time; items_per_second counts signals.
#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/fourier/fourier_batch.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"

namespace {

using namespace asperity;

Array<double> smooth_heights(int cells) {
  const Stream stream(1, "bench heights");
  Array<double> z(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = stream.normal(k);
  FourierFilter filter(cells, cells, cells, cells);
  filter.apply(z, z, [cells](int a, std::span<double> factors) {
    for (std::size_t b = 0; b < factors.size(); ++b) {
      const double wave = std::hypot(a, b) / cells;
      factors[b] = wave > 0 && wave < 1.0 / 16 ? std::pow(wave * cells, -1.8) : 0;
    }
  });
  return z;
}

void bare_pair(benchmark::State& run) {
  const auto n = static_cast<int>(run.range(0));
  fftw_init_threads();
  fftw_plan_with_nthreads(static_cast<int>(run.range(1)));
  Array<double> values(static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 2));
  auto* const bins = reinterpret_cast<fftw_complex*>(values.data());
  const fftw_plan forward = fftw_plan_dft_r2c_2d(n, n, values.data(), bins, FFTW_MEASURE);
  const fftw_plan inverse = fftw_plan_dft_c2r_2d(n, n, bins, values.data(), FFTW_MEASURE);
  std::fill(values.begin(), values.end(), 0.0);
  for (auto _ : run) {
    fftw_execute(forward);
    fftw_execute(inverse);
  }
  fftw_destroy_plan(forward);
  fftw_destroy_plan(inverse);
  fftw_plan_with_nthreads(1);
}

void signals_by_fftw(benchmark::State& run) {
  const auto n = static_cast<int>(run.range(0));
  Array<double> values(2 * static_cast<std::size_t>(n));
  auto* const signal = reinterpret_cast<fftw_complex*>(values.data());
  const fftw_plan forward = fftw_plan_dft_1d(n, signal, signal, FFTW_FORWARD, FFTW_MEASURE);
  const fftw_plan inverse = fftw_plan_dft_1d(n, signal, signal, FFTW_BACKWARD, FFTW_MEASURE);
  std::fill(values.begin(), values.end(), 0.0);
  for (auto _ : run) {
    fftw_execute(forward);
    fftw_execute(inverse);
  }
  run.SetItemsProcessed(run.iterations());
  fftw_destroy_plan(forward);
  fftw_destroy_plan(inverse);
}

void signals_in_lanes(benchmark::State& run) {
  const BatchFourier batch(static_cast<int>(run.range(0)));
  BatchFourier::Work work(batch);
  std::fill(work.values.begin(), work.values.end(), BatchFourier::Lane{});
  for (auto _ : run) {
    batch.forward(work);
    batch.inverse(work);
  }
  run.SetItemsProcessed(run.iterations() * BatchFourier::columns);
}

void compliance(benchmark::State& run, Boundary boundary) {
  const auto n = static_cast<int>(run.range(0));
  set_thread_count(static_cast<int>(run.range(1)));
  const Array<double> p = smooth_heights(n);
  Array<double> u(p.size());
  const std::int64_t before = memory::held();
  HalfSpaceCompliance k(n, n, 1, boundary);
  for (auto _ : run) k.apply(p, u);
  run.counters["bytes"] = static_cast<double>(memory::held() - before);
  set_thread_count(0);
}

void periodic_compliance(benchmark::State& run) { compliance(run, Boundary::periodic); }
void free_compliance(benchmark::State& run) { compliance(run, Boundary::free); }

struct FreeSet {
  Array<double> residual;
  Array<std::uint8_t> free;
  explicit FreeSet(int cells) : residual(smooth_heights(cells)), free(residual.size()) {
    Array<double> sorted = residual;
    const auto cut = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 5 * 3);
    std::nth_element(sorted.begin(), cut, sorted.end());
    std::transform(residual.begin(), residual.end(), free.begin(),
                   [cut](double height) { return static_cast<std::uint8_t>(height >= *cut); });
  }
};

void preconditioner(benchmark::State& run) {
  const auto n = static_cast<int>(run.range(0));
  set_thread_count(static_cast<int>(run.range(1)));
  const FreeSet set(n);
  Array<double> z(set.residual.size());
  const std::int64_t before = memory::held();
  ContactPreconditioner m(n, n, 1, Boundary::periodic);
  m.set_free(set.free);
  for (auto _ : run) m.apply(set.residual, z);
  run.counters["bytes"] = static_cast<double>(memory::held() - before);
  set_thread_count(0);
}

void new_free_set(benchmark::State& run) {
  const auto n = static_cast<int>(run.range(0));
  set_thread_count(static_cast<int>(run.range(1)));
  ContactPreconditioner m(n, n, 1, Boundary::periodic);
  const FreeSet set(n);
  for (auto _ : run) m.set_free(set.free);
  set_thread_count(0);
}

void cells_and_threads(benchmark::internal::Benchmark* bench) {
  for (const int cells : {256, 512, 1024, 2048, 4096})
    for (const int threads : {1, 2}) bench->Args({cells, threads});
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(signals_by_fftw)->Arg(512)->Arg(520)->Arg(521);
BENCHMARK(signals_in_lanes)->Arg(512)->Arg(520)->Arg(521);
BENCHMARK(bare_pair)->Apply(cells_and_threads);
BENCHMARK(periodic_compliance)->Apply(cells_and_threads);
BENCHMARK(free_compliance)->Apply(cells_and_threads);
BENCHMARK(preconditioner)->Apply(cells_and_threads);
BENCHMARK(new_free_set)->Apply(cells_and_threads);

}  // namespace

BENCHMARK_MAIN();
