// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over rows of the contact preconditioner, apart so that each is plain arithmetic on arrays
// that do not overlap: marks of the free set as bits and their distance, conversion between single and
// double, and the Jacobi sweeps next to the free set's edge. No bounds are checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity::edge_rows {

constexpr int group = 8;  // nodes side by side that are swept together
constexpr int bits = 64;  // of a word of marks

// Sets bit place + k for each of `n` bytes, which are 0 or 1, that is 1.
void pack(const std::uint8_t* bytes, std::size_t n, std::size_t place, std::uint64_t* words);
// Sets the bits from `place` to place + n.
void fill_bits(std::size_t place, std::size_t n, std::uint64_t* words);
// Every bit of `rows` rows also to the four places beside it; `work` is as large as the field.
void widen(Array<std::uint64_t>& field, int rows, std::size_t row_words, Array<std::uint64_t>& work);

void convert(const double* from, double scale, std::size_t n, float* to);
void convert(const float* from, double scale, std::size_t n, double* to);
// values where free, else 0.
void keep_free(const std::uint8_t* free, std::size_t n, float* values);

// What sweeps start from, given = now = next, and D as factor: the given values on the free set, …
void start_free(const std::uint8_t* free, std::size_t n, float* given, float* factor, float* now,
                float* next);
// … or D times the values off it.
void start_bound(const std::uint8_t* free, const float* values, std::size_t n, float* given, float* factor,
                 float* now, float* next);
// next = given + factor · (sum of the four neighbours of now) on the groups, rows being `stride` apart.
void sweep_groups(std::span<const std::uint32_t> groups, std::ptrdiff_t stride, const float* given,
                  const float* factor, const float* now, float* next);
// to = values + the four neighbours of v.
void add_neighbours(const float* values, const float* v, std::ptrdiff_t stride, std::size_t n, float* to);

}  // namespace asperity::edge_rows
