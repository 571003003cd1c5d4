// SPDX-License-Identifier: GPL-3.0-or-later
// Half-space solver against plain conjugate gradients and the bare transform: self-affine surfaces (Hurst
// exponent 0.8, roll-off at the box, shortest wave 16 cells, rms slope h' = 0.1, E* = 1), pressed to a share
// of E* h' until the complementarity is below 1e-8.
//
//   bench_half_space                                   256² … 1024², five seeds
//   bench_half_space sizes=512,2048 seeds=1 threads=2  other settings
//   bench_half_space plain=1024                        plain conjugate gradients up to this size; default 512
//   bench_half_space boundary=free                     the same heights on a free boundary
//   bench_half_space precision=12                      single against double precision: user time and
//                                                      pairs of 12 alternating solves each, by tolerance
//
// Pair: one forward and one backward transform of the finest grid; coarser grids count by n ln n. Plain
// conjugate gradients (Polonsky & Keer 1999) apply the operator twice per iteration. Bare pair: FFTW's
// in-place 2D real transform (measured plan, double precision, free boundaries padded), without
// multiplication; as many as the solve takes, alternating with the solve. Rows marked single have
// single-precision transforms and the usual certificate. Memory: peak of a solve in grids of doubles, without
// heights and result.
#include <fftw3.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/parallel.hpp"
#include "engine/surface/generators/self_affine.hpp"

namespace {

using namespace asperity;

struct Settings {
  std::vector<int> sizes = {256, 512, 1024};
  int seeds = 5;
  int plain = 512;
  int threads = 0;
  int precision = 0;
  Boundary boundary = Boundary::periodic;
};

[[noreturn]] void usage(const std::string& word) {
  std::fprintf(stderr, "%s is none of sizes=, seeds=, plain=, threads=, precision=, boundary=free|periodic\n",
               word.c_str());
  std::exit(2);
}

Settings read(int count, char** words) {
  Settings settings;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    const auto equals = word.find('=');
    if (equals == std::string::npos) usage(word);
    const std::string key = word.substr(0, equals), value = word.substr(equals + 1);
    const int number = std::atoi(value.c_str());
    if (key == "sizes") {
      settings.sizes.clear();
      for (std::size_t from = 0; from < value.size();) {
        settings.sizes.push_back(std::atoi(value.c_str() + from));
        const auto comma = value.find(',', from);
        from = comma == std::string::npos ? value.size() : comma + 1;
      }
    } else if (key == "seeds") {
      settings.seeds = number;
    } else if (key == "plain") {
      settings.plain = number;
    } else if (key == "threads") {
      settings.threads = number;
    } else if (key == "precision") {
      settings.precision = number;
    } else if (key == "boundary" && (value == "free" || value == "periodic")) {
      settings.boundary = value == "free" ? Boundary::free : Boundary::periodic;
    } else {
      usage(word);
    }
  }
  return settings;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Value>
Value median(std::vector<Value> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

constexpr double slope = 0.1, tolerance = 1e-8;

// Turns of equal length: other programs disturb both alike.
constexpr int turns = 7;

Field heights(int n, std::uint64_t seed) {
  SelfAffineOptions options;
  options.grid = make_grid(n, n, n, n);
  options.hurst = 0.8;
  options.rms_slope = slope;
  options.short_wave = 16;
  options.seed = seed;
  return self_affine_surface(options).heights();
}

// FFTW, double precision, in place.
class BarePair {
 public:
  BarePair(int n, int threads) {
    static const bool ready = fftw_init_threads() != 0;
    if (ready) fftw_plan_with_nthreads(threads);
    const std::size_t row = 2 * static_cast<std::size_t>(n / 2 + 1);
    data_ = fftw_alloc_real(row * static_cast<std::size_t>(n));
    auto* const bins = reinterpret_cast<fftw_complex*>(data_);
    forward_ = fftw_plan_dft_r2c_2d(n, n, data_, bins, FFTW_MEASURE);
    back_ = fftw_plan_dft_c2r_2d(n, n, bins, data_, FFTW_MEASURE);
    std::fill_n(data_, row * static_cast<std::size_t>(n), 0.0);
    // Later plans, including the engine's, use one thread.
    fftw_plan_with_nthreads(1);
  }
  ~BarePair() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(back_);
    fftw_free(data_);
  }
  BarePair(const BarePair&) = delete;
  BarePair& operator=(const BarePair&) = delete;

  // Mean of `pairs` in a row.
  double seconds(int pairs) const {
    const double start = now();
    for (int pair = 0; pair < pairs; ++pair) {
      fftw_execute(forward_);
      fftw_execute(back_);
    }
    return (now() - start) / pairs;
  }

 private:
  double* data_;
  fftw_plan forward_, back_;
};

struct Plain {
  int iterations = 0;
  double seconds = 0;
};

// Polonsky & Keer (1999); load by scaling.
Plain plain_conjugate_gradients(const Field& h, double mean_pressure, Boundary boundary) {
  const double start = now();
  const std::size_t n = h.size();
  HalfSpaceCompliance compliance(h.nx(), h.ny(), 1.0, boundary);
  const double middle = mean(h.values());
  double squares = 0;
  for (const double z : h.values()) squares += (z - middle) * (z - middle);
  const double rms = std::sqrt(squares / static_cast<double>(n)),
               total = mean_pressure * static_cast<double>(n);
  std::vector<double> p(n, mean_pressure), g(n), t(n, 0.0), r(n);
  double before = 1;
  bool keep = false;
  Plain result;
  for (; result.iterations < 20000; ++result.iterations) {
    compliance.apply(p, g);
    double sum = 0, touching = 0, least = 1e300;
    for (std::size_t k = 0; k < n; ++k) {
      g[k] -= h[k];
      least = std::min(least, g[k]);
      if (p[k] > 0) {
        sum += g[k];
        ++touching;
      }
    }
    double apart = 0;
    for (std::size_t k = 0; k < n; ++k) apart += p[k] * (g[k] - least);
    if (apart / (total * rms) < tolerance) break;
    const double level = sum / touching;
    double norm = 0;
    for (std::size_t k = 0; k < n; ++k) {
      g[k] -= level;
      if (p[k] > 0) norm += g[k] * g[k];
    }
    const double beta = keep ? norm / before : 0;
    before = norm;
    for (std::size_t k = 0; k < n; ++k) t[k] = p[k] > 0 ? g[k] + beta * t[k] : 0;
    compliance.apply(t, r);
    sum = 0;
    for (std::size_t k = 0; k < n; ++k)
      if (p[k] > 0) sum += r[k];
    double down = 0, along = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (!(p[k] > 0)) continue;
      down += g[k] * t[k];
      along += (r[k] - sum / touching) * t[k];
    }
    const double step = down / along;
    double load = 0;
    keep = true;
    for (std::size_t k = 0; k < n; ++k) {
      if (p[k] > 0) {
        p[k] = std::max(0.0, p[k] - step * t[k]);
      } else if (g[k] < 0) {
        p[k] = -step * g[k];
        keep = false;
      }
      load += p[k];
    }
    for (double& value : p) value *= total / load;
  }
  result.seconds = now() - start;
  return result;
}

