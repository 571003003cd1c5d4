// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/least_squares.hpp"

// A namespace of its own: the linker must not take for these functions what another source compiled of
// Eigen's, with other alignments.
#define Eigen asperity_least_squares_eigen
#define EIGEN_DONT_VECTORIZE
#define EIGEN_MAX_ALIGN_BYTES 0
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr int most_steps = 200;
constexpr double orthogonal = 1e-10;   // residuals to the tangent plane, relative
constexpr double rounding = 1e-14;     // of the model, relative to the data
constexpr double undetermined = 1e-8;  // a singular value relative to the largest
constexpr double part_of_direction = 0.05;
constexpr double difference_step = 1e-3;  // about epsilon^(1/5), of a parameter's scale

std::string parameters_text(std::span<const FitStart> start, const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k)
    text += (k > 0 ? ", " : "") + start[k].name + " = " + format_short(values[k]);
  return text;
}

class Problem {
 public:
  Problem(const UsedPoints& points, const CurveModel& model, std::span<const FitStart> start)
      : points_(points), model_(model), start_(start) {
    for (const double weight : points.weights) roots_.push_back(std::sqrt(weight));
    std::vector<double> weighted(points.y.size());
    for (std::size_t k = 0; k < weighted.size(); ++k) weighted[k] = roots_[k] * points.y[k];
    size_ = length_of(weighted);
  }

  std::size_t parameters() const { return start_.size(); }
  double size() const { return size_; }

  // Nothing where a value is not finite.
  std::optional<std::vector<double>> fitted(const std::vector<double>& q) const {
    std::vector<double> values;
    values.reserve(points_.x.size());
    for (const double x : points_.x) {
      values.push_back(model_(x, q));
      if (!std::isfinite(values.back())) return {};
    }
    return values;
  }

  std::vector<double> residuals(const std::vector<double>& fitted) const {
    std::vector<double> r(fitted.size());
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = roots_[k] * (points_.y[k] - fitted[k]);
    return r;
  }

  // Weighted derivatives by each parameter.
  TableColumns jacobian(const std::vector<double>& q, const std::vector<double>& scales) const {
    TableColumns columns(q.size(), std::vector<double>(points_.x.size()));
    for (std::size_t k = 0; k < points_.x.size(); ++k) {
      const std::vector<double> slopes = slopes_of(model_, points_.x[k], q, scales);
      for (std::size_t p = 0; p < q.size(); ++p) {
        if (!std::isfinite(slopes[p]))
          throw Error(ErrorCode::bad_value,
                      "the model is no finite number beside x = " + format_short(points_.x[k]) + " with " +
                          parameters_text(start_, q),
                      "begin from other values, or write the model so that it has a value nearby");
        columns[p][k] = roots_[k] * slopes[p];
      }
    }
    return columns;
  }

  // What a parameter that begins at 0 is measured by: the largest power of ten by which it moves the model by
  // no more than the data.
  double scale_at_zero(const std::vector<double>& q, std::size_t p, const std::vector<double>& at) const {
    const double wanted = std::max(size_, std::numeric_limits<double>::min());
    for (double scale = 1e6; scale > 1e-18; scale /= 10) {
      std::vector<double> moved = q;
      moved[p] += scale;
      const auto there = fitted(moved);
      moved[p] = q[p] - scale;
      const auto other = there ? fitted(moved) : std::nullopt;
      if (!other) continue;
      std::vector<double> change(at.size());
      for (std::size_t k = 0; k < at.size(); ++k) change[k] = roots_[k] * ((*there)[k] - at[k]);
      if (length_of(change) <= wanted) return scale;
    }
    return 1;
  }

 private:
  const UsedPoints& points_;
  const CurveModel& model_;
  std::span<const FitStart> start_;
  std::vector<double> roots_;
  double size_ = 0;
};

// The scaled Jacobian at a place, decomposed.
struct Tangent {
  std::vector<double> column_lengths;
  SingularValues svd;
  std::vector<double> along;  // of the residuals along each direction
  double offset = 0;          // of the residuals along those that are determined
};

