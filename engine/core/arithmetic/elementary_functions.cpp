// SPDX-License-Identifier: GPL-3.0-or-later
// A fast function computes high + low with an error bound. If high + (low ± bound) round alike, this is the
// result; otherwise MPFR decides, as for huge angles, subnormal results, zeros and infinities. Tables reduce
// the argument to three or four terms of a series, the first exact.
#include "engine/core/arithmetic/elementary_functions.hpp"

#include <mpfr.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

// Pairs of doubles, high + low, about 106 bits (Dekker 1971, Knuth, Møller). Requires rounding to nearest, no
// overflow, and no contraction of a*b+c.
namespace asperity::pairs {

struct Pair {
  double high, low;  // |low| is at most half a last place of `high`, except as noted
};

// a + b exactly if a is 0, |a| >= |b|, or a is a multiple of b's last place.
constexpr Pair quick_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

// a + b exactly.
constexpr Pair sum(double a, double b) {
  const double s = a + b;
  const double part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}

// a·b exactly, for products of 2^-960 … 2^990 and factors below 2^990.
constexpr Pair product(double a, double b) {
  const double p = a * b;
#if defined(__FMA__)
  if (!std::is_constant_evaluated()) return {p, std::fma(a, b, -p)};
#endif
  constexpr double splitter = 0x1p27 + 1;
  const double ca = splitter * a, cb = splitter * b;
  const double ah = ca - (ca - a), bh = cb - (cb - b);
  const double al = a - ah, bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

constexpr Pair plus(Pair a, Pair b) {
  const Pair high = sum(a.high, b.high), low = sum(a.low, b.low);
  const Pair first = quick_sum(high.high, high.low + low.high);
  return quick_sum(first.high, first.low + low.low);
}

constexpr Pair times(Pair a, Pair b) {
  const Pair p = product(a.high, b.high);
  return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

constexpr Pair over(Pair a, Pair b) {
  const double first = a.high / b.high;
  const Pair whole = times(b, {first, 0});
  const Pair rest = plus(a, {-whole.high, -whole.low});
  const double second = rest.high / b.high;
  const Pair left = plus(rest, times(b, {-second, 0}));
  const Pair result = quick_sum(first, second);
  return plus(result, {left.high / b.high, 0});
}

// The multiple of `unit`, a power of two, nearest to x; |x| < 2^51 units.
constexpr double to_multiple(double x, double unit) {
  const double shift = 0x1.8p52 * unit;
  return (x + shift) - shift;
}

}  // namespace asperity::pairs

// Tables, exact to 80 bits or more. High parts are short, so that products with a short factor are exact.
namespace asperity::elementary_tables {

using pairs::Pair;

inline constexpr Pair ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
inline constexpr Pair pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// Splits into a multiple of `unit` and the rest.
constexpr Pair short_high(Pair value, double unit) {
  const double high = pairs::to_multiple(value.high, unit);
  return {high, (value.high - high) + value.low};
}

constexpr std::array<Pair, 44> inverses() {
  std::array<Pair, 44> table{};
  for (std::size_t n = 1; n < table.size(); ++n) table[n] = pairs::over({1, 0}, {static_cast<double>(n), 0});
  return table;
}

// 2^(j/128), j = 0 … 127, as multiples of 2^-25 and the rest: Taylor series of exp(j ln 2/128).
constexpr std::array<Pair, 128> powers_of_two() {
  std::array<Pair, 128> table{};
  const auto inverse = inverses();
  for (int j = 0; j < 128; ++j) {
    const Pair x = pairs::times(ln2, {j / 128.0, 0});
    Pair value{1, 0};
    for (std::size_t n = 28; n >= 1; --n)
      value = pairs::plus({1, 0}, pairs::times(pairs::times(x, value), inverse[n]));
    table[static_cast<std::size_t>(j)] = short_high(value, 0x1p-25);
  }
  return table;
}

// sin(jπ/512), j = 0 … 256, as multiples of 2^-26 and the rest: Taylor series of the sine, beyond π/4 of the
// cosine.
constexpr std::array<Pair, 257> sines() {
  std::array<Pair, 257> table{};
  const auto inverse = inverses();
  for (int j = 0; j <= 256; ++j) {
    const bool near = j <= 128;
    const Pair x = pairs::times(pi, {(near ? j : 256 - j) / 512.0, 0});
    const Pair square = pairs::times(x, x);
    Pair value{1, 0};
    for (std::size_t n = 26; n >= 2; n -= 2) {
      const Pair divided = pairs::times(inverse[n], inverse[near ? n + 1 : n - 1]);
      const Pair term = pairs::times(pairs::times(square, value), divided);
      value = pairs::plus({1, 0}, {-term.high, -term.low});
    }
    if (near) value = pairs::times(x, value);
    table[static_cast<std::size_t>(j)] = short_high(value, 0x1p-26);
  }
  return table;
}

// 1/c, a multiple of 2^-9, and log c, a multiple of 2^-42 and the rest, for c near the middle of interval i
// of a significand in [360/512, 720/512): [360 + i, 361 + i)/512 for i = 0 … 151, below 1, and [104 + i, 105
// + i)/256 for i = 152 … 255. Both intervals next to 1 have c = 1.
struct Reciprocal {
  double reciprocal, log_high, log_low;
};
constexpr std::array<Reciprocal, 256> reciprocals() {
  std::array<Reciprocal, 256> table{};
  const auto inverse = inverses();
  for (int i = 0; i < 256; ++i) {
    const double middle = i < 152 ? (360.5 + i) / 512 : (104.5 + i) / 256;
    const double reciprocal = i == 151 || i == 152 ? 1 : pairs::to_multiple(1 / middle, 0x1p-9);
    // log c = −2 artanh((r − 1)/(r + 1)), r = 1/c
    const Pair z = pairs::over({reciprocal - 1, 0}, {reciprocal + 1, 0});
    const Pair square = pairs::times(z, z);
    Pair value{0, 0};
    for (std::size_t n = 43; n < inverse.size(); n -= 2)  // down to 1
      value = pairs::plus(inverse[n], pairs::times(square, value));
    value = pairs::times(z, value);
    const Pair split = short_high({-2 * value.high, -2 * value.low}, 0x1p-42);
    table[static_cast<std::size_t>(i)] = {reciprocal, split.high, split.low};
  }
  return table;
}

}  // namespace asperity::elementary_tables

namespace asperity::elementary {

namespace {

using pairs::Pair;

constexpr auto power_table = elementary_tables::powers_of_two();
constexpr auto sine_table = elementary_tables::sines();
constexpr auto reciprocal_table = elementary_tables::reciprocals();

constexpr double infinity = std::numeric_limits<double>::infinity();

// Frees MPFR's constants at thread exit.
struct ThreadConstants {
  ~ThreadConstants() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
};

// One rounding, also for subnormal results.
template <class Function, class... Arguments>
[[gnu::noinline]] double rounded_slowly(Function function, Arguments... arguments) {
  thread_local const ThreadConstants constants{};
  static_cast<void>(constants);
  struct Exponents {
    mpfr_exp_t least = mpfr_get_emin(), greatest = mpfr_get_emax();
    ~Exponents() {
      mpfr_set_emin(least);
      mpfr_set_emax(greatest);
    }
  };
  struct Number {
    mpfr_t value;
    explicit Number(double x) {
      mpfr_init2(value, 53);
      mpfr_set_d(value, x, MPFR_RNDN);
    }
    ~Number() { mpfr_clear(value); }
    Number(const Number&) = delete;
    Number& operator=(const Number&) = delete;
  };
  Number result(0);
  int direction = 0;
  [&](const auto&... number) {
    direction = function(result.value, number.value..., MPFR_RNDN);
  }(Number(arguments)...);
  const Exponents before;
  mpfr_set_emin(-1073);
  mpfr_set_emax(1024);
  direction = mpfr_check_range(result.value, direction, MPFR_RNDN);
  mpfr_subnormalize(result.value, direction, MPFR_RNDN);
  return mpfr_get_d(result.value, MPFR_RNDN);
}

// error| <= bound.
struct Unrounded {
  double high, low, bound;
};

// Whether both ends of the bound round to `result`.
inline bool decided(const Unrounded& value, double& result) {
  result = value.high + (value.low - value.bound);
  return result == value.high + (value.low + value.bound);
}

// log x with a relative error of at most 2^-67. x = 2^e m, m c' = 1 + r with a short c' = 1/c, so that r is
// exact in two parts: log x = e ln 2 + log c + r − r²/2 + r³/3 … The first three terms are summed exactly,
// with r² from a short part of r.
inline Pair logarithm(double x, double x_low = 0) {
  constexpr std::uint64_t first = 0x3fe6800000000000;  // 360/512
  constexpr double ln2_high = 0x1.62e42fefa38p-1, ln2_low = 0x1.ef35793c7673p-45;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t above = bits - first;
  const auto e = static_cast<std::int64_t>(above) >> 52;
  const elementary_tables::Reciprocal& near = reciprocal_table[(above >> 44) & 255];
  const std::uint64_t significand = bits - (above & 0xfff0000000000000);
  const double m = std::bit_cast<double>(significand);
  const double m_high = std::bit_cast<double>(significand & 0xfffffffff8000000);
  Pair r = pairs::quick_sum(m_high * near.reciprocal - 1, (m - m_high) * near.reciprocal);
  if (x_low != 0) {
    const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - e) << 52);
    r.low += x_low * scale * near.reciprocal;
    r = pairs::quick_sum(r.high, r.low);
  }
  const double power = static_cast<double>(e);
  const double base = power * ln2_high + near.log_high;
  const double r_short = pairs::to_multiple(r.high, 0x1p-34);
  const Pair linear = pairs::quick_sum(base, r.high);
  const Pair square = pairs::quick_sum(linear.high, -0.5 * (r_short * r_short));
  const double z = r.high, z2 = z * z;
  const double tail =
      (1.0 / 3 - z * 0.25) + z2 * ((0.2 - z * (1.0 / 6)) + z2 * ((1.0 / 7 - z * 0.125) + z2 * (1.0 / 9)));
  const double low = (power * ln2_low + near.log_low) + r.low * (1 - z * (1 - z)) -
                     0.5 * ((z - r_short) * (z + r_short)) + z * z2 * tail;
  return {square.high, (linear.low + square.low) + low};
}

// e^x = 2^k (high + low), high in [0.99, 2), error at most 2^-67; |x| < 2^16, |x_low| small compared with
// |x|. x = (128 k + j) ln 2/128 + r: e^x = 2^k 2^(j/128) (1 + r + r²/2 …), the second factor exact in a short
// part, times a short part of r.
struct Power {
  double high, low;
  std::int64_t k;
};
inline Power power_of_e(double x, double x_low) {
  constexpr double steps = 0x1.71547652b82fep+7;  // 128/ln 2
  constexpr double part1 = 0x1.62e42ff000000p-8, part2 = -0x1.718432a200000p-42,
                   part3 = 0x1.3c7673007e5edp-76;
  const double n = pairs::to_multiple(x * steps, 1);
  const Pair first = pairs::sum(x - n * part1, -(n * part2));
  const Pair r = pairs::sum(first.high, first.low - n * part3 + x_low);
  const auto whole = static_cast<std::int64_t>(n);
  const Pair& base = power_table[static_cast<std::size_t>(whole & 127)];
  const double r_short = pairs::to_multiple(r.high, 0x1p-34);
  const double z = r.high, z2 = z * z;
  const double tail = ((z - r_short) + r.low) +
                      z2 * ((0.5 + z * (1.0 / 6)) + z2 * ((1.0 / 24 + z * (1.0 / 120)) + z2 * (1.0 / 720)));
  const Pair main = pairs::quick_sum(base.high, base.high * r_short);
  return {main.high, main.low + (base.low + base.low * r_short + (base.high + base.low) * tail), whole >> 7};
}

inline double times_power_of_two(double x, std::int64_t k) {
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + k) << 52);
}

