// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/exact_phase.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#define MPFR_USE_INTMAX_T
#include <mpfr.h>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

class Real {
 public:
  explicit Real(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

// Frees MPFR's π at thread exit.
struct CacheGuard {
  ~CacheGuard() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
};

// cos(π·part/whole) for 0 ≤ part ≤ whole. Rational values (Niven) are exact; the second quadrant mirrors the
// first exactly.
void set_cosine(mpfr_ptr result, long part, long whole) {
  if (2 * part > whole) {
    set_cosine(result, whole - part, whole);
    mpfr_neg(result, result, MPFR_RNDN);
  } else if (part == 0) {
    mpfr_set_ui(result, 1, MPFR_RNDN);
  } else if (2 * part == whole) {
    mpfr_set_ui(result, 0, MPFR_RNDN);
  } else if (3 * part == whole) {
    mpfr_set_d(result, 0.5, MPFR_RNDN);
  } else {
    mpfr_const_pi(result, MPFR_RNDN);
    mpfr_mul_si(result, result, part, MPFR_RNDN);
    mpfr_div_si(result, result, whole, MPFR_RNDN);
    mpfr_cos(result, result, MPFR_RNDN);
  }
}

// floor(2⁶⁴·turns + ½) modulo 2⁶⁴; overwrites `turns`.
std::uint64_t fraction_of_turn(mpfr_ptr turns) {
  mpfr_mul_2ui(turns, turns, 64, MPFR_RNDN);
  mpfr_add_d(turns, turns, 0.5, MPFR_RNDN);
  mpfr_floor(turns, turns);
  // The rest is exact.
  mpfr_div_2ui(turns, turns, 64, MPFR_RNDN);
  mpfr_frac(turns, turns, MPFR_RNDN);
  mpfr_mul_2ui(turns, turns, 64, MPFR_RNDN);
  const bool negative = mpfr_sgn(turns) < 0;
  if (negative) mpfr_neg(turns, turns, MPFR_RNDN);
  const std::uint64_t low = mpfr_get_uj(turns, MPFR_RNDN);
  return negative ? 0 - low : low;
}

void check(double gamma, double span, int cells, int directions, int n_max) {
  if (!(std::isfinite(gamma) && gamma > 1))
    refuse("`gamma` is " + format_exact(gamma), "give a finite number above 1");
  if (!(std::isfinite(span) && span > 0))
    refuse("`span` is " + format_exact(span), "give a finite number above 0");
  if (cells < 1 || cells > max_cells)
    refuse("`cells` is " + std::to_string(cells) + " a side",
           "give a whole number from 1 to " + std::to_string(max_cells));
  if (const int greatest = greatest_wave_order(gamma); n_max < 0 || n_max > greatest)
    refuse("`n_max` is " + std::to_string(n_max),
           "with gamma = " + format_exact(gamma) + " give a whole number from 0 to " +
               std::to_string(greatest) + ": n_max*log2(gamma) may not exceed 2048, nor n_max 4096");
  if (directions < 1 || directions > max_wave_directions)
    refuse("`M` is " + std::to_string(directions),
           "give a whole number from 1 to " + std::to_string(max_wave_directions));
  if (const std::int64_t waves = std::int64_t{directions} * (n_max + 1); waves > max_waves)
    refuse("`M` of " + std::to_string(directions) + " and `n_max` of " + std::to_string(n_max) + " make " +
               std::to_string(waves) + " waves",
           "M*(n_max + 1) may be " + std::to_string(max_waves) + " at most");
}

// Below, the grain of the fractions would show in the heights.
constexpr double smallest_step = 0x1p-32;

mpfr_prec_t precision(double gamma, double span, int n_max) {
  constexpr mpfr_prec_t result_bits = 64, guard_bits = 64, least = 384;
  const auto whole_bits = static_cast<mpfr_prec_t>(std::ceil(n_max * elementary::log2(gamma)));
  const mpfr_prec_t span_bits = std::max(std::ilogb(span) + 1, 0);
  return std::max(whole_bits + span_bits + result_bits + guard_bits, least);
}

}  // namespace

UnitPhase unit_phase(std::uint64_t turns) {
  // Near a quarter, the angle is exact to double precision; quarters only swap and negate.
  const std::uint64_t quarter = (turns + (std::uint64_t{1} << 61)) >> 62;
  const auto rest = static_cast<std::int64_t>(turns - (quarter << 62));
  const double angle = static_cast<double>(rest) * (2.0 * std::numbers::pi * 0x1p-64);
  const auto [sine, cosine] = elementary::sincos(angle);
  UnitPhase phase{cosine, sine};
  for (std::uint64_t k = 0; k < quarter; ++k) phase = {-phase.sine, phase.cosine};
  return phase;
}

int greatest_wave_order(double gamma) {
  const double octaves = elementary::log2(gamma);
  if (!(octaves * max_wave_order > max_wave_octaves)) return max_wave_order;
  int order = static_cast<int>(max_wave_octaves / octaves);
  // The quotient may round across an integer; the product decides.
  while ((order + 1) * octaves <= max_wave_octaves) ++order;
  while (order * octaves > max_wave_octaves) --order;
  return order;
}

PhaseIncrements phase_increments(double gamma, double span, int cells, int directions, int n_max) {
  check(gamma, span, cells, directions, n_max);
  const CacheGuard guard;
  const mpfr_prec_t bits = precision(gamma, span, n_max);

  // The sine of direction m is the cosine of |M − 2m|/2M of a half turn.
  const int half = directions / 2;
  std::deque<Real> cosines, sines;
  for (long m = 0; m <= half; ++m) {
    stop_flag().check();
    set_cosine(cosines.emplace_back(bits), m, directions);
    set_cosine(sines.emplace_back(bits), std::labs(directions - 2 * m), 2L * directions);
  }

  PhaseIncrements table;
  table.directions = directions;
  table.n_max = n_max;
  const std::size_t waves = static_cast<std::size_t>(directions) * static_cast<std::size_t>(n_max + 1);
  table.x.resize(waves);
  table.y.resize(waves);

  Real step(bits), ratio(bits), turns(bits);
  mpfr_set_d(step, span, MPFR_RNDN);
  mpfr_div_si(step, step, cells, MPFR_RNDN);
  mpfr_set_d(ratio, gamma, MPFR_RNDN);
  for (int n = 0; n <= n_max; ++n) {
    stop_flag().check();
    if (mpfr_cmp_d(step, 0.5) <= 0) table.last_resolved = n;
    for (int m = 1; m <= directions; ++m) {
      const bool mirrored = m > half;
      const auto source = static_cast<std::size_t>(mirrored ? directions - m : m);
      const std::size_t k = table.index(m, n);
      mpfr_mul(turns, step, cosines[source], MPFR_RNDN);
      if (mirrored) mpfr_neg(turns, turns, MPFR_RNDN);
      table.x[k] = fraction_of_turn(turns);
      mpfr_mul(turns, step, sines[source], MPFR_RNDN);
      table.y[k] = fraction_of_turn(turns);
    }
    if (n == n_max && mpfr_cmp_d(step, smallest_step) < 0)
      refuse(
          "`span` is " + format_exact(span) + ": even the shortest wave turns less than 2^-32 times a cell",
          "give a longer span or a larger n_max");
    mpfr_mul(step, step, ratio, MPFR_RNDN);
  }
  return table;
}

}  // namespace asperity
