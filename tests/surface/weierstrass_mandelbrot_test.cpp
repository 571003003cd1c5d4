// SPDX-License-Identifier: GPL-3.0-or-later
// Heights of 20 digits, statistics of 10 digits, and the direct sum where long doubles resolve the phases.
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::weierstrass_mandelbrot_test {
namespace {

using Options = WeierstrassMandelbrotOptions;

Options square(int cells, double D, double span = 1) {
  Options options;
  options.nx = options.ny = cells;
  options.D = D;
  options.span = span;
  return options;
}

std::string refusal(const Options& options) {
  return test::refusal([&] { weierstrass_mandelbrot(options); });
}

struct Statistics {
  double mean = 0, Rq = 0, Ra = 0, skewness = 0, kurtosis = 0, amplitude = 0;
};

Statistics statistics(const Surface& surface) {
  Statistics s;
  const auto z = surface.heights().values();
  const auto count = static_cast<double>(z.size());
  s.mean = mean(z);
  double absolute = 0, second = 0, third = 0, fourth = 0;
  for (const double value : z) {
    const double d = value - s.mean;
    absolute += std::abs(d);
    second += d * d;
    third += d * d * d;
    fourth += d * d * d * d;
  }
  s.Ra = absolute / count;
  s.Rq = std::sqrt(second / count);
  s.skewness = third / count / (s.Rq * s.Rq * s.Rq);
  s.kurtosis = fourth / count / (s.Rq * s.Rq * s.Rq * s.Rq);
  s.amplitude = surface.peak_to_valley();
  return s;
}

// Long doubles resolve the phases of low orders only.
double definition(const Options& o, int i, int j, const std::function<long double(int, int)>& phase) {
  constexpr long double pi = std::numbers::pi_v<long double>;
  long double sum = 0;
  for (int n = 0; n <= o.n_max; ++n) {
    const long double power = std::pow(static_cast<long double>(o.gamma), n);
    for (int m = 1; m <= o.M; ++m) {
      const long double turns =
          power * o.span / o.nx * (i * std::cos(pi * m / o.M) + j * std::sin(pi * m / o.M));
      const long double amplitude = std::pow(static_cast<long double>(o.gamma), (o.D - 3) * n);
      // The angles are not added: phases may exceed many turns.
      sum += amplitude * (std::cos(phase(m, n)) * (1 - std::cos(2 * pi * turns)) +
                          std::sin(phase(m, n)) * std::sin(2 * pi * turns));
    }
  }
  return static_cast<double>(o.L * std::pow(static_cast<long double>(o.G) / o.L, o.D - 2.0L) *
                             std::sqrt(std::log(static_cast<long double>(o.gamma)) / o.M) * sum);
}

TEST(WeierstrassMandelbrot, HeightsAreThoseOfTheReferenceTable) {
  std::ifstream file(ASPERITY_TEST_DATA "/wm_heights.csv");
  ASSERT_TRUE(file);
  std::map<std::pair<double, double>, Surface> surfaces;
  std::string line;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 'D') continue;
    std::ranges::replace(line, ',', ' ');
    std::istringstream in(line);
    double D = 0, span = 0, z = 0;
    int i = 0, j = 0;
    ASSERT_TRUE(in >> D >> span >> i >> j >> z) << line;
    auto found = surfaces.find({D, span});
    if (found == surfaces.end()) {
      Options options = square(150, D, span);
      options.phases = WavePhases::golden;
      found = surfaces.emplace(std::pair{D, span}, weierstrass_mandelbrot(options)).first;
    }
    // The table's -35.00081053088909918 is misprinted: 140 digits and quadruple precision give this value
    // and confirm the other 56.
    if (D == 2.99 && span == 3 && i == 75 && j == 75) z = -35.0008105330888991814493;
    EXPECT_NEAR(found->second.height(i, j), z, 1e-10) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 57);
}

Options golden_ratio_function(double D) {
  Options options = square(150, D, 3);
  options.n_max = 7;
  options.phases = WavePhases::function;
  options.phase_function = [](int m, int n) {
    const double k = 0.6180339887498949 * (10 * n + m);
    return 2 * std::numbers::pi * (k - std::floor(k));
  };
  return options;
}