constexpr double power_error = 0x1p-66;

// x = (256 q + j) π/512 + high + low, |high| < π/1023. False near multiples of π/2 (parts too short) and for
// huge x.
struct Angle {
  double high, low;
  unsigned quarter, j;
};
inline bool reduce(double x, Angle& angle) {
  constexpr double steps = 0x1.45f306dc9c883p+7;  // 512/π
  constexpr double part1 = 0x1.921fb54p-8, part2 = 0x1.10b4612p-38, part3 = -0x1.676733bp-68,
                   part4 = 0x1.701b839a25205p-100;
  if (!(std::abs(x) < 65536)) return false;
  const double n = pairs::to_multiple(x * steps, 1);
  if (n == 0) {
    angle = {x, 0, 0, 0};
    return true;
  }
  const Pair first = pairs::sum(x - n * part1, -(n * part2));
  const Pair second = pairs::sum(first.high, -(n * part3));
  const double size = std::abs(second.high);
  if (size < std::abs(n) * 0x1p-75 || (size < 0x1p-43 && first.low != 0)) return false;
  const Pair rest = pairs::quick_sum(second.high, (first.low + second.low) - n * part4);
  const auto whole = static_cast<std::int64_t>(n);
  angle = {rest.high, rest.low, static_cast<unsigned>(whole >> 8) & 3, static_cast<unsigned>(whole & 255)};
  return true;
}

