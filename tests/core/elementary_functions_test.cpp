// SPDX-License-Identifier: GPL-3.0-or-later
// Correct rounding of elementary functions, against MPFR: wide ranges, special values, exact results, ties,
// other rounding modes.
#include "engine/core/arithmetic/elementary_functions.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/arithmetic/rounding_mode.hpp"

namespace asperity::elementary_functions_test {
namespace {

using elementary::SineCosine;

// MPFR caches π and log 2 per thread; freed at the end of a test.
struct Reference {
  mpfr_t result, first, second;
  Reference() { mpfr_inits2(53, result, first, second, static_cast<mpfr_ptr>(nullptr)); }
  ~Reference() {
    mpfr_clears(result, first, second, static_cast<mpfr_ptr>(nullptr));
    mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE);
  }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  double finish(int direction) {
    const mpfr_exp_t least = mpfr_get_emin(), greatest = mpfr_get_emax();
    mpfr_set_emin(-1073);
    mpfr_set_emax(1024);
    direction = mpfr_check_range(result, direction, MPFR_RNDN);
    mpfr_subnormalize(result, direction, MPFR_RNDN);
    mpfr_set_emin(least);
    mpfr_set_emax(greatest);
    return mpfr_get_d(result, MPFR_RNDN);
  }
  double operator()(int (*f)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), double x) {
    mpfr_set_d(first, x, MPFR_RNDN);
    return finish(f(result, first, MPFR_RNDN));
  }
  double operator()(int (*f)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t), double x, double y) {
    mpfr_set_d(first, x, MPFR_RNDN);
    mpfr_set_d(second, y, MPFR_RNDN);
    return finish(f(result, first, second, MPFR_RNDN));
  }
};

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

struct OfOne {
  const char* name;
  double (*ours)(double);
  int (*reference)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  double low, high;
  double least = -60;  // binary exponent of the smallest arguments
  double greatest = 12;
  int samples = 6000;
};

// Functions computed by MPFR: a few samples check the call.
const std::vector<OfOne> functions = {
    {"sin", elementary::sin, mpfr_sin, -1e300, 1e300, -40, 16},
    {"cos", elementary::cos, mpfr_cos, -1e300, 1e300, -40, 16},
    {"exp", elementary::exp, mpfr_exp, -760, 720, -60, 9.6},
    {"exp2", elementary::exp2, mpfr_exp2, -1090, 1030, -60, 10.1},
    {"expm1", elementary::expm1, mpfr_expm1, -760, 720, -60, 9.6},
    {"log", elementary::log, mpfr_log, 0, 1e308, -1074, 1024},
    {"log2", elementary::log2, mpfr_log2, 0, 1e308, -1074, 1024},
    {"log10", elementary::log10, mpfr_log10, 0, 1e308, -1074, 1024},
    {"log1p", elementary::log1p, mpfr_log1p, -1, 1e308, -60, 60},
    {"asinh", elementary::asinh, mpfr_asinh, -1e308, 1e308, -60, 60},
    {"tan", elementary::tan, mpfr_tan, -1e300, 1e300, -40, 16, 50},
    {"asin", elementary::asin, mpfr_asin, -1, 1, -40, 0, 50},
    {"acos", elementary::acos, mpfr_acos, -1, 1, -40, 0, 50},
    {"atan", elementary::atan, mpfr_atan, -1e300, 1e300, -40, 40, 50},
    {"cbrt", elementary::cbrt, mpfr_cbrt, -1e308, 1e308, -1000, 1000, 50},
    {"erf", elementary::erf, mpfr_erf, -10, 10, -40, 3, 50},
};

void expect_rounded(const OfOne& f, Reference& reference, double x) {
  const double wanted = reference(f.reference, x), found = f.ours(x);
  ASSERT_TRUE(same_bits(found, wanted))
      << f.name << "(" << std::hexfloat << x << ") is " << found << ", not " << wanted;
}