TEST(WeierstrassMandelbrot, StatisticsAreKnownAtDimensionTwoAndAHalf) {
  const Surface surface = weierstrass_mandelbrot(golden_ratio_function(2.5));
  const Statistics s = statistics(surface);
  EXPECT_NEAR(s.mean, -2.2579597274, 1e-8);
  EXPECT_NEAR(s.Rq, 11.9812989022, 1e-8);
  EXPECT_NEAR(s.Ra, 9.4256615568, 1e-8);
  EXPECT_NEAR(s.skewness, -.0183142689, 1e-8);
  EXPECT_NEAR(s.kurtosis, 3.4457650805, 1e-8);
  EXPECT_NEAR(s.amplitude, 108.3493302162, 1e-8);
  EXPECT_NEAR(surface.height(75, 40), -1.8465009186, 1e-8);
  EXPECT_EQ(surface.height(0, 0), 0);
}

TEST(WeierstrassMandelbrot, StatisticsAreKnownAtDimensionTwoPointTwo) {
  const Surface surface = weierstrass_mandelbrot(golden_ratio_function(2.2));
  const Statistics s = statistics(surface);
  EXPECT_NEAR(s.mean, -4.2184139916, 1e-8);
  EXPECT_NEAR(s.Rq, 20.3032959226, 1e-8);
  EXPECT_NEAR(s.amplitude, 164.8778831984, 1e-8);
  EXPECT_NEAR(surface.height(75, 40), -8.0472892570, 1e-8);
}

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;
#endif

Quad square_root(Quad value) {
  Quad root = std::sqrt(static_cast<double>(value));
  for (int k = 0; k < 4; ++k) root = (root + value / root) / 2;
  return root;
}

// cos(πm/10), from the golden ratio.
Quad cosine_of_tenths(int m) {
  const Quad root_5 = square_root(5);
  if (m > 5) return -cosine_of_tenths(10 - m);
  switch (m) {
    case 0:
      return 1;
    case 1:
      return square_root((5 + root_5) / 8);
    case 2:
      return (1 + root_5) / 4;
    case 3:
      return square_root((5 - root_5) / 8);
    case 4:
      return (root_5 - 1) / 4;
    default:
      return 0;
  }
}

// 113 bits leave 54 for the fraction at n = 100.
TEST(WeierstrassMandelbrot, EqualsItsDefinitionInQuadruplePrecision) {
  Options o = square(150, 2.99, 3);
  o.phases = WavePhases::golden;
  const Surface surface = weierstrass_mandelbrot(o);
  constexpr long double full_turn = 2 * std::numbers::pi_v<long double>;
  for (const auto& [i, j] : {std::pair{75, 75}, {149, 149}, {0, 149}, {149, 0}, {31, 7}, {92, 140}}) {
    long double sum = 0;
    Quad step = Quad(3) / 150;
    for (int n = 0; n <= 100; ++n, step = step * 3 / 2) {
      const long double amplitude = std::exp((2.99L - 3) * n * std::log(1.5L));
      for (int m = 1; m <= 10; ++m) {
        const Quad turns = step * (i * cosine_of_tenths(m) + j * cosine_of_tenths(m < 5 ? 5 - m : m - 5));
        const auto whole = static_cast<Quad>(static_cast<long double>(turns));
        const long double rest = std::fmod(static_cast<long double>(whole), 1.0L);
        const long double angle = full_turn * (rest + static_cast<long double>(turns - whole));
        const long double phase = full_turn * golden_phase_turns(100, m, n);
        sum += amplitude * (std::cos(phase) - std::cos(angle + phase));
      }
    }
    const long double scale = 50 * std::pow(.1L, .99L) * std::sqrt(std::log(1.5L) / 10);
    EXPECT_NEAR(surface.height(i, j), static_cast<double>(scale * sum), 1e-12) << i << " " << j;
  }
}