// s + c b − s b²/2 − c b³/6 … = s cos b + c sin b, s > 2^-8; relative error at most 2^-66.
inline Unrounded turned(const Pair& s, const Pair& c, double sign, const Angle& b) {
  const double z = b.high, z2 = z * z;
  const double z_short = pairs::to_multiple(z, 0x1p-34);
  const double c_all = sign * (c.high + c.low), s_all = s.high + s.low;
  const double sine_rest =
      ((z - z_short) + b.low) - z * z2 * (1.0 / 6 - z2 * (1.0 / 120 - z2 * (1.0 / 5040)));
  const double cosine_rest = z2 * (0.5 - z2 * (1.0 / 24 - z2 * (1.0 / 720)));
  const Pair main = pairs::quick_sum(s.high, sign * c.high * z_short);
  const double low = (s.low + sign * c.low * z_short) + (c_all * sine_rest - s_all * cosine_rest);
  return {main.high, main.low + low, main.high * 0x1p-66};
}

// sin and cos of jπ/512 + b.
inline Unrounded sine_of(const Angle& b) {
  if (b.j == 0) {
    const double z = b.high, z2 = z * z;
    const double cubic = z * z2 * (1.0 / 6 - z2 * (1.0 / 120 - z2 * (1.0 / 5040)));
    return {z, b.low - cubic, std::abs(z) * 0x1p-66};
  }
  return turned(sine_table[b.j], sine_table[256 - b.j], 1, b);
}
inline Unrounded cosine_of(const Angle& b) { return turned(sine_table[256 - b.j], sine_table[b.j], -1, b); }

