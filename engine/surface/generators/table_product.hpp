// SPDX-License-Identifier: GPL-3.0-or-later
// A product of two tables added to a third, by Eigen's kernel and yet the same bits on every processor: each
// value of the sum receives its terms one after the other. Eigen chooses by the processor how wide its
// vectors are, how long a stretch of terms it adds at a time, and whether it fuses multiply and add; so
// vectors are always filled, stretches are short, and nothing is fused.
#pragma once

#include <cstddef>

namespace asperity::table_product {

// Rows and columns come in multiples of these: of the widest vectors, and of the columns that are worked on
// together.
inline constexpr int row_step = 24, column_step = 4;

// sum(i, j) += Σ left(i, k) right(k, j) over `depth` terms. Consecutive rows of `left` and `sum`, and
// consecutive columns of `right`, are neighbours; strides lead from column to column (of `right` from row to
// row). rows > 0 is a multiple of row_step, columns > 0 of column_step. On the calling thread; allocates two
// blocks of some 100 KiB.
void add(int rows, int columns, int depth, const double* left, std::ptrdiff_t left_stride,
         const double* right, std::ptrdiff_t right_stride, double* sum, std::ptrdiff_t sum_stride);

}  // namespace asperity::table_product
