// SPDX-License-Identifier: GPL-3.0-or-later
// Adds a product of two tables to a third with Eigen's kernel, but the same bits on every processor: vectors
// are always full, stretches short, and nothing is fused.
#pragma once

#include <cstddef>

namespace asperity::table_product {

// Multiples: the widest vectors, and the columns processed together.
inline constexpr int row_step = 24, column_step = 4;

// sum(i, j) += Σ left(i, k) right(k, j) over `depth` terms. Strides separate columns of `left` and `sum`, and
// rows of `right`. rows > 0 is a multiple of row_step, columns > 0 of column_step. Single-threaded.
void add(int rows, int columns, int depth, const double* left, std::ptrdiff_t left_stride,
         const double* right, std::ptrdiff_t right_stride, double* sum, std::ptrdiff_t sum_stride);

}  // namespace asperity::table_product