Tangent tangent_at(TableColumns jacobian, const std::vector<double>& residuals) {
  Tangent found;
  for (auto& column : jacobian) {
    const double length = length_of(column);
    found.column_lengths.push_back(length);
    if (length > 0)
      for (double& value : column) value /= length;
  }
  found.svd = singular_values(jacobian);
  double sum = 0;
  for (std::size_t k = 0; k < found.svd.values.size(); ++k) {
    double product = 0;
    for (std::size_t i = 0; i < residuals.size(); ++i) product += found.svd.u[k][i] * residuals[i];
    found.along.push_back(product);
    if (found.svd.values[k] > undetermined * found.svd.values[0]) sum += product * product;
  }
  found.offset = std::sqrt(sum);
  return found;
}

std::vector<double> step_of(const Tangent& at, double damping) {
  std::vector<double> step(at.column_lengths.size());
  for (std::size_t k = 0; k < step.size(); ++k) {
    const double s = at.svd.values[k];
    if (!(s > undetermined * at.svd.values[0])) continue;
    const double share = at.along[k] * s / (s * s + damping);
    for (std::size_t p = 0; p < step.size(); ++p) step[p] += share * at.svd.v[k][p];
  }
  for (std::size_t p = 0; p < step.size(); ++p)
    step[p] = at.column_lengths[p] > 0 ? step[p] / at.column_lengths[p] : 0;
  return step;
}

void refuse_undetermined(const Tangent& at, std::span<const FitStart> start) {
  std::vector<std::string> dead, mixed;
  for (std::size_t p = 0; p < start.size(); ++p)
    if (!(at.column_lengths[p] > 0)) dead.push_back(quoted(start[p].name));
  if (!dead.empty())
    throw Error(ErrorCode::infeasible,
                "the points say nothing of " + joined(dead, " and ") + ": the model does not change with " +
                    (dead.size() == 1 ? "it" : "them"),
                "leave out what the model does not use, or begin from values at which it acts");
  for (std::size_t p = 0; p < start.size(); ++p)
    for (std::size_t k = 0; k < start.size(); ++k)
      if (!(at.svd.values[k] > undetermined * at.svd.values[0]) &&
          std::abs(at.svd.v[k][p]) > part_of_direction) {
        mixed.push_back(quoted(start[p].name));
        break;
      }
  if (!mixed.empty())
    throw Error(ErrorCode::infeasible,
                "the points do not tell " + joined(mixed, " and ") +
                    " apart: they can change together and leave every fitted value as it is",
                "fix all but one of them, or measure where they act differently");
}

// Where the sum falls for ever: the points want the limit of the model, in which parameters are not apart.
void refuse_runaways(const std::vector<double>& values, const std::vector<double>& natural,
                     std::span<const FitStart> start) {
  constexpr double far = 1e6;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < values.size(); ++p)
    if (std::abs(values[p]) > far * natural[p]) names.push_back(quoted(start[p].name));
  if (!names.empty())
    throw Error(
        ErrorCode::infeasible,
        "the points do not determine " + joined(names, " and ") + ": the sum of squares falls for ever as " +
            (names.size() == 1 ? "it grows" : "they grow"),
        "the points may show less than the model has, as a straight line where it bends: fit a simpler one");
}

std::vector<std::vector<double>> covariance_of(const Tangent& at) {
  const std::size_t n = at.column_lengths.size();
  std::vector<std::vector<double>> covariance(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k)
        sum += at.svd.v[k][i] * at.svd.v[k][j] / (at.svd.values[k] * at.svd.values[k]);
      covariance[i][j] = sum / (at.column_lengths[i] * at.column_lengths[j]);
    }
  return covariance;
}

}  // namespace

double length_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

