// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier/fourier_lanes.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <type_traits>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity {

int smooth_length(int least) {
  for (int n = std::max(least, 1);; ++n) {
    int rest = n;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

UnitTurn unit_turn(std::int64_t k, std::int64_t n) {
  const std::int64_t eighths = 8 * k / n;
  auto angle = [n](std::int64_t part) {
    return 2 * std::numbers::pi * static_cast<double>(part) / static_cast<double>(8 * n);
  };
  // 8k = eighths·n + rest
  const std::int64_t rest = 8 * k - eighths * n;
  const bool odd = eighths % 2 != 0;
  const double part = angle(odd ? n - rest : rest);
  const auto [far, near] = elementary::sincos(part);
  const bool swapped = ((eighths + 1) & 2) != 0;
  UnitTurn turn{swapped ? far : near, swapped ? near : far};
  if (eighths >= 2 && eighths < 6) turn.cosine = -turn.cosine;
  if (eighths >= 4) turn.sine = -turn.sine;
  return turn;
}

namespace {

// In-place transforms; the forward kernel is e^{−2πi pq/radix}. Vectors only by reference.
template <bool forwards, class Complex>
inline __attribute__((always_inline)) void butterfly2(Complex& a, Complex& b) {
  const Complex d = {a.re - b.re, a.im - b.im};
  a.re += b.re;
  a.im += b.im;
  b = d;
}

template <bool forwards, class Complex>
inline __attribute__((always_inline)) void butterfly4(Complex& a, Complex& b, Complex& c, Complex& d) {
  const Complex s = {a.re + c.re, a.im + c.im}, t = {a.re - c.re, a.im - c.im};
  const Complex u = {b.re + d.re, b.im + d.im}, v = {b.re - d.re, b.im - d.im};
  a = {s.re + u.re, s.im + u.im};
  c = {s.re - u.re, s.im - u.im};
  if constexpr (forwards) {  // ∓i v
    b = {t.re + v.im, t.im - v.re};
    d = {t.re - v.im, t.im + v.re};
  } else {
    b = {t.re - v.im, t.im + v.re};
    d = {t.re + v.im, t.im - v.re};
  }
}

template <bool forwards, class Real, class Complex>
inline __attribute__((always_inline)) void butterfly8(Complex* x) {
  butterfly4<forwards>(x[0], x[2], x[4], x[6]);
  butterfly4<forwards>(x[1], x[3], x[5], x[7]);
  constexpr auto half = static_cast<Real>(0.70710678118654752440);
  const Complex p = x[3], q = x[7], r = x[5];
  if constexpr (forwards) {  // (1 − i)/√2, −i, (−1 − i)/√2
    x[3] = {(p.re + p.im) * half, (p.im - p.re) * half};
    x[5] = {r.im, -r.re};
    x[7] = {(q.im - q.re) * half, -(q.re + q.im) * half};
  } else {
    x[3] = {(p.re - p.im) * half, (p.im + p.re) * half};
    x[5] = {-r.im, r.re};
    x[7] = {-(q.im + q.re) * half, (q.re - q.im) * half};
  }
  // Even half in x[0], x[2], x[4], x[6]; multiplied odd half in x[1], x[3], x[5], x[7].
  Complex y[8];
  for (int k = 0; k < 4; ++k) {
    const Complex &e = x[2 * k], &o = x[2 * k + 1];
    y[k] = {e.re + o.re, e.im + o.im};
    y[k + 4] = {e.re - o.re, e.im - o.im};
  }
  for (int k = 0; k < 8; ++k) x[k] = y[k];
}

// cos and sin of 2π k (q + 1)/radix at [k − 1][q].
template <int radix, class Real>
struct OddFactors {
  static constexpr int half = radix / 2;
  Real cosine[half][half], sine[half][half];
  OddFactors() {
    for (int k = 1; k <= half; ++k)
      for (int q = 0; q < half; ++q) {
        const UnitTurn t = unit_turn((q + 1) * k % radix, radix);
        cosine[k - 1][q] = static_cast<Real>(t.cosine);
        sine[k - 1][q] = static_cast<Real>(t.sine);
      }
  }
};

template <bool forwards, int radix, class Real, class Complex>
inline __attribute__((always_inline)) void butterfly_odd(const OddFactors<radix, Real>& factors, Complex* x) {
  constexpr int half = radix / 2;
  Complex sum[half], difference[half], y[radix];
  y[0] = x[0];
  for (int q = 0; q < half; ++q) {
    const Complex &a = x[q + 1], &b = x[radix - 1 - q];
    sum[q] = {a.re + b.re, a.im + b.im};
    difference[q] = {a.re - b.re, a.im - b.im};
    y[0].re += sum[q].re;
    y[0].im += sum[q].im;
  }
  for (int k = 1; k <= half; ++k) {
    Complex even = x[0], odd;
    for (int q = 0; q < half; ++q) {
      const Real c = factors.cosine[k - 1][q], s = factors.sine[k - 1][q];
      even.re += c * sum[q].re;
      even.im += c * sum[q].im;
      if (q == 0) {
        odd = {s * difference[0].re, s * difference[0].im};
      } else {
        odd.re += s * difference[q].re;
        odd.im += s * difference[q].im;
      }
    }
    Complex& low = forwards ? y[k] : y[radix - k];
    Complex& high = forwards ? y[radix - k] : y[k];
    low = {even.re + odd.im, even.im - odd.re};
    high = {even.re - odd.im, even.im + odd.re};
  }
  for (int k = 0; k < radix; ++k) x[k] = y[k];
}

constexpr int odd_radices[] = {31, 29, 23, 19, 17, 13, 11, 7, 5, 3};

}  // namespace

template <class Real, int lanes>
bool LaneFourier<Real, lanes>::possible(int n) {
  if (n < 1) return false;
  while (n % 2 == 0) n /= 2;
  for (const int factor : odd_radices)
    while (n % factor == 0) n /= factor;
  return n == 1;
}

template <class Real, int lanes>
LaneFourier<Real, lanes>::LaneFourier(int n) : n_(n), places_(static_cast<std::size_t>(n > 0 ? n : 0)) {
  if (n < 1 || !possible(n))
    throw Error(ErrorCode::internal, "no transform of length " + std::to_string(n) + " in lanes");
  int rest = n, twos = 0;
  for (; rest % 2 == 0; rest /= 2) ++twos;
  std::vector<int> radices;
  for (const int factor : odd_radices)
    for (; rest % factor == 0; rest /= factor) radices.push_back(factor);
  int eights = 0;  // radix 8 last: the last stage has no factors
  for (; twos > 4 || twos == 3; twos -= 3) ++eights;
  for (; twos >= 2; twos -= 2) radices.push_back(4);
  if (twos == 1) radices.push_back(2);
  radices.insert(radices.end(), static_cast<std::size_t>(eights), 8);
  int block = n;
  for (const int radix : radices) {
    const int part = block / radix;
    stages_.push_back({radix, part, factors_.size()});
    for (int k = 0; k < part; ++k)
      for (int q = 1; q < radix; ++q) {
        const UnitTurn t = unit_turn(static_cast<std::int64_t>(k) * q % block, block);
        factors_.push_back(static_cast<Real>(t.cosine));
        factors_.push_back(static_cast<Real>(-t.sine));
      }
    block = part;
  }
  for (int k = 0; k < n; ++k) {
    int bin = k, place = 0;
    for (const Stage& stage : stages_) {
      place += bin % stage.radix * stage.part;
      bin /= stage.radix;
    }
    places_[static_cast<std::size_t>(k)] = place;
  }
}

template <class Real, int lanes>
template <bool forwards, int radix>
void LaneFourier<Real, lanes>::butterflies(const Stage& stage, Complex* values) const {
  const std::ptrdiff_t part = stage.part;
  const Real* factor = factors_.data() + stage.factor;
  struct Nothing {};
  constexpr bool odd = radix % 2 != 0;
  [[maybe_unused]] static const std::conditional_t<odd, OddFactors<radix, Real>, Nothing> constants;
  for (std::ptrdiff_t k = 0; k < part; ++k, factor += 2 * (radix - 1)) {
    Complex* const at = values + k;
    Complex x[radix];
    for (int q = 0; q < radix; ++q) x[q] = at[q * part];
    if constexpr (!forwards)
      if (k > 0)
        for (int q = 1; q < radix; ++q) {
          const Real c = factor[2 * q - 2], s = factor[2 * q - 1];
          x[q] = {x[q].re * c + x[q].im * s, x[q].im * c - x[q].re * s};
        }
    if constexpr (radix == 2)
      butterfly2<forwards>(x[0], x[1]);
    else if constexpr (radix == 4)
      butterfly4<forwards>(x[0], x[1], x[2], x[3]);
    else if constexpr (radix == 8)
      butterfly8<forwards, Real>(x);
    else
      butterfly_odd<forwards, radix, Real>(constants, x);
    if constexpr (forwards)
      if (k > 0)
        for (int q = 1; q < radix; ++q) {
          const Real c = factor[2 * q - 2], s = factor[2 * q - 1];
          x[q] = {x[q].re * c - x[q].im * s, x[q].im * c + x[q].re * s};
        }
    for (int q = 0; q < radix; ++q) at[q * part] = x[q];
  }
}

// Depth first: a finished block is in the nearest cache.
template <class Real, int lanes>
template <bool forwards>
void LaneFourier<Real, lanes>::run(std::size_t number, Complex* values) const {
  if (number == stages_.size()) return;
  const Stage& stage = stages_[number];
  const auto parts = [&] {
    if (stage.part == 1) return;
    for (int q = 0; q < stage.radix; ++q)
      run<forwards>(number + 1, values + static_cast<std::ptrdiff_t>(q) * stage.part);
  };
  if constexpr (!forwards) parts();
  [&]<int... radix>(std::integer_sequence<int, radix...>) {
    ((stage.radix == radix ? butterflies<forwards, radix>(stage, values) : void()), ...);
  }
  (std::integer_sequence<int, 2, 3, 4, 5, 7, 8, 11, 13, 17, 19, 23, 29, 31>());
  if constexpr (forwards) parts();
}

template <class Real, int lanes>
void LaneFourier<Real, lanes>::forward(Complex* values) const {
  run<true>(0, values);
}

template <class Real, int lanes>
void LaneFourier<Real, lanes>::inverse(Complex* values) const {
  run<false>(0, values);
}

template class LaneFourier<float>;
template class LaneFourier<double>;
template class LaneFourier<double, 1>;

}  // namespace asperity