// False if undecided.
inline bool sine_in_quarter(const Angle& angle, unsigned quarter, double& result) {
  const bool settled = decided(quarter % 2 == 0 ? sine_of(angle) : cosine_of(angle), result);
  if (quarter >= 2) result = -result;
  return settled;
}

inline bool is_normal_positive(double x) {
  return x >= std::numeric_limits<double>::min() && x <= std::numeric_limits<double>::max();
}

// √(square.high + square.low), relative error 2^-100.
inline Pair root_of(const Pair& square) {
  const double root = std::sqrt(square.high);
  const Pair back = pairs::product(root, root);
  return {root, ((square.high - back.high) - back.low + square.low) / (2 * root)};
}

// scale·log x.
template <class Function>
double scaled_logarithm(double x, const Pair& scale, Function function) {
  if (is_normal_positive(x)) {
    const Pair ln = logarithm(x), p = pairs::product(ln.high, scale.high);
    const double low = p.low + (ln.high * scale.low + ln.low * scale.high);
    double result = 0;
    if (decided({p.high, low, std::abs(p.high) * 0x1p-65}, result)) return result;
  }
  return rounded_slowly(function, x);
}

}  // namespace

double sin(double x) {
  Angle angle;
  double result = 0;
  if (std::abs(x) < 0x1p-27) return x;  // |x| − |x|³/6 is nearer to |x| than half a last place
  if (reduce(x, angle) && sine_in_quarter(angle, angle.quarter, result)) return result;
  return rounded_slowly(mpfr_sin, x);
}