// Printed for seed 1 from the rounded φ.
TEST(WeierstrassMandelbrot, SeededPhasesAreThoseOfTheirKeys) {
  constexpr double full_turn = 2 * std::numbers::pi;
  const auto printed = [](int m, int n) { return full_turn * seeded_phase_turns(1, 10, m, n) / full_turn; };
  EXPECT_EQ(printed(1, 0), 0.5665615751722809);
  EXPECT_EQ(printed(2, 0), 0.74578175726270124);
  EXPECT_EQ(printed(10, 0), 0.79399660566230557);
  EXPECT_EQ(printed(1, 1), 0.40414216905022571);
  EXPECT_EQ(printed(10, 100), 0.17650913360524823);
}

TEST(WeierstrassMandelbrot, GoldenPhasesAreWholeNumbers) {
  EXPECT_EQ(golden_phase_turns(100, 1, 0), 0.4214328637393849);     // 101·6180339887498949 mod 10¹⁶
  EXPECT_EQ(golden_phase_turns(100, 10, 100), 0.0177275123833390);  // 1110·…
  EXPECT_EQ(golden_phase_turns(0, 1, 0), 0.6180339887498949);
}

TEST(WeierstrassMandelbrot, SeededAndFunctionPhasesMeet) {
  Options options = square(40, 2.4);
  options.seed = 12;
  const Surface seeded = weierstrass_mandelbrot(options);
  options.phases = WavePhases::function;
  options.phase_function = [](int m, int n) {
    return 2 * std::numbers::pi * seeded_phase_turns(12, 10, m, n);
  };
  const Surface function = weierstrass_mandelbrot(options);
  EXPECT_EQ(seeded.digest(), function.digest());
  options.seed = 13;
  options.phases = WavePhases::seeded;
  EXPECT_NE(weierstrass_mandelbrot(options).digest(), seeded.digest());
}

TEST(WeierstrassMandelbrot, LowOrdersKeepTheirPhasesWhenMoreAreAdded) {
  Options few = square(64, 2), more = few;
  few.n_max = 60;
  more.n_max = 100;
  const Surface a = weierstrass_mandelbrot(few), b = weierstrass_mandelbrot(more);
  // D = 2: orders above 60 add at most 50·√(ln γ/10)·10·2·3·1.5⁻⁶¹ m.
  for (std::size_t k = 0; k < a.heights().size(); ++k) ASSERT_NEAR(a.heights()[k], b.heights()[k], 1e-7);
}

TEST(WeierstrassMandelbrot, EqualsItsDefinitionOnAnyGrid) {
  struct Case {
    int nx, ny;
    double D, span, gamma, L, G;
    int M, n_max;
  };
  constexpr Case cases[] = {
      {150, 150, 2.5, 1, 1.5, 50, 5, 10, 10},
      {97, 61, 2.37, .37, 1.5, 50, 5, 10, 14},
      {13, 211, 2.9, 2.6, 1.7, 3e-3, 1e-7, 7, 9},
      {1, 40, 2.2, 1, 1.5, 50, 5, 10, 12},
      {40, 1, 2.2, 1, 1.5, 50, 5, 3, 12},
      {31, 29, 2.6, 1, 1.5, 50, 50, 1, 12},
      {31, 29, 2.6, 1, 1.5, 5, 50, 2, 12},
      {8, 8, 2.5, 1, 1.0000001, 50, 5, 4, 30},
      {30, 30, 3, 1, 2, 50, 5, 5, 0},
  };
  for (const Case& c : cases) {
    Options o;
    o.nx = c.nx;
    o.ny = c.ny;
    o.D = c.D;
    o.span = c.span;
    o.gamma = c.gamma;
    o.L = c.L;
    o.G = c.G;
    o.M = c.M;
    o.n_max = c.n_max;
    o.seed = 5;
    const Surface surface = weierstrass_mandelbrot(o);
    const auto phase = [&](int m, int n) {
      return 2 * std::numbers::pi_v<long double> * seeded_phase_turns(o.seed, o.M, m, n);
    };
    const Stream places(1, "places");
    const double scale = std::max(surface.peak_to_valley(), o.L * 1e-6);
    for (std::uint64_t k = 0; k < 40; ++k) {
      const auto i = static_cast<int>(places.below(2 * k, static_cast<std::uint64_t>(c.nx)));
      const auto j = static_cast<int>(places.below(2 * k + 1, static_cast<std::uint64_t>(c.ny)));
      ASSERT_NEAR(surface.height(i, j), definition(o, i, j, phase), 2e-13 * scale)
          << c.nx << " x " << c.ny << " at " << i << " " << j;
    }
  }
}

