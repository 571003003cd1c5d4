// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/least_squares.hpp"

// Own namespace: the linker must not merge Eigen code of other alignments.
#define Eigen asperity_least_squares_eigen
#define EIGEN_DONT_VECTORIZE
#define EIGEN_MAX_ALIGN_BYTES 0
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity {

double scalar_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double length_of(const std::vector<double>& values) { return std::sqrt(scalar_product(values, values)); }

SingularValues singular_values(const TableColumns& columns) {
  if (columns.empty()) return {};
  const auto n = static_cast<Eigen::Index>(columns.size()),
             points = static_cast<Eigen::Index>(columns.front().size());
  // Zero rows: as many directions as columns.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(std::max(points, n), n);
  for (Eigen::Index k = 0; k < n; ++k)
    matrix.col(k).head(points) =
        Eigen::Map<const Eigen::VectorXd>(columns[static_cast<std::size_t>(k)].data(), points);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
  SingularValues found;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto u = svd.matrixU().col(k).head(points);
    const auto v = svd.matrixV().col(k);
    found.values.push_back(svd.singularValues()[k]);
    found.u.emplace_back(u.begin(), u.end());
    found.v.emplace_back(v.begin(), v.end());
  }
  return found;
}

LinearLeastSquares linear_least_squares(const TableColumns& columns, std::span<const double> y) {
  using Matrix = Eigen::MatrixXd;
  // Fixed block sizes fix the order of sums.
  static const bool blocks_are_fixed = (Eigen::setCpuCacheSizes(1 << 15, 1 << 18, 1 << 21), true);
  (void)blocks_are_fixed;
  const auto rows = static_cast<Eigen::Index>(y.size()), count = static_cast<Eigen::Index>(columns.size());
  Matrix a(rows, count);
  for (Eigen::Index k = 0; k < count; ++k)
    a.col(k) = Eigen::Map<const Eigen::VectorXd>(columns[static_cast<std::size_t>(k)].data(), rows);
  const Eigen::HouseholderQR<Matrix> factors(a);
  const Matrix q = factors.householderQ() * Matrix::Identity(rows, count);
  const Matrix r = factors.matrixQR().topRows(count).triangularView<Eigen::Upper>();
  LinearLeastSquares found;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double length = r.col(k).norm();
    found.independence = std::min(found.independence, length > 0 ? std::abs(r(k, k)) / length : 0);
  }
  if (!(found.independence > 0)) return found;
  const Eigen::Map<const Eigen::VectorXd> given(y.data(), rows);
  const Eigen::VectorXd along = q.transpose() * given, residuals = given - q * along;
  const Matrix inverse = r.triangularView<Eigen::Upper>().solve(q.transpose());
  const Eigen::VectorXd coefficients = r.triangularView<Eigen::Upper>().solve(along);
  found.coefficients.assign(coefficients.data(), coefficients.data() + count);
  found.residuals.assign(residuals.data(), residuals.data() + rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    found.leverage.push_back(q.row(i).squaredNorm());
    const double* first = inverse.col(i).data();
    found.influence.emplace_back(first, first + count);
  }
  return found;
}

}  // namespace asperity
