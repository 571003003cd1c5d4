// SPDX-License-Identifier: GPL-3.0-or-later
// Box contact: cost of the sort, and of a load after it. Run as
//   bench_box_contact --benchmark_counters_tabular=true
// `loads`: a hundred loads after one sort at 150², with scalars and both counts of spots. `library sort`:
// std::sort of the same drops. Peak bytes exclude the surface.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace {

using namespace asperity;

Surface random_heights(int cells) {
  const Stream stream(1, "bench heights");
  Field z(cells, cells);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = stream.normal(k);
  return Surface(Grid{cells, cells, 1, 1}, std::move(z));
}

SpecimenPair bench_pair(int cells) {
  return SpecimenPair(
      Scene{random_heights(cells), rigid_material(), Boundary::free, BoxOptions{1.0}, Accuracy{}});
}

void sort_and_first_load(benchmark::State& run) {
  const SpecimenPair pair = bench_pair(static_cast<int>(run.range(0)));
  double bytes = 0;
  for (auto _ : run) {
    SpecimenPair fresh = pair;
    const State st = fresh.press({PressBy::pressure, 0.01, {}});
    benchmark::DoNotOptimize(st.approach());
    bytes = static_cast<double>(st.cost().total.bytes);
  }
  run.counters["peak_bytes"] = bytes;
}
BENCHMARK(sort_and_first_load)->Arg(150)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void library_sort(benchmark::State& run) {
  const Surface rough = random_heights(static_cast<int>(run.range(0)));
  for (auto _ : run) {
    const auto heights = rough.heights().values();
    Array<double> values(heights.begin(), heights.end());
    std::sort(values.begin(), values.end());
    benchmark::DoNotOptimize(values.data());
  }
}
BENCHMARK(library_sort)->Arg(150)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void loads(benchmark::State& run) {
  SpecimenPair pair = bench_pair(static_cast<int>(run.range(0)));
  const bool with_spots = run.range(1) != 0;
  pair.press({PressBy::pressure, 0.01, {}});
  constexpr int count = 100;
  for (auto _ : run)
    for (int k = 1; k <= count; ++k) {
      const State st = pair.press({PressBy::pressure, 0.001 * k, {}});
      benchmark::DoNotOptimize(st.area_fraction() + st.mean_gap() + st.energy() + st.secant_stiffness());
      if (with_spots) benchmark::DoNotOptimize(st.spots() + st.spots8());
    }
  run.counters["s_per_load"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(loads)
    ->ArgNames({"cells", "spots"})
    ->Args({150, 0})
    ->Args({150, 1})
    ->Args({1024, 0})
    ->Args({4096, 0});

void pressure_field(benchmark::State& run) {
  SpecimenPair pair = bench_pair(static_cast<int>(run.range(0)));
  pair.press({PressBy::pressure, 0.01, {}});
  for (auto _ : run) {
    const State st = pair.press({PressBy::pressure, 0.01, {}});
    benchmark::DoNotOptimize(st.field("pressure")->data());
  }
}
BENCHMARK(pressure_field)->Arg(150)->Arg(4096)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