struct Ours {
  double pairs, seconds, grids;
  std::string solver;
};

Ours ours(std::shared_ptr<const Field> h, double mean_pressure, double cap, bool single, Boundary boundary,
          double to = tolerance) {
  HalfSpaceProblem problem;
  problem.grid = make_grid(h->nx(), h->ny(), h->nx(), h->ny());
  problem.boundary = boundary;
  problem.modulus = 1;
  problem.heights = h;
  const double middle = mean(h->values());
  double squares = 0;
  for (const double z : h->values()) squares += (z - middle) * (z - middle);
  problem.rms = std::sqrt(squares / static_cast<double>(h->size()));
  problem.yield.cap = cap;
  problem.tolerance = to;
  problem.single = single;
  const CostScope scope;
  const HalfSpaceAnswer answer = solve_at_pressure(problem, mean_pressure, nullptr, Monitor::silent());
  const Cost cost = scope.so_far();
  return {cost.transforms / 2, cost.seconds,
          static_cast<double>(cost.bytes) / static_cast<double>(h->size() * sizeof(double)) - 2,
          answer.solver};
}

void table(const Settings& settings) {
  const bool free = settings.boundary == Boundary::free;
  std::printf(
      "%s boundary, complementarity %g, medians of %d seeds, times of %d turns of each, %d thread(s)\n",
      free ? "free" : "periodic", tolerance, settings.seeds, turns, thread_count());
  std::printf("%6s %6s %6s %9s | %11s %9s | %7s %9s %9s | %9s %10s %6s\n", "n", "load", "cap", "precision",
              "plain its", "s", "pairs", "s", "ms/pair", "bare ms", "ms/pair :", "grids");
  std::printf("%6s %6s %6s %9s | %11s %9s | %7s %9s %9s | %9s %10s %6s\n", "", "/E*h'", "/load", "",
              "(2 pairs)", "", "ours", "", "", "pair", "bare", "");
  for (const int n : settings.sizes) {
    const BarePair bare_pair(free ? 2 * n : n, thread_count());
    struct Case {
      double load, cap;
      bool single = false;
    };
    std::vector<Case> cases = {{0.05, 0}, {0.3, 0}, {0.05, 0, true}, {0.3, 0, true}};
    if (!free && n == 512)
      for (const double cap : {1.5, 2.5, 5.0}) {
        cases.push_back({0.05, cap});
        cases.push_back({0.3, cap});
      }
    for (const Case& c : cases) {
      const double pressure = c.load * slope;
      const double cap = c.cap > 0 ? c.cap * pressure : std::numeric_limits<double>::infinity();
      std::vector<double> pairs, seconds, bare, ratios, grids, plain_seconds;
      std::vector<int> iterations;
      for (int seed = 1; seed <= settings.seeds; ++seed) {
        const auto h = std::make_shared<const Field>(heights(n, static_cast<std::uint64_t>(seed)));
        Ours mine = ours(h, pressure, cap, c.single, settings.boundary);
        pairs.push_back(mine.pairs);
        grids.push_back(mine.grids);
        for (int turn = 0; turn < turns; ++turn) {
          const double pair = bare_pair.seconds(static_cast<int>(std::lround(mine.pairs)));
          mine = ours(h, pressure, cap, c.single, settings.boundary);
          bare.push_back(pair);
          seconds.push_back(mine.seconds);
          ratios.push_back(mine.seconds / mine.pairs / pair);
        }
        if (c.cap == 0 && !c.single && n <= settings.plain) {
          const Plain plain = plain_conjugate_gradients(*h, pressure, settings.boundary);
          iterations.push_back(plain.iterations);
          plain_seconds.push_back(plain.seconds);
        }
      }
      std::printf("%6d %6.2f ", n, c.load);
      c.cap > 0 ? std::printf("%6.1f ", c.cap) : std::printf("%6s ", "-");
      std::printf("%9s | ", c.single ? "single" : "double");
      iterations.empty() ? std::printf("%11s %9s | ", "-", "-")
                         : std::printf("%11d %9.3f | ", median(iterations), median(plain_seconds));
      std::printf("%7.1f %9.3f %9.3f | %9.3f %10.2f %6.1f\n", median(pairs), median(seconds),
                  1e3 * median(seconds) / median(pairs), 1e3 * median(bare), median(ratios), median(grids));
      std::fflush(stdout);
    }
  }
}

