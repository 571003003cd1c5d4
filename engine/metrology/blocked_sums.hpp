// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over blocks of 1024, added pairwise. Powers of two keep squared heights of 1e-160 to 1e160 m in range.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

// Σ terms(k), k in [0, n); any thread may call `terms`. Memory: K·n/1024 doubles.
template <std::size_t K, class Terms>
std::array<double, K> blocked_sums(std::size_t n, const Terms& terms) {
  constexpr std::size_t block = 1024, blocks_per_turn = 64;
  const std::size_t blocks = (n + block - 1) / block;
  Array<double> partial(K * blocks);
  for_each_block(blocks, blocks_per_turn, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      std::array<double, K> sum{};
      for (std::size_t k = b * block; k < std::min(n, (b + 1) * block); ++k) {
        const std::array<double, K> term = terms(k);
        for (std::size_t q = 0; q < K; ++q) sum[q] += term[q];
      }
      for (std::size_t q = 0; q < K; ++q) partial[q * blocks + b] = sum[q];
    }
  });
  std::array<double, K> total{};
  for (std::size_t q = 0; q < K; ++q)
    total[q] = block_sum(std::span<const double>(partial).subspan(q * blocks, blocks));
  return total;
}

// e with value·2^-e in [1/2, 1), clamped so that 2^±e is finite; 0 for 0.
inline int scale_exponent(double value) {
  int e = 0;
  std::frexp(value, &e);
  return std::clamp(e, -1000, 1024);
}

inline double magnitude(const Range& r) { return std::max(std::abs(r.min), std::abs(r.max)); }

// The second pass corrects rounding under large offsets. Exact for equal values; no overflow.
inline double exact_mean(std::span<const double> values, const Range& values_range) {
  if (values.empty() || values_range.min == values_range.max) return values_range.min;
  const int e = scale_exponent(magnitude(values_range));
  const double down = std::ldexp(1.0, -e);
  const auto n = static_cast<double>(values.size());
  const double first =
      blocked_sums<1>(values.size(), [&](std::size_t k) { return std::array{values[k] * down}; })[0] / n;
  const double rest =
      blocked_sums<1>(values.size(), [&](std::size_t k) { return std::array{values[k] * down - first}; })[0] /
      n;
  return std::clamp(std::ldexp(first + rest, e), values_range.min, values_range.max);
}

inline double mean_of_known(const Field& z, bool holes) {
  if (!holes) return exact_mean(z.values(), range(z.values()));
  Array<double> known;
  std::ranges::copy_if(z.values(), std::back_inserter(known), [](double v) { return !std::isnan(v); });
  return exact_mean(known, range(known));
}

}  // namespace asperity