double cos(double x) {
  Angle angle;
  double result = 0;
  if (reduce(x, angle) && sine_in_quarter(angle, (angle.quarter + 1) & 3, result)) return result;
  return rounded_slowly(mpfr_cos, x);
}

SineCosine sincos(double x) {
  Angle angle;
  if (std::abs(x) < 0x1p-27 || !reduce(x, angle)) return {sin(x), cos(x)};
  SineCosine result{};
  if (!sine_in_quarter(angle, angle.quarter, result.sine)) result.sine = rounded_slowly(mpfr_sin, x);
  if (!sine_in_quarter(angle, (angle.quarter + 1) & 3, result.cosine))
    result.cosine = rounded_slowly(mpfr_cos, x);
  return result;
}

double exp(double x) {
  if (x > -708 && x < 709) {
    const Power p = power_of_e(x, 0);
    double result = 0;
    if (decided({p.high, p.low, power_error}, result)) return times_power_of_two(result, p.k);
  } else if (x < -746) {
    return 0;
  } else if (x > 710) {
    return infinity;
  }
  return rounded_slowly(mpfr_exp, x);
}

double exp2(double x) {
  if (std::abs(x) < 1021) {
    const Pair scaled = pairs::product(x, elementary_tables::ln2.high);
    const Power p = power_of_e(scaled.high, scaled.low + x * elementary_tables::ln2.low);
    double result = 0;
    if (decided({p.high, p.low, power_error}, result)) return times_power_of_two(result, p.k);
  }
  return rounded_slowly(mpfr_exp2, x);
}

double expm1(double x) {
  double result = 0;
  if (std::abs(x) < 0x1p-54) return x;
  if (std::abs(x) < 0x1p-9) {
    const double x_short = pairs::to_multiple(x, 0x1p-35);
    const Pair main = pairs::quick_sum(x, 0.5 * (x_short * x_short));
    const double low =
        0.5 * ((x - x_short) * (x + x_short)) +
        x * x * x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x * (1.0 / 720 + x * (1.0 / 5040)))));
    if (decided({main.high, main.low + low, std::abs(main.high) * 0x1p-66}, result)) return result;
  } else if (x < -40) {
    return -1;
  } else if (x < 709) {
    const Power p = power_of_e(x, 0);
    const double high = times_power_of_two(p.high, p.k);
    const Pair main = pairs::sum(high, -1);
    if (decided({main.high, main.low + times_power_of_two(p.low, p.k), times_power_of_two(power_error, p.k)},
                result))
      return result;
  }
  return rounded_slowly(mpfr_expm1, x);
}

double log(double x) {
  if (is_normal_positive(x)) {
    const Pair ln = logarithm(x);
    double result = 0;
    if (decided({ln.high, ln.low, std::abs(ln.high) * 0x1p-66}, result)) return result;
  }
  return rounded_slowly(mpfr_log, x);
}

double log2(double x) {
  constexpr Pair scale{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};  // 1/ln 2
  return scaled_logarithm(x, scale, mpfr_log2);
}

double log10(double x) {
  constexpr Pair scale{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};  // 1/ln 10
  return scaled_logarithm(x, scale, mpfr_log10);
}