TEST(WeierstrassMandelbrot, TakesPhasesOfManyTurns) {
  Options o = square(20, 2.5);
  o.n_max = 5;
  o.phases = WavePhases::function;
  o.phase_function = [](int m, int n) { return 1e6 * m - 3e9 * n; };
  const Surface surface = weierstrass_mandelbrot(o);
  const auto phase = [](int m, int n) -> long double { return 1e6 * m - 3e9 * n; };
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(surface.height(i, 7), definition(o, i, 7, phase), 1e-11);
}

TEST(WeierstrassMandelbrot, CellsAreSquareAndTheSizeIsSpanTimesLength) {
  Options o = square(30, 2.5, 3);
  EXPECT_EQ(weierstrass_mandelbrot(o).grid(), (Grid{30, 30, 150, 150}));
  o.ny = 10;
  EXPECT_EQ(weierstrass_mandelbrot(o).grid(), (Grid{30, 10, 150, 50}));
  const Surface narrow = weierstrass_mandelbrot(o), whole = weierstrass_mandelbrot(square(30, 2.5, 3));
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 30; ++i) ASSERT_NEAR(narrow.height(i, j), whole.height(i, j), 1e-12);
}

TEST(WeierstrassMandelbrot, AFinerGridIsTheSameSurface) {
  for (const double D : {2.0, 2.5, 2.99}) {
    const Surface coarse = weierstrass_mandelbrot(square(150, D)),
                  fine = weierstrass_mandelbrot(square(300, D));
    for (int j = 0; j < 150; ++j)
      for (int i = 0; i < 150; ++i) ASSERT_NEAR(coarse.height(i, j), fine.height(2 * i, 2 * j), 1e-10) << D;
  }
}

TEST(WeierstrassMandelbrot, TouchesZeroAtTheFirstNode) {
  for (const double D : {2.0, 2.5, 3.0}) {
    EXPECT_EQ(weierstrass_mandelbrot(square(37, D)).height(0, 0), 0);
    const Surface single = weierstrass_mandelbrot(square(1, D));
    EXPECT_EQ(single.height(0, 0), 0);
  }
}

TEST(WeierstrassMandelbrot, IsFiniteAtBothEndsOfTheDimension) {
  const Statistics two = statistics(weierstrass_mandelbrot(square(150, 2)));
  const Statistics three = statistics(weierstrass_mandelbrot(square(150, 3)));
  // D = 3: equal weights, variance G²·(ln γ/M)·M(n_max+1)/2.
  EXPECT_NEAR(three.Rq, 5 * std::sqrt(std::log(1.5) * 101 / 2), 0.15 * three.Rq);
  EXPECT_GT(two.Rq, 1);
  EXPECT_LT(two.Rq, 50);
}

TEST(WeierstrassMandelbrot, TwoThousandOrdersDoNotOverflow) {
  Options o = square(60, 2.99);
  o.n_max = 2000;
  const Statistics s = statistics(weierstrass_mandelbrot(o));
  // The grid aliases most orders to noise.
  double variance = 0;
  for (int n = 0; n <= o.n_max; ++n) variance += std::exp(2 * (o.D - 3) * n * std::log(1.5));
  const double expected = 50 * std::pow(.1, .99) * std::sqrt(std::log(1.5) * variance / 2);
  EXPECT_NEAR(s.Rq, expected, 0.15 * expected);
  o.D = 2;  // amplitudes underflow
  EXPECT_GT(statistics(weierstrass_mandelbrot(o)).Rq, 1);
}