TEST(ElementaryFunctions, OfOneArgumentAreCorrectlyRounded) {
  Reference reference;
  for (const OfOne& f : functions) {
    const Stream stream(1, f.name);
    std::uint64_t draw = 0;
    // Uniform exponents, and uniform numbers of order one.
    for (int k = 0; k < f.samples; ++k) {
      const double exponent = stream.uniform(draw++, f.least, f.greatest);
      double x = std::ldexp(1 + stream.uniform(draw++), static_cast<int>(std::floor(exponent)));
      if (k % 2 == 1) x = stream.uniform(draw++, 0.0, 4.0);
      if (f.low < 0 && stream.bits(draw++) % 2 == 1) x = -x;
      if (x < f.low || x > f.high) continue;
      expect_rounded(f, reference, x);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(ElementaryFunctions, CorrectlyRoundedBesideOneAndZeroAndTheEdgesOfTables) {
  Reference reference;
  for (const OfOne& f : functions) {
    if (f.samples < 1000) continue;
    std::vector<double> places = {
        0,       1,        -1,          0.5,         0x1p-9,  -0x1p-9, 0x1p-27,
        0x1p-28, 0x1p-54,  360.0 / 512, 720.0 / 512, 1e-300,  5e-324,  2.2250738585072014e-308,
        708,     -708,     -708.4,      709,         -745.13, 40,      -40,
        65536,   65535.99, 0x1p28,      0x1p60,      1e22,    1e300};
    for (int j = 1; j <= 1024; j += 7) {
      places.push_back(j * (3.141592653589793 / 512));   // sines on and between table places
      places.push_back(j * (0.6931471805599453 / 256));  // exponentials
      places.push_back(j / 512.0);                       // logarithms
    }
    for (const double place : places)
      for (const double x : {std::nextafter(place, -1e308), place, std::nextafter(place, 1e308)}) {
        if (x < f.low || x > f.high) continue;
        expect_rounded(f, reference, x);
        if (testing::Test::HasFatalFailure()) return;
      }
  }
}

TEST(ElementaryFunctions, SineAndCosineTogetherAreThoseOfEach) {
  const Stream stream(1, "sincos");
  for (std::uint64_t k = 0; k < 4000; ++k) {
    const double x = k < 2000 ? stream.uniform(k, -10, 10) : stream.uniform(k, -1e5, 1e5);
    const SineCosine both = elementary::sincos(x);
    ASSERT_EQ(both.sine, elementary::sin(x)) << x;
    ASSERT_EQ(both.cosine, elementary::cos(x)) << x;
  }
  EXPECT_TRUE(std::signbit(elementary::sincos(-0.0).sine));
  EXPECT_EQ(elementary::sincos(0).cosine, 1);
}

TEST(ElementaryFunctions, OfTwoArgumentsAreCorrectlyRounded) {
  Reference reference;
  const Stream stream(1, "two");
  std::uint64_t draw = 0;
  const auto any = [&](double least, double greatest) {
    const int exponent = static_cast<int>(std::floor(stream.uniform(draw++, least, greatest)));
    return std::ldexp(1 + stream.uniform(draw++), exponent);
  };
  for (int k = 0; k < 12000; ++k) {
    const bool wide = k % 3 == 0;
    const double x = wide ? any(-1000, 1000) : any(-6, 6);
    const double y = (k % 2 == 0 ? 1 : -1) * (wide ? any(-12, 3) : any(-6, 5));
    ASSERT_TRUE(same_bits(elementary::pow(x, y), reference(mpfr_pow, x, y)))
        << std::hexfloat << x << " ^ " << y << " is " << elementary::pow(x, y);
    const double a = wide ? any(-1070, 1020) : any(-4, 4);
    const double b = wide ? a * any(-60, 60) : any(-4, 4);
    ASSERT_TRUE(same_bits(elementary::hypot(a, -b), reference(mpfr_hypot, a, b)))
        << std::hexfloat << "hypot(" << a << ", " << b << ") is " << elementary::hypot(a, -b);
    if (k % 100 == 0) {
      ASSERT_TRUE(same_bits(elementary::atan2(y, x), reference(mpfr_atan2, y, x))) << x << ", " << y;
    }
  }
}

TEST(ElementaryFunctions, ExactResultsAreExact) {
  for (int n = -1074; n < 1024; ++n) EXPECT_EQ(elementary::log2(std::ldexp(1.0, n)), n);
  for (int n = -1074; n < 1024; ++n) EXPECT_EQ(elementary::exp2(n), std::ldexp(1.0, n)) << n;
  double ten = 1;
  for (int n = 0; n <= 22; ++n, ten *= 10) {
    EXPECT_EQ(elementary::pow(10, n), ten);
    EXPECT_EQ(elementary::log10(ten), n);
  }
  for (int a = 1; a < 40; ++a)
    for (int b = 1; b < 40; ++b) {
      const double side = a * a + b * b;
      EXPECT_EQ(elementary::hypot(2.0 * a * b, static_cast<double>(a * a - b * b)), side);
    }
  EXPECT_EQ(elementary::pow(0.25, -1.5), 8);
  EXPECT_EQ(elementary::pow(3, 33), 5559060566555523.0);
  EXPECT_EQ(elementary::pow(-2, 3), -8);
  EXPECT_EQ(elementary::exp(0), 1);
}

TEST(ElementaryFunctions, TiesGoToEven) {
  // (2^27 + 1)² = 2^54 + 2^28 + 1 is a tie, as are the odd multiples.
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double x = 0x1p27 + static_cast<double>(2 * k + 1);
    EXPECT_EQ(elementary::pow(x, 2), x * x) << x;
  }
}

TEST(ElementaryFunctions, SpecialValuesAreThoseOfAnnexF) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const auto same = [](double found, double wanted, const char* what) {
    EXPECT_TRUE(same_bits(found, wanted)) << what << " is " << found << ", not " << wanted;
  };
  for (const double x : {0.0, -0.0, inf, -inf, nan, 5e-324, -5e-324}) {
    same(elementary::sin(x), std::sin(x), "sin");
    same(elementary::cos(x), std::cos(x), "cos");
    same(elementary::tan(x), std::tan(x), "tan");
    same(elementary::asin(x), std::asin(x), "asin");
    same(elementary::acos(x), std::acos(x), "acos");
    same(elementary::atan(x), std::atan(x), "atan");
    same(elementary::asinh(x), std::asinh(x), "asinh");
    same(elementary::erf(x), x == 5e-324 || x == -5e-324 ? x : std::erf(x), "erf");
    same(elementary::exp(x), std::exp(x), "exp");
    same(elementary::exp2(x), std::exp2(x), "exp2");
    same(elementary::expm1(x), std::expm1(x), "expm1");
    same(elementary::log1p(x), std::log1p(x), "log1p");
    if (std::abs(x) == 5e-324 && x > 0) continue;
    same(elementary::cbrt(x), x == -5e-324 ? elementary::cbrt(x) : std::cbrt(x), "cbrt");
    same(elementary::log(x), std::log(x), "log");
    same(elementary::log2(x), std::log2(x), "log2");
    same(elementary::log10(x), std::log10(x), "log10");
  }
  same(elementary::log1p(-1), -inf, "log1p(-1)");
  same(elementary::log1p(-2), nan, "log1p(-2)");
  same(elementary::exp(1e6), inf, "exp");
  same(elementary::exp(-1e6), 0, "exp");
  same(elementary::expm1(-1e6), -1, "expm1");
  same(elementary::exp2(-1e6), 0, "exp2");
  const std::vector<double> special = {0.0, -0.0, 1.0, -1.0, 2.0, -2.0,  0.5,
                                       3.0, -3.0, inf, -inf, nan, 1e300, 5e-324};
  for (const double x : special)
    for (const double y : special) {
      const auto plain = [](double v) { return std::isfinite(v) && v != 0; };
      if (!plain(x) || !plain(y) || std::abs(x) == 1) {
        EXPECT_TRUE(same_bits(elementary::pow(x, y), std::pow(x, y))) << x << " ^ " << y;
      }
      if (!plain(x) || !plain(y)) {
        EXPECT_TRUE(same_bits(elementary::hypot(x, y), std::hypot(x, y))) << x << ", " << y;
        EXPECT_TRUE(same_bits(elementary::atan2(x, y), std::atan2(x, y))) << x << ", " << y;
      }
    }
}

TEST(ElementaryFunctions, MonotoneFromOneDoubleToTheNext) {
  const Stream stream(1, "neighbours");
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const double x = stream.uniform(k, 0.01, 20), next = std::nextafter(x, 100);
    EXPECT_LE(elementary::exp(x), elementary::exp(next));
    EXPECT_LE(elementary::log(x), elementary::log(next));
    EXPECT_LE(elementary::asinh(x), elementary::asinh(next));
    EXPECT_LE(elementary::hypot(x, 3), elementary::hypot(next, 3));
    EXPECT_GE(elementary::pow(x, -0.7), elementary::pow(next, -0.7));
  }
}

TEST(RoundToNearest, HoldsWithinAndGivesBackWhatWasSet) {
  const int before = std::fegetround();
  std::fesetround(FE_UPWARD);
  volatile double one = 1, tiny = 0x1p-60;
  {
    const RoundToNearest here;
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
    EXPECT_EQ(one + tiny, 1);
    EXPECT_EQ(elementary::exp(1), 0x1.5bf0a8b145769p+1);
  }
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  EXPECT_GT(one + tiny, 1);
  std::fesetround(before);
}

}  // namespace
}  // namespace asperity::elementary_functions_test