double log1p(double x) {
  if (std::abs(x) < 0x1p-54) return x;
  if (x > -1 && x < infinity) {
    const Pair argument = x < 0x1p60 ? pairs::sum(1, x) : Pair{x, 0};
    if (argument.high > 0) {
      const Pair ln = logarithm(argument.high, argument.low);
      double result = 0;
      if (decided({ln.high, ln.low, std::abs(ln.high) * 0x1p-65}, result)) return result;
    }
  }
  return rounded_slowly(mpfr_log1p, x);
}

double pow(double x, double y) {
  if (y == 1) return x;
  if (is_normal_positive(x) && x != 1) {
    const Pair ln = logarithm(x);
    const double size = std::abs(y * ln.high);
    if (size < 700 && size > 0x1p-60) {
      const Pair main = pairs::product(y, ln.high);
      const Pair p = pairs::quick_sum(main.high, main.low + y * ln.low);
      const Power power = power_of_e(p.high, p.low);
      double result = 0;
      if (decided({power.high, power.low, power_error + size * 0x1p-66}, result))
        return times_power_of_two(result, power.k);
    }
  }
  return rounded_slowly(mpfr_pow, x, y);
}

double hypot(double x, double y) {
  if (std::isfinite(x) && std::isfinite(y)) {
    double long_side = std::abs(x), short_side = std::abs(y);
    if (long_side < short_side) std::swap(long_side, short_side);
    if (short_side <= long_side * 0x1p-28) {
      // Half a last place is at least 2^-54 of the longer side; the shorter adds at most 2^-57.
      if (short_side == 0 || long_side >= 0x1p-900) return long_side;
    } else if (long_side >= 0x1p-960 && long_side <= 0x1p1022) {
      const std::uint64_t exponent = std::bit_cast<std::uint64_t>(long_side) >> 52;
      const double scale = std::bit_cast<double>((2046 - exponent) << 52);
      const double a = long_side * scale, b = short_side * scale;
      const Pair aa = pairs::product(a, a), bb = pairs::product(b, b);
      const Pair whole = pairs::quick_sum(aa.high, bb.high);
      const Pair root = root_of({whole.high, whole.low + (aa.low + bb.low)});
      double result = 0;
      if (decided({root.high, root.low, root.high * 0x1p-98}, result))
        return result * std::bit_cast<double>(exponent << 52);
    }
  }
  return rounded_slowly(mpfr_hypot, x, y);
}

double asinh(double x) {
  const double size = std::abs(x);
  double result = 0;
  if (size < 0x1p-27) return x;
  if (size < 0x1p-9) {
    const double square = x * x;
    const double cubic =
        x * square * (1.0 / 6 - square * (3.0 / 40 - square * (15.0 / 336 - square * (105.0 / 3456))));
    if (decided({x, -cubic, size * 0x1p-66}, result)) return result;
  } else if (size <= 0x1p1000) {
    // log(|x| + √(x² + 1))
    Pair argument{2 * size, 0.5 / size};
    if (size < 0x1p28) {
      const Pair square = pairs::product(size, size);
      const Pair whole = pairs::sum(square.high, 1);
      const Pair root = root_of({whole.high, whole.low + square.low});
      argument = pairs::quick_sum(root.high, size);
      argument = pairs::quick_sum(argument.high, argument.low + root.low);
    }
    const Pair ln = logarithm(argument.high, argument.low);
    if (decided({ln.high, ln.low, std::abs(ln.high) * 0x1p-65}, result)) return x < 0 ? -result : result;
  }
  return rounded_slowly(mpfr_asinh, x);
}

double tan(double x) { return rounded_slowly(mpfr_tan, x); }
double asin(double x) { return rounded_slowly(mpfr_asin, x); }
double acos(double x) { return rounded_slowly(mpfr_acos, x); }
double atan(double x) { return rounded_slowly(mpfr_atan, x); }
double atan2(double y, double x) { return rounded_slowly(mpfr_atan2, y, x); }
double cbrt(double x) { return rounded_slowly(mpfr_cbrt, x); }
double erf(double x) { return rounded_slowly(mpfr_erf, x); }

}  // namespace asperity::elementary