TEST(WeierstrassMandelbrot, ScalesExactlyWithItsLengths) {
  Options o = square(50, 2.3), small = o;
  small.L = o.L * 0x1p-40;
  small.G = o.G * 0x1p-40;
  const Surface a = weierstrass_mandelbrot(o), b = weierstrass_mandelbrot(small);
  for (std::size_t k = 0; k < a.heights().size(); ++k)
    ASSERT_NEAR(a.heights()[k] * 0x1p-40, b.heights()[k], 1e-14 * b.peak_to_valley());
}

// Variance beyond Nyquist, 150 cells, to the printed digits.
TEST(WeierstrassMandelbrot, AliasedShareIsTheTabulatedOne) {
  struct Row {
    double D, at_span_1, digit_1, at_span_3, digit_3;
  };
  constexpr Row rows[] = {{2.0, .0001, 1e-4, .0015, 1e-4}, {2.3, .002, 1e-3, .011, 1e-3},
                          {2.5, .012, 1e-3, .039, 1e-3},   {2.7, .069, 1e-3, .14, 1e-2},
                          {2.9, .41, 1e-2, .52, 1e-2},     {2.99, .85, 1e-2, .89, 1e-2}};
  for (const Row& row : rows) {
    const double one = weierstrass_mandelbrot(square(150, row.D, 1)).traits().aliased_share.value();
    const double three = weierstrass_mandelbrot(square(150, row.D, 3)).traits().aliased_share.value();
    EXPECT_NEAR(one, row.at_span_1, row.digit_1 / 2) << row.D;
    EXPECT_NEAR(three, row.at_span_3, row.digit_3 / 2) << row.D;
  }
}

TEST(WeierstrassMandelbrot, AliasedShareRunsFromNothingToAll) {
  EXPECT_EQ(share_of_variance_beyond(100, 2.5, 1.5, 100), 0);
  EXPECT_EQ(share_of_variance_beyond(-1, 2.5, 1.5, 100), 1);
  EXPECT_DOUBLE_EQ(share_of_variance_beyond(24, 3, 1.5, 99), .75);
  EXPECT_EQ(weierstrass_mandelbrot(square(1, 2.5)).traits().aliased_share, 1);
}

TEST(WeierstrassMandelbrot, TheResolvedBandHoldsTheOrdersWithinNyquist) {
  Options resolved = square(150, 2.7), cut = resolved;
  resolved.band = WaveBand::resolved;
  cut.n_max = 10;
  const Surface a = weierstrass_mandelbrot(resolved), b = weierstrass_mandelbrot(cut);
  EXPECT_EQ(a.digest(), b.digest());
  EXPECT_EQ(a.traits().aliased_share, 0);
  EXPECT_EQ(b.traits().aliased_share, 0);
  EXPECT_NE(a.digest(), weierstrass_mandelbrot(square(150, 2.7)).digest());
}

TEST(WeierstrassMandelbrot, AsksForEveryPhaseOnceInOrder) {
  for (const WaveBand band : {WaveBand::all, WaveBand::resolved}) {
    Options o = square(20, 2.0);
    o.M = 3;
    o.n_max = 150;
    o.band = band;
    o.phases = WavePhases::function;
    int calls = 0;
    o.phase_function = [&](int m, int n) {
      EXPECT_EQ(n * 3 + m - 1, calls++);
      return 0.0;
    };
    weierstrass_mandelbrot(o);
    EXPECT_EQ(calls, 3 * 151);
  }
}

TEST(WeierstrassMandelbrot, IsTheSameBitsForAnyNumberOfThreads) {
  Options o = square(331, 2.6);
  o.ny = 290;
  set_thread_count(1);
  const std::string one = weierstrass_mandelbrot(o).digest();
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    EXPECT_EQ(weierstrass_mandelbrot(o).digest(), one) << threads;
  }
  set_thread_count(0);
}

TEST(WeierstrassMandelbrot, CarriesItsMaterialAndIsNotPeriodic) {
  Options o = square(10, 2.5);
  EXPECT_FALSE(weierstrass_mandelbrot(o).material().has_value());
  o.material = named_material("Al-2011");
  const Surface surface = weierstrass_mandelbrot(o);
  EXPECT_EQ(surface.material().value().name, "Al-2011");
  EXPECT_FALSE(surface.traits().periodic);
}

