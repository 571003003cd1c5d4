// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/edge_rows.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace asperity::edge_rows {

void pack(const std::uint8_t* bytes, std::size_t n, std::size_t place, std::uint64_t* words) {
  std::size_t k = 0;
  if (place % 8 == 0) {
    for (; k + 8 <= n; k += 8) {
      std::uint64_t eight;
      std::memcpy(&eight, bytes + k, sizeof eight);
      if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
      // Gathers the lowest bits of the bytes in the highest byte.
      const std::uint64_t packed = (eight * 0x0102040810204080u) >> 56;
      words[(place + k) / bits] |= packed << ((place + k) % bits);
    }
  }
  for (; k < n; ++k)
    words[(place + k) / bits] |= static_cast<std::uint64_t>(bytes[k]) << ((place + k) % bits);
}

void fill_bits(std::size_t place, std::size_t n, std::uint64_t* words) {
  while (n > 0) {
    const std::size_t within = place % bits, length = std::min(n, bits - within);
    words[place / bits] |= (~std::uint64_t{0} >> (bits - length)) << within;
    place += length;
    n -= length;
  }
}

void widen(Array<std::uint64_t>& field, int rows, std::size_t row_words, Array<std::uint64_t>& work) {
  const std::size_t words = static_cast<std::size_t>(rows) * row_words;
  for (std::size_t first = 0; first < words; first += row_words)
    for (std::size_t k = 0; k < row_words; ++k) {
      const std::size_t w = first + k;
      std::uint64_t word = field[w] | field[w] << 1 | field[w] >> 1;
      if (k > 0) word |= field[w - 1] >> (bits - 1);
      if (k + 1 < row_words) word |= field[w + 1] << (bits - 1);
      if (first > 0) word |= field[w - row_words];
      if (w + row_words < words) word |= field[w + row_words];
      work[w] = word;
    }
  std::swap(field, work);
}

void convert(const double* __restrict from, double scale, std::size_t n, float* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) to[k] = static_cast<float>(from[k] * scale);
}

void convert(const float* __restrict from, double scale, std::size_t n, double* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) to[k] = static_cast<double>(from[k]) * scale;
}

void keep_free(const std::uint8_t* __restrict free, std::size_t n, float* __restrict values) {
  for (std::size_t k = 0; k < n; ++k) values[k] = free[k] != 0 ? values[k] : 0.0f;
}

void start_free(const std::uint8_t* __restrict free, std::size_t n, float* __restrict given,
                float* __restrict factor, float* __restrict now, float* __restrict next) {
  for (std::size_t k = 0; k < n; ++k) {
    const float value = free[k] != 0 ? given[k] : 0.0f;
    given[k] = now[k] = next[k] = value;
    factor[k] = free[k] != 0 ? 0.0f : 0.25f;
  }
}

void start_bound(const std::uint8_t* __restrict free, const float* __restrict values, std::size_t n,
                 float* __restrict given, float* __restrict factor, float* __restrict now,
                 float* __restrict next) {
  for (std::size_t k = 0; k < n; ++k) {
    factor[k] = free[k] != 0 ? 0.0f : 0.25f;
    given[k] = now[k] = next[k] = factor[k] * values[k];
  }
}

void add_neighbours(const float* __restrict values, const float* __restrict v, std::ptrdiff_t stride,
                    std::size_t n, float* __restrict to) {
  for (std::size_t k = 0; k < n; ++k) {
    const float* const at = v + k;
    to[k] = values[k] + ((at[-1] + at[1]) + (at[-stride] + at[stride]));
  }
}

void sweep_groups(std::span<const std::uint32_t> groups, std::ptrdiff_t stride, const float* __restrict given,
                  const float* __restrict factor, const float* __restrict now, float* __restrict next) {
  for (const std::uint32_t start : groups) {
    const float* __restrict const at = now + start;
    const float* __restrict const add = given + start;
    const float* __restrict const times = factor + start;
    float* __restrict const to = next + start;
    for (int k = 0; k < group; ++k)
      to[k] = add[k] + times[k] * ((at[k - 1] + at[k + 1]) + (at[k - stride] + at[k + stride]));
  }
}

}  // namespace asperity::edge_rows
