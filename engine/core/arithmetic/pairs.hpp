// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of doubles, high + low, about 106 bits: exact sum and product of doubles (Dekker 1971, Knuth,
// Møller), and constexpr arithmetic for tables. Requires rounding to nearest, no overflow, and no contraction
// of a*b+c.
#pragma once

#if defined(__FMA__)
#include <cmath>
#include <type_traits>
#endif

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

// a·b exactly, for products of 2^-960 … 2^990 and factors below 2^990. The error is a double, also found by
// fused multiply-add.
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
