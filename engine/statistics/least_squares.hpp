// SPDX-License-Identifier: GPL-3.0-or-later
// Singular values and linear least squares, with Eigen hidden in the source and the same bits on every
// processor.
#pragma once

#include <span>
#include <vector>

namespace asperity {

// Columns of equal length.
using TableColumns = std::vector<std::vector<double>>;

// A = U Σ Vᵀ by Jacobi rotations after a pivoted factorisation: accurate also for small values.
struct SingularValues {
  TableColumns u;              // orthonormal
  std::vector<double> values;  // descending, ≥ 0
  TableColumns v;              // component j of direction k
};

// Finite entries.
SingularValues singular_values(const TableColumns& columns);

// Fit of y by Householder's QR.
struct LinearLeastSquares {
  std::vector<double> coefficients, residuals;
  std::vector<double> leverage;  // 0 to 1
  TableColumns influence;        // d coefficient k / d y[i]
  // Smallest relative length of a column orthogonal to the previous columns. Near 0, other results are
  // unusable.
  double independence = 1;
};

// Finite columns as long as y, no more columns than rows. O(n columns²).
LinearLeastSquares linear_least_squares(const TableColumns& columns, std::span<const double> y);

// In order: one sum.
double scalar_product(const std::vector<double>& a, const std::vector<double>& b);
double length_of(const std::vector<double>& values);

}  // namespace asperity
