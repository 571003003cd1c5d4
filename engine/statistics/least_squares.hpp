// SPDX-License-Identifier: GPL-3.0-or-later
// The least sum of weighted squares of any model, by Levenberg and Marquardt's method on the singular values
// of the scaled Jacobian, with derivatives by central differences of fourth order. It has converged when the
// residuals are orthogonal to what the parameters can do, relative to their length (Bates & Watts 1981), to
// 1e-10 or to the rounding of the model. A direction in which the scaled Jacobian is below 1e-8 of its
// largest is not determined by the points, and refused with the parameters that make it.
//
// Linear algebra is Eigen's, compiled for one processor alone, with sums in one order: the same bits
// everywhere. No header shows its types.
#pragma once

#include <span>
#include <vector>

#include "engine/statistics/curve_fit.hpp"

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

// Columns of the length of y, no more of them than there are y; every entry must be finite. O(n columns²).
LinearLeastSquares linear_least_squares(const TableColumns& columns, std::span<const double> y);

struct LeastSquares {
  std::vector<double> values;
  std::vector<double> scales;                   // of each parameter: steps of differences are in proportion
  std::vector<double> fitted;                   // of each point
  std::vector<std::vector<double>> covariance;  // of the estimates, for a scatter of 1
  int iterations = 0;
};

// Throws as fit_model does.
LeastSquares least_squares(const UsedPoints& points, const CurveModel& model,
                           std::span<const FitStart> start);

// The derivatives of the model at x; nan where the model has no value beside `parameters`.
std::vector<double> slopes_of(const CurveModel& model, double x, const std::vector<double>& parameters,
                              const std::vector<double>& scales);

// The root of the sum of their squares.
double length_of(const std::vector<double>& values);

}  // namespace asperity
