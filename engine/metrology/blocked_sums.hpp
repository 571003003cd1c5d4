// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over blocks of 1024, added pairwise: same bits for any thread count. Powers of two keep squared
// heights of 1e-160 to 1e160 m in range.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

// Σ terms(k), k in [0, n); any thread may call `terms`. Memory: K·n/1024 doubles.
template <std::size_t K, class Terms>
std::array<double, K> blocked_sums(std::size_t n, const Terms& terms) {
  constexpr std::size_t block = 1024, blocks_per_turn = 64;
  const std::size_t blocks = (n + block - 1) / block;
  Array<double> partial(K * blocks);
  parallel_for(static_cast<std::int64_t>((blocks + blocks_per_turn - 1) / blocks_per_turn),
               [&](std::int64_t turn) {
                 const std::size_t first = static_cast<std::size_t>(turn) * blocks_per_turn;
                 for (std::size_t b = first; b < std::min(blocks, first + blocks_per_turn); ++b) {
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

// Two passes: the second corrects rounding under large offsets. Exact for equal values; no overflow.
double exact_mean(std::span<const double> values, const Range& values_range);

// Blocks of rows, each on one thread.
template <int rows_per_turn = 16, class Row>
void for_each_row(int ny, const Row& row) {
  parallel_for((ny + rows_per_turn - 1) / rows_per_turn, [&](std::int64_t turn) {
    const int first = static_cast<int>(turn) * rows_per_turn;
    for (int j = first; j < std::min(ny, first + rows_per_turn); ++j) row(j);
  });
}

}  // namespace asperity