double user_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

void precisions(const Settings& settings) {
  std::printf("%s boundary, %d solves of each seed in either precision by turns, %d seeds, %d thread(s)\n",
              settings.boundary == Boundary::free ? "free" : "periodic", settings.precision, settings.seeds,
              thread_count());
  std::printf("%6s %9s | %12s %12s %7s | %12s %12s %7s\n", "n", "tolerance", "double pairs", "single pairs",
              "ratio", "double user", "single user", "ratio");
  for (const int n : settings.sizes)
    for (const double to : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9}) {
      double pairs[2] = {0, 0}, seconds[2] = {0, 0};
      for (int seed = 1; seed <= settings.seeds; ++seed) {
        const auto h = std::make_shared<const Field>(heights(n, static_cast<std::uint64_t>(seed)));
        for (int turn = 0; turn < settings.precision; ++turn)
          for (const bool single : {false, true}) {
            const double before = user_seconds();
            pairs[single] +=
                ours(h, 0.1 * slope, std::numeric_limits<double>::infinity(), single, settings.boundary, to)
                    .pairs;
            seconds[single] += user_seconds() - before;
          }
      }
      const double solves = static_cast<double>(settings.precision) * settings.seeds;
      std::printf("%6d %9.0e | %12.1f %12.1f %7.3f | %12.4f %12.4f %7.3f\n", n, to, pairs[0] / solves,
                  pairs[1] / solves, pairs[1] / pairs[0], seconds[0] / solves, seconds[1] / solves,
                  seconds[1] / seconds[0]);
      std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** words) {
  const Settings settings = read(count, words);
  if (settings.threads > 0) set_thread_count(settings.threads);
  settings.precision > 0 ? precisions(settings) : table(settings);
}
