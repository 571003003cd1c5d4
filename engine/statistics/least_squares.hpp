// SPDX-License-Identifier: GPL-3.0-or-later
// Singular values of a table, and linear least squares.
//
// Linear algebra is Eigen's, compiled for one processor alone, with sums in one order: the same bits
// everywhere. No header shows its types.
#pragma once

#include <span>
#include <vector>

namespace asperity {

// Columns of equal length.
using TableColumns = std::vector<std::vector<double>>;

// The decomposition A = U Σ Vᵀ of a table, by Jacobi's rotations after a factorisation with pivots: small
// singular values keep their digits.
struct SingularValues {
  TableColumns u;              // orthonormal columns, as many as A has
  std::vector<double> values;  // descending, not negative
  TableColumns v;              // v[k][j]: component j of the direction of value k
};

// Every entry must be finite.
SingularValues singular_values(const TableColumns& columns);

// The least squares of y on columns, by Householder's QR decomposition.
struct LinearLeastSquares {
  std::vector<double> coefficients, residuals;
  std::vector<double> leverage;  // of each y on its own fitted value, from 0 to 1
  TableColumns influence;        // influence[i][k]: change of coefficient k with y[i]
  // The least part of a column that stands across those before it, relative to its length: near 0 where
  // columns are not told apart, and the rest is then not to be used.
  double independence = 1;
};

// Columns as long as y, and not more columns than y has numbers; every entry must be finite. O(n columns²).
LinearLeastSquares linear_least_squares(const TableColumns& columns, std::span<const double> y);

// The root of the sum of their squares.
double length_of(const std::vector<double>& values);

}  // namespace asperity
