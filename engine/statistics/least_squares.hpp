// SPDX-License-Identifier: GPL-3.0-or-later
// Singular values and linear least squares, with Eigen hidden in the source. Sums have one order: the same
// bits on every processor.
#pragma once

#include <span>
#include <vector>

namespace asperity {

// Columns of equal length.
using TableColumns = std::vector<std::vector<double>>;

// A = U Σ Vᵀ by Jacobi rotations after a pivoted factorisation: small singular values are accurate.
struct SingularValues {
  TableColumns u;              // orthonormal
  std::vector<double> values;  // descending, ≥ 0
  TableColumns v;              // v[k][j]: component j of direction k
};

// Finite entries.
SingularValues singular_values(const TableColumns& columns);

// Fit of y by Householder's QR.
struct LinearLeastSquares {
  std::vector<double> coefficients, residuals;
  std::vector<double> leverage;  // of each y on its own fit, 0 to 1
  TableColumns influence;        // influence[i][k]: d coefficient k / d y[i]
  // Smallest relative length of a column orthogonal to the previous columns. Near 0, the other results are
  // unusable.
  double independence = 1;
};

// Columns as long as y, no more columns than rows, finite entries. O(n columns²).
LinearLeastSquares linear_least_squares(const TableColumns& columns, std::span<const double> y);

double length_of(const std::vector<double>& values);

}  // namespace asperity