TEST(WeierstrassMandelbrot, HoldsItsTablesToTheStatedMemory) {
  CostScope scope;
  const Options o = square(600, 2.5);
  { const Surface surface = weierstrass_mandelbrot(o); }
  const std::int64_t heights = 600LL * 600 * 8, waves = 120 * 1010, tables = 2 * 256 * 1200 * 8;
  EXPECT_LE(scope.so_far().bytes, heights + waves + tables);
}

TEST(WeierstrassMandelbrot, RefusesWhatHasNoMeaning) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Options o = square(10, 2.5);
  const auto with = [&](auto change) {
    Options changed = o;
    change(changed);
    return refusal(changed);
  };
  EXPECT_EQ(with([](Options& c) { c.D = std::nextafter(2.0, 0.0); }),
            "`D` is 1.9999999999999998; give a fractal dimension from 2 to 3");
  EXPECT_EQ(with([](Options& c) { c.D = std::nextafter(3.0, 4.0); }),
            "`D` is 3.0000000000000004; give a fractal dimension from 2 to 3");
  EXPECT_EQ(with([](Options& c) { c.D = nan; }), "`D` is nan; give a fractal dimension from 2 to 3");
  EXPECT_EQ(with([](Options& c) { c.L = 0; }), "`L` is 0; give a finite length above zero");
  EXPECT_EQ(with([](Options& c) { c.G = -5; }), "`G` is -5; give a finite length above zero");
  EXPECT_EQ(with([](Options& c) { c.span = 0; }), "`span` is 0; give a finite number above 0");
  EXPECT_EQ(with([](Options& c) { c.gamma = 1; }), "`gamma` is 1; give a finite number above 1");
  EXPECT_EQ(with([](Options& c) { c.M = 0; }), "`M` is 0; give a whole number from 1 to 65536");
  EXPECT_EQ(with([](Options& c) { c.nx = 0; }), "`cells` is 0 a side; give a whole number from 1 to 65536");
  EXPECT_EQ(with([](Options& c) { c.ny = 65537; }),
            "`cells` is 65537 a side; give a whole number from 1 to 65536");
  EXPECT_EQ(
      with([](Options& c) { c.span = c.L = 1e200; }),
      "`span` of 1e+200 times `L` of 1e+200 m is no length; the size of the surface, span*L, must be finite "
      "and above zero");
  EXPECT_EQ(with([](Options& c) { c.n_max = 5000; }),
            "`n_max` is 5000; with gamma = 1.5 give a whole number from 0 to 3501: n_max*log2(gamma) may not "
            "exceed "
            "2048, nor n_max 4096");
  EXPECT_EQ(with([](Options& c) { c.n_max = -1; }).substr(0, 14), "`n_max` is -1;");
  EXPECT_EQ(with([](Options& c) { c.phases = WavePhases::function; }),
            "`phases` asks for a function and has none; give a function of m and n that returns radians");
  EXPECT_EQ(
      with([](Options& c) {
        c.nx = c.ny = 1;
        c.band = WaveBand::resolved;
      }),
      "`band` = \"resolved\" leaves no wave: with 1 cells over a span of 1 even n = 0 turns more than half a "
      "turn per cell; give more cells, a shorter span, or band = \"all\"");
}

TEST(WeierstrassMandelbrot, NamesTheWaveWhosePhaseIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Options o = square(10, 2.5);
    o.phases = WavePhases::function;
    o.phase_function = [bad](int m, int n) { return m == 3 && n == 42 ? bad : 0.0; };
    EXPECT_EQ(refusal(o), std::string("`phases`(3, 42) is ") + (std::isnan(bad) ? "nan" : "inf") +
                              "; the function must return a finite number of radians for every m and n");
  }
}

TEST(WeierstrassMandelbrot, LetsAPhaseFunctionFail) {
  Options o = square(10, 2.5);
  o.phases = WavePhases::function;
  o.phase_function = [](int, int) -> double { throw Error(ErrorCode::bad_state, "the script failed"); };
  EXPECT_THROW(weierstrass_mandelbrot(o), Error);
}

}  // namespace
}  // namespace asperity::weierstrass_mandelbrot_test
