// SPDX-License-Identifier: GPL-3.0-or-later
// Height of a Weierstrass–Mandelbrot surface (surface/generators/weierstrass_mandelbrot.hpp), exact to a
// double: its series with the bits of the highest wave number plus 128. Shares only the random phases with
// the generator. Slow.
#include "engine/study/exact/closed_forms.hpp"

#include <mpfr.h>

#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity::exact {

namespace {

constexpr mpfr_prec_t guard_bits = 128;

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

// φ/2π of wave (m, n). Golden phases k·0.6180339887498949, k = m·(n_max+1) + n, are not rounded to a double.
void set_phase(mpfr_ptr phase, const WeierstrassMandelbrotOptions& o, int m, int n) {
  switch (o.phases) {
    case WavePhases::seeded:
      mpfr_set_d(phase, seeded_phase_turns(o.seed, o.M, m, n), MPFR_RNDN);
      return;
    case WavePhases::golden:
      mpfr_set_ui(phase, 6180339887498949UL, MPFR_RNDN);
      mpfr_mul_ui(phase, phase, static_cast<unsigned long>(m) * (o.n_max + 1) + n, MPFR_RNDN);
      mpfr_div_ui(phase, phase, 10000000000000000UL, MPFR_RNDN);
      mpfr_frac(phase, phase, MPFR_RNDN);
      return;
    case WavePhases::function:
      break;
  }
  throw Error(ErrorCode::bad_value, "an exact height needs `phases` drawn from the seed, or \"golden\"");
}

void cosine_of_turns(mpfr_ptr result, mpfr_ptr turns, mpfr_ptr pi, Number& angle) {
  mpfr_mul(angle, turns, pi, MPFR_RNDN);
  mpfr_mul_ui(angle, angle, 2, MPFR_RNDN);
  mpfr_cos(result, angle, MPFR_RNDN);
}

}  // namespace

double weierstrass_mandelbrot_height(const WeierstrassMandelbrotOptions& o, int i, int j) {
  const auto bits = static_cast<mpfr_prec_t>(guard_bits + std::ceil(o.n_max * elementary::log2(o.gamma)));
  Number sum(bits), step(bits), turns(bits), pi(bits), cosine(bits), sine(bits), angle(bits);
  Number phase(guard_bits), term(guard_bits), short_angle(guard_bits), weight(guard_bits);
  mpfr_const_pi(pi, MPFR_RNDN);
  mpfr_set_zero(sum, 1);
  for (int m = 1; m <= o.M; ++m) {
    mpfr_mul_si(angle, pi, m, MPFR_RNDN);
    mpfr_div_si(angle, angle, o.M, MPFR_RNDN);
    mpfr_sin_cos(sine, cosine, angle, MPFR_RNDN);
    mpfr_mul_si(cosine, cosine, i, MPFR_RNDN);
    mpfr_mul_si(sine, sine, j, MPFR_RNDN);
    // Turns at order 0; each order multiplies them by γ.
    mpfr_add(step, cosine, sine, MPFR_RNDN);
    mpfr_mul_d(step, step, o.span, MPFR_RNDN);
    mpfr_div_si(step, step, o.nx, MPFR_RNDN);
    for (int n = 0; n <= o.n_max; ++n, mpfr_mul_d(step, step, o.gamma, MPFR_RNDN)) {
      set_phase(phase, o, m, n);
      mpfr_frac(turns, step, MPFR_RNDN);
      mpfr_add(turns, turns, phase, MPFR_RNDN);
      cosine_of_turns(term, turns, pi, short_angle);
      cosine_of_turns(phase, phase, pi, short_angle);
      mpfr_sub(term, phase, term, MPFR_RNDN);
      mpfr_set_d(weight, o.gamma, MPFR_RNDN);
      mpfr_log(weight, weight, MPFR_RNDN);
      mpfr_mul_d(weight, weight, o.D - 3, MPFR_RNDN);
      mpfr_mul_si(weight, weight, n, MPFR_RNDN);
      mpfr_exp(weight, weight, MPFR_RNDN);
      mpfr_mul(term, term, weight, MPFR_RNDN);
      mpfr_add(sum, sum, term, MPFR_RNDN);
    }
  }
  // L (G/L)^(D−2) √(ln γ/M)
  mpfr_set_d(weight, o.gamma, MPFR_RNDN);
  mpfr_log(weight, weight, MPFR_RNDN);
  mpfr_div_si(weight, weight, o.M, MPFR_RNDN);
  mpfr_sqrt(weight, weight, MPFR_RNDN);
  mpfr_set_d(term, o.G, MPFR_RNDN);
  mpfr_div_d(term, term, o.L, MPFR_RNDN);
  mpfr_log(term, term, MPFR_RNDN);
  mpfr_set_d(phase, o.D, MPFR_RNDN);
  mpfr_sub_ui(phase, phase, 2, MPFR_RNDN);
  mpfr_mul(term, term, phase, MPFR_RNDN);
  mpfr_exp(term, term, MPFR_RNDN);
  mpfr_mul(weight, weight, term, MPFR_RNDN);
  mpfr_mul_d(weight, weight, o.L, MPFR_RNDN);
  mpfr_mul(sum, sum, weight, MPFR_RNDN);
  return mpfr_get_d(sum, MPFR_RNDN);
}

}  // namespace asperity::exact
