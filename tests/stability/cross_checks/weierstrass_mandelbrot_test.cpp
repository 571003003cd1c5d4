// SPDX-License-Identifier: GPL-3.0-or-later
// Weierstrass–Mandelbrot heights against their definition summed in MPFR with as many bits as γⁿ has and 128
// more, at random nodes, for orders far past where any hardware float holds a phase. (All 101 published
// orders on 57 nodes, and in quadruple precision, stand beside the generator's own tests.)
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <ostream>

#include "engine/core/random.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

namespace asperity::stability {
namespace {

// A number of MPFR that frees itself.
class Number {
 public:
  explicit Number(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
  ~Number() { mpfr_clear(value_); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

// z(i, j) over L (G/L)^(D−2) √(ln γ/M), phases by draw of the seed.
double definition(const WeierstrassMandelbrotOptions& o, int i, int j) {
  const auto bits = static_cast<mpfr_prec_t>(128 + std::ceil(o.n_max * std::log2(o.gamma)));
  Number sum(bits), step(bits), turns(bits), angle(bits), term(bits), pi(bits), cosine(bits), sine(bits);
  mpfr_const_pi(pi, MPFR_RNDN);
  mpfr_set_zero(sum, 1);
  for (int m = 1; m <= o.M; ++m) {
    mpfr_mul_si(angle, pi, m, MPFR_RNDN);
    mpfr_div_si(angle, angle, o.M, MPFR_RNDN);
    mpfr_sin_cos(sine, cosine, angle, MPFR_RNDN);
    mpfr_mul_si(cosine, cosine, i, MPFR_RNDN);
    mpfr_mul_si(sine, sine, j, MPFR_RNDN);
    // Turns at order 0: (i cos + j sin)·span/nx; each order has γ times as many.
    mpfr_add(step, cosine, sine, MPFR_RNDN);
    mpfr_mul_d(step, step, o.span, MPFR_RNDN);
    mpfr_div_si(step, step, o.nx, MPFR_RNDN);
    for (int n = 0; n <= o.n_max; ++n, mpfr_mul_d(step, step, o.gamma, MPFR_RNDN)) {
      const double phase = seeded_phase_turns(o.seed, o.M, m, n);
      mpfr_frac(turns, step, MPFR_RNDN);
      mpfr_add_d(turns, turns, phase, MPFR_RNDN);
      mpfr_mul(angle, turns, pi, MPFR_RNDN);
      mpfr_mul_ui(angle, angle, 2, MPFR_RNDN);
      mpfr_set_prec(term, 128);
      mpfr_set(term, angle, MPFR_RNDN);
      mpfr_cos(term, term, MPFR_RNDN);
      Number start(128), weight(128);
      mpfr_set_d(start, phase, MPFR_RNDN);
      mpfr_mul(start, start, pi, MPFR_RNDN);
      mpfr_mul_ui(start, start, 2, MPFR_RNDN);
      mpfr_cos(start, start, MPFR_RNDN);
      mpfr_sub(term, start, term, MPFR_RNDN);
      mpfr_set_d(weight, o.gamma, MPFR_RNDN);
      mpfr_log(weight, weight, MPFR_RNDN);
      mpfr_mul_d(weight, weight, (o.D - 3) * n, MPFR_RNDN);
      mpfr_exp(weight, weight, MPFR_RNDN);
      mpfr_mul(term, term, weight, MPFR_RNDN);
      mpfr_add(sum, sum, term, MPFR_RNDN);
    }
  }
  return mpfr_get_d(sum, MPFR_RNDN);
}

double scale(const WeierstrassMandelbrotOptions& o) {
  return o.L * std::pow(o.G / o.L, o.D - 2) * std::sqrt(std::log(o.gamma) / o.M);
}

struct Case {
  double D, span, gamma;
  int M, n_max, cells, points;
};
void PrintTo(const Case& c, std::ostream* out) { *out << "D " << c.D << ", orders to " << c.n_max; }
class Multiprecision : public testing::TestWithParam<Case> {};

TEST_P(Multiprecision, HeightsAreTheSumOfTheDefinition) {
  const Case& c = GetParam();
  WeierstrassMandelbrotOptions o;
  o.nx = o.ny = c.cells;
  o.D = c.D;
  o.span = c.span;
  o.gamma = c.gamma;
  o.M = c.M;
  o.n_max = c.n_max;
  o.seed = 5;
  const Surface surface = weierstrass_mandelbrot(o);
  const Stream stream(o.seed, "points");
  const double unit = scale(o);
  const double amplitude = surface.peak_to_valley();
  for (int k = 0; k < c.points; ++k) {
    const auto draw = static_cast<std::uint64_t>(2 * k);
    const int i = static_cast<int>(stream.below(draw, static_cast<std::uint64_t>(o.nx)));
    const int j = static_cast<int>(stream.below(draw + 1, static_cast<std::uint64_t>(o.ny)));
    const double error = std::abs(surface.height(i, j) - unit * definition(o, i, j)) / amplitude;
    EXPECT_LE(error, 1e-14) << i << ", " << j;  // measured 1.5e-15
  }
}
INSTANTIATE_TEST_SUITE_P(Orders, Multiprecision,
                         testing::Values(Case{2.5, 1, 1.5, 10, 0, 64, 3}, Case{2.5, 3, 1.5, 10, 100, 150, 6},
                                         Case{2.99, 3, 1.5, 10, 100, 150, 6},
                                         Case{2.9, .37, 1.37, 7, 400, 97, 4},
                                         Case{2.99, 1, 1.5, 4, 1500, 61, 3}, Case{3, 1, 1.5, 3, 1500, 61, 3},
                                         Case{2.999, 2.6, 2, 3, 2000, 128, 3},
                                         Case{2.995, 1, 1.01, 3, 2000, 128, 3}),
                         [](const auto& c) {
                           return "Orders" + std::to_string(c.param.n_max) + "Case" + std::to_string(c.index);
                         });

}  // namespace
}  // namespace asperity::stability
