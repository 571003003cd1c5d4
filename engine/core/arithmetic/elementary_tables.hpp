// SPDX-License-Identifier: GPL-3.0-or-later
// Tables for elementary_functions.cpp, exact to 80 bits or more, computed at compile time. High parts are
// short, so that products with a short factor are exact.
#pragma once

#include <array>
#include <cstddef>

#include "engine/core/arithmetic/pairs.hpp"

namespace asperity::elementary_tables {

using pairs::Pair;

inline constexpr Pair ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
inline constexpr Pair pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// Splits into a multiple of `unit` and the rest.
constexpr Pair short_high(Pair value, double unit) {
  const double high = pairs::to_multiple(value.high, unit);
  return {high, (value.high - high) + value.low};
}

// 1/n, n = 1 … 43.
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
