// SPDX-License-Identifier: GPL-3.0-or-later
// Correctly rounded functions against the C library, on typical arguments; times for 4096 values.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"

namespace {

using namespace asperity;

template <class Function>
void over(benchmark::State& run, double low, double high, Function function) {
  const Stream stream(1, "bench arguments");
  std::vector<double> arguments(4096);
  for (std::size_t k = 0; k < arguments.size(); ++k) arguments[k] = stream.uniform(k, low, high);
  for (auto _ : run) {
    double sum = 0;
    for (const double x : arguments) sum += function(x);
    benchmark::DoNotOptimize(sum);
  }
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(arguments.size()));
}

#define BESIDE(name, low, high, call_ours, call_theirs)                                              \
  BENCHMARK_CAPTURE(over, name, low, high, [](double x) { return call_ours; })->Name(#name "/ours"); \
  BENCHMARK_CAPTURE(over, name##_c, low, high, [](double x) { return call_theirs; })->Name(#name "/C")

BESIDE(sin, -10, 10, elementary::sin(x), std::sin(x));
BESIDE(cos, -10, 10, elementary::cos(x), std::cos(x));
BESIDE(exp, -30, 10, elementary::exp(x), std::exp(x));
BESIDE(log, 0, 100, elementary::log(x), std::log(x));
BESIDE(pow, 1, 1e4, elementary::pow(x, -0.9), std::pow(x, -0.9));
BESIDE(hypot, 0, 100, elementary::hypot(x, 37), std::hypot(x, 37));
BESIDE(asinh, -3, 3, elementary::asinh(x), std::asinh(x));

void sine_and_cosine(benchmark::State& run, bool ours) {
  over(run, -10, 10, [ours](double x) {
    if (!ours) return std::sin(x) + std::cos(x);
    const elementary::SineCosine both = elementary::sincos(x);
    return both.sine + both.cosine;
  });
}
BENCHMARK_CAPTURE(sine_and_cosine, ours, true)->Name("sincos/ours");
BENCHMARK_CAPTURE(sine_and_cosine, theirs, false)->Name("sincos/C");

}  // namespace

BENCHMARK_MAIN();
