// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over rows of the contact preconditioner, apart so that each is plain arithmetic on arrays
// that do not overlap: marks of the free set as bits and their distance, conversion between single and
// double, and the sweeps next to the free set's edge. Sweeps take the two colours of a chessboard by turns,
// in place: a row is kept as its even columns and then, `half` values further on, its odd ones, so that the
// neighbours of eight nodes of one colour lie side by side. No bounds are checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"
#include "engine/core/memory.hpp"

namespace asperity::edge_rows {

constexpr int group = 8;            // nodes of one colour that are swept together
constexpr int columns = 2 * group;  // that they are spread over
constexpr int bits = 64;            // of a word of marks

// Sets bit place + k for each of `n` bytes, which are 0 or 1, that is 1.
void pack(const std::uint8_t* bytes, std::size_t n, std::size_t place, std::uint64_t* words);
// Whether one of two bytes, but not the other, is 0 anywhere.
bool differ(const std::uint8_t* a, const std::uint8_t* b, std::size_t n);
// 1 where a byte is not 0.
void copy_marks(const std::uint8_t* from, std::size_t n, std::uint8_t* to);
// Sets the bits from `place` to place + n.
void fill_bits(std::size_t place, std::size_t n, std::uint64_t* words);
// Every bit of `rows` rows also to the four places beside it; `work` is as large as the field.
void widen(Array<std::uint64_t>& field, int rows, std::size_t row_words, Array<std::uint64_t>& work);

// to += factor · from.
void add_times(double factor, const double* from, std::size_t n, double* to);
// to = offset + factor · from.
void convert(const double* from, double factor, double offset, std::size_t n, float* to);
void convert(const float* from, double scale, std::size_t n, double* to);
// to += the smooth row where free.
void add_free(const std::uint8_t* free, const SmoothRow<double>& from, std::size_t n, double* to);
// to = the smooth row.
void fill(const SmoothRow<float>& from, std::size_t n, float* to);

// What sums over hats take of a row: marks; offset + slope · values where free; a − b.
void add_marks(const std::uint8_t* free, std::size_t n, const SmoothExtension::Sums::Row<double>& to);
void add_residual(const std::uint8_t* free, const double* values, double slope, double offset, std::size_t n,
                  const SmoothExtension::Sums::Row<float>& to);
void add_difference(const float* a, const float* b, std::size_t n,
                    const SmoothExtension::Sums::Row<float>& to);
void add_values(const float* values, std::size_t n, const SmoothExtension::Sums::Row<float>& to);

// What sweeps over a row of a patch start from, columns `place` and on of it: offset + slope · values − less
// on the free set, else 0, as now, …
void start_free(const std::uint8_t* free, const double* values, double slope, double offset,
                const SmoothRow<float>& less, std::size_t n, std::size_t place, std::size_t half, float* now);
// … or the values as given and 0 as now.
void start_bound(const float* values, std::size_t n, std::size_t place, std::size_t half, float* given,
                 float* now);

// Where eight nodes of one colour begin in a patch, which has less than 2^24 places, and above that a bit for
// each that is not free.
using Group = std::uint32_t;
constexpr int start_bits = 24;
// Of every second of sixteen marks, from bit `lane` on.
Group group_of(std::size_t start, std::size_t lane, std::uint64_t marks);

// now = share · the sum of its four neighbours off the free set, on groups of the even or of the odd columns,
// rows being 2·half apart.
void sweep_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share, float* now);
// now = share · (given + the sum of its four neighbours) off the free set, 0 on it.
void sweep_back_groups(std::span<const Group> groups, bool odd, std::ptrdiff_t half, float share,
                       const float* given, float* now);
// The columns of a row of a patch in their order again, and `more` added.
void merge(const float* row, std::ptrdiff_t half, const SmoothRow<float>& more, std::size_t n, float* to);
// to = values + the four neighbours of the columns of a row where free, else 0.
void add_neighbours(const std::uint8_t* free, const float* values, const float* row, std::ptrdiff_t half,
                    std::size_t n, float* to);

}  // namespace asperity::edge_rows