SingularValues singular_values(const TableColumns& columns) {
  if (columns.empty()) return {};
  const auto n = static_cast<Eigen::Index>(columns.size()),
             points = static_cast<Eigen::Index>(columns.front().size());
  // Rows of zeros where there are fewer than columns: as many directions as columns, all the same.
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

std::vector<double> slopes_of(const CurveModel& model, double x, const std::vector<double>& parameters,
                              const std::vector<double>& scales) {
  std::vector<double> slopes;
  std::vector<double> q = parameters;
  for (std::size_t p = 0; p < q.size(); ++p) {
    double slope = std::numeric_limits<double>::quiet_NaN();
    // A smaller step where the model ends nearby.
    for (double share = difference_step; !std::isfinite(slope) && share > 1e-7; share /= 30) {
      const double step = (parameters[p] + share * scales[p]) - parameters[p];
      const auto value = [&](double steps) {
        q[p] = parameters[p] + steps * step;
        return model(x, q);
      };
      slope = (8 * (value(1) - value(-1)) - (value(2) - value(-2))) / (12 * step);
    }
    q[p] = parameters[p];
    slopes.push_back(slope);
  }
  return slopes;
}

LinearLeastSquares linear_least_squares(const TableColumns& columns, std::span<const double> y) {
  using Matrix = Eigen::MatrixXd;
  // Blocks of products as of one processor, so that sums have one order everywhere.
  static const bool blocks_are_fixed = (Eigen::setCpuCacheSizes(1 << 15, 1 << 18, 1 << 21), true);
  (void)blocks_are_fixed;
  const auto rows = static_cast<Eigen::Index>(y.size()), count = static_cast<Eigen::Index>(columns.size());
  Matrix a(rows, count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < rows; ++i)
      a(i, k) = columns[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
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

LeastSquares least_squares(const UsedPoints& points, const CurveModel& model,
                           std::span<const FitStart> start) {
  const Problem problem(points, model, start);
  LeastSquares found;
  for (const FitStart& parameter : start) {
    if (!std::isfinite(parameter.value))
      throw Error(ErrorCode::bad_value, quoted(parameter.name) + " begins from a value that is not finite");
    found.values.push_back(parameter.value);
  }
  auto begin = problem.fitted(found.values);
  if (!begin)
    throw Error(
        ErrorCode::bad_value,
        "the model is no finite number at every x with the start " + parameters_text(start, found.values),
        "begin from values at which it is one");
  found.fitted = *std::move(begin);
  std::vector<double> natural;
  for (std::size_t p = 0; p < start.size(); ++p)
    natural.push_back(start[p].value != 0 ? std::abs(start[p].value)
                                          : problem.scale_at_zero(found.values, p, found.fitted));
  found.scales = natural;
  std::vector<double> residuals = problem.residuals(found.fitted);
  double damping = 1e-3, last_offset = std::numeric_limits<double>::infinity();
  int stalled = 0;
  for (found.iterations = 0;; ++found.iterations) {
    stop_flag().check();
    Tangent tangent = tangent_at(problem.jacobian(found.values, found.scales), residuals);
    const double length = length_of(residuals);
    stalled = tangent.offset < 0.5 * last_offset ? 0 : stalled + 1;
    last_offset = std::min(last_offset, tangent.offset);
    const bool at_floor = stalled > 3 && tangent.offset <= 1e-6 * length;
    if (tangent.offset <= orthogonal * length || tangent.offset <= rounding * problem.size() || at_floor) {
      refuse_undetermined(tangent, start);
      found.covariance = covariance_of(tangent);
      return found;
    }
    bool moved = false;
    for (; damping < 1e20 && !moved; damping *= 10) {
      const std::vector<double> step = step_of(tangent, damping);
      std::vector<double> next = found.values;
      for (std::size_t p = 0; p < next.size(); ++p) next[p] += step[p];
      auto there = problem.fitted(next);
      if (!there) continue;
      std::vector<double> left = problem.residuals(*there);
      // Near the least sum its changes are below its last digits, and the step is right all the same.
      const double allowed = tangent.offset < 1e-6 * length ? length * (1 + 1e-12) : length;
      if (!(length_of(left) < allowed)) continue;
      found.values = std::move(next);
      found.fitted = *std::move(there);
      residuals = std::move(left);
      moved = true;
    }
    if (!moved || found.iterations >= most_steps) {
      refuse_undetermined(tangent, start);
      refuse_runaways(found.values, natural, start);
      throw Error(ErrorCode::not_converged,
                  "the fit found no least sum of squares" +
                      (moved ? " in " + std::to_string(most_steps) + " steps" : std::string()) +
                      "; it ended at " + parameters_text(start, found.values),
                  "begin nearer to the answer, or write the model with fewer parameters");
    }
    damping = std::max(damping * 1e-3, 1e-20);
    // Steps of differences follow a parameter that leaves 0, or comes near it.
    for (std::size_t p = 0; p < start.size(); ++p) {
      const double acts =
          tangent.column_lengths[p] > 0 ? 0.01 * problem.size() / tangent.column_lengths[p] : natural[p];
      found.scales[p] = std::max(std::abs(found.values[p]), std::min(natural[p], acts));
      if (!(found.scales[p] > 0)) found.scales[p] = natural[p];
    }
  }
}

}  // namespace asperity
