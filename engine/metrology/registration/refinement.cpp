// SPDX-License-Identifier: GPL-3.0-or-later
// Each row keeps four tiles apart.
#include "engine/metrology/registration/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/statistics/least_squares.hpp"

namespace asperity::registration {

namespace {

constexpr int parameters = 6;  // x, y, turn, height, slope_x, slope_y
constexpr int tiles = 4;       // along each axis
using Vector6 = std::array<double, parameters>;

// Lower triangle by rows.
struct Normal {
  std::array<double, 21> entries{};
  Normal& operator+=(const Normal& other) {
    for (std::size_t k = 0; k < entries.size(); ++k) entries[k] += other.entries[k];
    return *this;
  }
  Normal& operator-=(const Normal& other) {
    for (std::size_t k = 0; k < entries.size(); ++k) entries[k] -= other.entries[k];
    return *this;
  }
};

// Cholesky; false unless the matrix, scaled to a unit diagonal, is positive definite to 1e-10.
bool solve(const Normal& normal, const Vector6& right, Vector6& x) {
  const auto at = [](int i, int j) { return static_cast<std::size_t>(i * (i + 1) / 2 + j); };
  const auto of = [](int i) { return static_cast<std::size_t>(i); };
  Vector6 scale;
  for (int i = 0; i < parameters; ++i) {
    const double diagonal = normal.entries[at(i, i)];
    if (!(diagonal > 0)) return false;
    scale[of(i)] = 1 / std::sqrt(diagonal);
  }
  std::array<double, 21> l{};
  for (int i = 0; i < parameters; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = normal.entries[at(i, j)] * scale[of(i)] * scale[of(j)];
      for (int k = 0; k < j; ++k) sum -= l[at(i, k)] * l[at(j, k)];
      if (i == j && !(sum > 1e-10)) return false;
      l[at(i, j)] = i == j ? std::sqrt(sum) : sum / l[at(j, j)];
    }
  for (int i = 0; i < parameters; ++i) {
    double sum = right[of(i)] * scale[of(i)];
    for (int k = 0; k < i; ++k) sum -= l[at(i, k)] * x[of(k)];
    x[of(i)] = sum / l[at(i, i)];
  }
  for (int i = parameters - 1; i >= 0; --i) {
    double sum = x[of(i)];
    for (int k = i + 1; k < parameters; ++k) sum -= l[at(k, i)] * x[of(k)];
    x[of(i)] = sum / l[at(i, i)];
  }
  for (int i = 0; i < parameters; ++i) x[of(i)] *= scale[of(i)];
  return true;
}

// Fixes the first three parameters.
void hold_pose(Normal& normal, Vector6& right) {
  for (std::size_t i = 0, k = 0; i < parameters; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k)
      if (j < 3) normal.entries[k] = i == j ? 1 : 0;
  right[0] = right[1] = right[2] = 0;
}

struct Sample {
  double residual = std::numeric_limits<double>::quiet_NaN();  // NaN: does not count
  double along_x = 0, along_y = 0, turned = 0;                 // derivatives of the model
};

// Per tile.
struct Sums {
  Normal weighted;   // Σ w J J'
  Normal curvature;  // Σ ψ' J J'
  Vector6 right{};   // Σ w J r
  double weight = 0, squares = 0, heights = 0, heights_squared = 0, count = 0;
  Sums& operator+=(const Sums& o) {
    weighted += o.weighted;
    curvature += o.curvature;
    for (std::size_t k = 0; k < right.size(); ++k) right[k] += o.right[k];
    weight += o.weight;
    squares += o.squares;
    heights += o.heights;
    heights_squared += o.heights_squared;
    count += o.count;
    return *this;
  }
};
using TileSums = std::array<Sums, tiles * tiles>;

class Problem {
 public:
  Problem(const MapPair& maps, int stride)
      : maps_(maps),
        stride_(stride),
        columns_((maps.after().nx() + stride - 1) / stride),
        rows_((maps.after().ny() + stride - 1) / stride),
        radius_(0.5 * std::max(maps.after().extent_x(), maps.after().extent_y())),
        samples_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  double radius() const { return radius_; }

  // Returns the number of counting samples.
  std::size_t sample(const Pose& pose, const Plane& plane) {
    const HeightMap& after = maps_.after();
    const NaturalSpline& before = maps_.before();
    const elementary::SineCosine turned = elementary::sincos(pose.turn);
    const double sine = turned.sine, cosine = turned.cosine;
    const double to_x = 1 / maps_.before_hx(), to_y = 1 / maps_.before_hy();
    const double middle_x = 0.5 * (before.nx() - 1), middle_y = 0.5 * (before.ny() - 1);
    for_each_row<8>(rows_, [&](int row) {
      const int j = row * stride_;
      const double y = after.y(j);
      for (int column = 0; column < columns_; ++column) {
        const int i = column * stride_;
        Sample& s = samples_[index(column, row)];
        s.residual = std::numeric_limits<double>::quiet_NaN();
        if (!maps_.after_counts(i, j)) continue;
        const double x = after.x(i);
        const double turned_x = cosine * x - sine * y, turned_y = sine * x + cosine * y;
        const double at_x = (turned_x + pose.x) * to_x + middle_x,
                     at_y = (turned_y + pose.y) * to_y + middle_y;
        if (!maps_.before_counts(at_x, at_y)) continue;
        const NaturalSpline::Value value = before.at(at_x, at_y);
        s.along_x = value.along_x * to_x;
        s.along_y = value.along_y * to_y;
        s.turned = (s.along_y * turned_x - s.along_x * turned_y) / radius_;
        s.residual =
            after.heights(i, j) - value.height - plane.height - plane.slope_x * x - plane.slope_y * y;
      }
    });
    std::size_t count = 0;
    for (const Sample& s : samples_) count += std::isnan(s.residual) ? 0 : 1;
    return count;
  }

  // Excludes samples within `reach` of |residual| > `far`, both signs to avoid bias; returns the number left.
  std::size_t leave_out(double far, double reach) {
    const HeightMap& after = maps_.after();
    const double step_x = after.hx * stride_, step_y = after.hy * stride_;
    const int wide = static_cast<int>(reach / step_x), high = static_cast<int>(reach / step_y);
    Array<unsigned char> near(samples_.size(), 0);
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        if (!(std::abs(samples_[index(column, row)].residual) > far)) continue;
        for (int b = std::max(0, row - high); b <= std::min(rows_ - 1, row + high); ++b)
          for (int a = std::max(0, column - wide); a <= std::min(columns_ - 1, column + wide); ++a) {
            const double x = (a - column) * step_x, y = (b - row) * step_y;
            if (x * x + y * y <= reach * reach) near[index(a, b)] = 1;
          }
      }
    std::size_t count = 0;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (near[k] != 0) samples_[k].residual = std::numeric_limits<double>::quiet_NaN();
      count += std::isnan(samples_[k].residual) ? 0 : 1;
    }
    return count;
  }

  // Standard deviation from the positive residuals.
  double upper_scale() {
    sorted_.clear();
    for (const Sample& s : samples_)
      if (s.residual > 0) sorted_.push_back(s.residual);
    if (sorted_.empty()) return 0;
    return 1.4826 * upper_median(sorted_);
  }

  // Middle of the shortest interval of two fifths of the residuals.
  double mode() {
    sorted_.clear();
    for (const Sample& s : samples_)
      if (!std::isnan(s.residual)) sorted_.push_back(s.residual);
    std::sort(sorted_.begin(), sorted_.end());
    const std::size_t held = std::max<std::size_t>(1, sorted_.size() * 2 / 5);
    double width = std::numeric_limits<double>::infinity(), middle = 0;
    for (std::size_t k = 0; k + held < sorted_.size(); ++k)
      if (sorted_[k + held] - sorted_[k] < width) {
        width = sorted_[k + held] - sorted_[k];
        middle = 0.5 * (sorted_[k + held] + sorted_[k]);
      }
    return middle;
  }

  TileSums sums(double scale, double tuning) const {
    std::vector<std::array<Sums, tiles>> of_rows(static_cast<std::size_t>(rows_));
    const double unit = 1 / std::max(tuning * scale, 1e-300);
    const HeightMap& after = maps_.after();
    for_each_row<8>(rows_, [&](int row) {
      std::array<Sums, tiles>& line = of_rows[static_cast<std::size_t>(row)];
      const double y = after.y(row * stride_) / radius_;
      for (int column = 0; column < columns_; ++column) {
        const Sample& s = samples_[index(column, row)];
        if (std::isnan(s.residual)) continue;
        Sums& to = line[static_cast<std::size_t>(column * tiles / columns_)];
        to.count += 1;
        const double u = s.residual * unit, u2 = u * u;
        if (!(u2 < 1)) continue;
        const double weight = (1 - u2) * (1 - u2), curvature = (1 - u2) * (1 - 5 * u2);
        const Vector6 j{s.along_x, s.along_y, s.turned, 1, after.x(column * stride_) / radius_, y};
        for (std::size_t a = 0, k = 0; a < parameters; ++a) {
          const double weighted = weight * j[a], curved = curvature * j[a];
          to.right[a] += weighted * s.residual;
          for (std::size_t b = 0; b <= a; ++b, ++k) {
            to.weighted.entries[k] += weighted * j[b];
            to.curvature.entries[k] += curved * j[b];
          }
        }
        const double height = after.heights(column * stride_, row * stride_);
        to.weight += weight;
        to.squares += weight * s.residual * s.residual;
        to.heights += weight * height;
        to.heights_squared += weight * height * height;
      }
    });
    TileSums result{};
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < tiles; ++column)
        result[static_cast<std::size_t>(row * tiles / rows_ * tiles + column)] +=
            of_rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    return result;
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  const MapPair& maps_;
  int stride_, columns_, rows_;
  double radius_;  // scales turn and slopes
  Array<Sample> samples_;
  Array<double> sorted_;
};

Sums total_of(const TileSums& of_tiles) {
  Sums total;
  for (const Sums& tile : of_tiles) total += tile;
  return total;
}

// One Newton step without the tile, with the biweight's curvature ψ': a new refinement to first order.
PoseUncertainty jackknifed(const Problem& problem, double scale, double tuning) {
  const TileSums of_tiles = problem.sums(std::max(scale, 1e-9), tuning);
  const Sums total = total_of(of_tiles);
  std::vector<Vector6> changes;
  for (const Sums& tile : of_tiles) {
    if (tile.count == 0) continue;
    Normal curvature = total.curvature, weighted = total.weighted;
    curvature -= tile.curvature;
    weighted -= tile.weighted;
    Vector6 right = total.right, change{};
    for (std::size_t k = 0; k < right.size(); ++k) right[k] -= tile.right[k];
    if (!solve(curvature, right, change) && !solve(weighted, right, change)) return {};
    changes.push_back(change);
  }
  if (changes.size() < 4) return {};
  const auto n = static_cast<double>(changes.size());
  Vector6 u{};
  for (std::size_t k = 0; k < u.size(); ++k) {
    double mean = 0, squares = 0;
    for (const Vector6& change : changes) mean += change[k] / n;
    for (const Vector6& change : changes) squares += (change[k] - mean) * (change[k] - mean);
    u[k] = std::sqrt((n - 1) / n * squares);
  }
  const double r = problem.radius();
  return {true, {u[0], u[1], u[2] / r}, {u[3], u[4] / r, u[5] / r}};
}

}  // namespace

MapPair::MapPair(const SmoothMap& before, SmoothMap after, double share)
    : share_(share),
      hx_(before.map.hx),
      hy_(before.map.hy),
      spline_(before.map.heights),
      before_share_(before.share),
      after_(std::move(after)) {
  const auto area = [share](const Field& shares, double cell) {
    double count = 0;
    for (const double value : shares.values()) count += value >= share ? 1 : 0;
    return count * cell;
  };
  smaller_area_ = std::min(area(before_share_, hx_ * hy_), area(after_.share, after_.map.hx * after_.map.hy));
}

bool MapPair::before_counts(double x, double y) const {
  if (!(x >= 0 && y >= 0 && x <= spline_.nx() - 1 && y <= spline_.ny() - 1)) return false;
  const int i = std::min(static_cast<int>(x), spline_.nx() - 2);
  const int j = std::min(static_cast<int>(y), spline_.ny() - 2);
  return before_share_(i, j) >= share_ && before_share_(i + 1, j) >= share_ &&
         before_share_(i, j + 1) >= share_ && before_share_(i + 1, j + 1) >= share_;
}

Refined refined(const MapPair& maps, const Pose& start, const RefinementOptions& options) {
  Problem problem(maps, options.stride);
  Refined found;
  found.pose = start;
  const double sample_area = maps.after().hx * maps.after().hy * options.stride * options.stride;
  for (int step = 0; step <= options.most_steps; ++step) {
    const std::size_t count = problem.sample(found.pose, found.plane);
    found.overlap = static_cast<double>(count) * sample_area / std::max(maps.smaller_area(), sample_area);
    found.possible = count >= 64 && found.overlap >= options.least_overlap;
    if (!found.possible) return found;
    if (step == 0) {
      found.plane.height = problem.mode();
      problem.sample(found.pose, found.plane);
    }
    found.residual = problem.upper_scale();
    // Equal maps: keeps samples that agree to rounding.
    const double scale = std::max(found.residual, 1e-9);
    Sums total = total_of(problem.sums(scale, options.tuning));
    if (options.plane_alone) hold_pose(total.weighted, total.right);
    const double variance = total.heights_squared - total.heights * total.heights / total.weight;
    found.explained = variance > 0 ? 1 - total.squares / variance : 0;
    if (found.converged || step == options.most_steps) return found;
    Vector6 change{};
    found.relief = found.possible = solve(total.weighted, total.right, change);
    if (!found.possible) return found;
    found.pose.x += change[0];
    found.pose.y += change[1];
    found.pose.turn += change[2] / problem.radius();
    found.plane.height += change[3];
    found.plane.slope_x += change[4] / problem.radius();
    found.plane.slope_y += change[5] / problem.radius();
    found.converged = !options.plane_alone && std::max({std::abs(change[0]), std::abs(change[1]),
                                                        std::abs(change[2])}) < options.tolerance;
  }
  return found;
}

// Smallest eigenvector of the Schur complement of shift and turn (plane eliminated): its last singular one.
Pose weakest_change(const MapPair& maps, const Refined& found, const RefinementOptions& options,
                    double length) {
  Problem problem(maps, options.stride);
  problem.sample(found.pose, found.plane);
  const Normal normal = total_of(problem.sums(std::max(found.residual, 1e-9), options.tuning)).weighted;
  std::array<std::array<double, parameters>, parameters> m{};
  for (std::size_t i = 0, k = 0; i < parameters; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) m[i][j] = m[j][i] = normal.entries[k];
  for (std::size_t p = parameters - 1; p >= 3; --p) {
    if (!(m[p][p] > 0)) continue;
    for (std::size_t i = 0; i < p; ++i) {
      const double share = m[i][p] / m[p][p];
      for (std::size_t j = 0; j < p; ++j) m[i][j] -= share * m[p][j];
    }
  }
  TableColumns complement(3);
  for (std::size_t k = 0; k < 3; ++k) complement[k].assign(m[k].begin(), m[k].begin() + 3);
  const std::vector<double> weakest = singular_values(complement).v.back();
  return {length * weakest[0], length * weakest[1], length * weakest[2] / problem.radius()};
}

PoseUncertainty jackknifed(const MapPair& maps, const Refined& found, const RefinementOptions& options) {
  Problem problem(maps, options.stride);
  problem.sample(found.pose, found.plane);
  return jackknifed(problem, found.residual, options.tuning);
}

UnwornPlane plane_of_unworn_ground(const MapPair& maps, const Refined& found, double reach,
                                   const RefinementOptions& options) {
  constexpr int steps = 8;
  constexpr double far_off = 3;       // scales
  constexpr double least_left = 0.1;  // of the samples
  Problem problem(maps, options.stride);
  UnwornPlane result{false, found.plane, {}};
  double scale = found.residual;
  for (int step = 0; step <= steps; ++step) {
    const std::size_t all = problem.sample(found.pose, result.plane);
    const std::size_t left = problem.leave_out(far_off * std::max(scale, 1e-9), reach);
    if (static_cast<double>(left) < std::max(64.0, least_left * static_cast<double>(all))) return {};
    if (step == steps) break;
    scale = problem.upper_scale();
    Sums total = total_of(problem.sums(std::max(scale, 1e-9), options.tuning));
    hold_pose(total.weighted, total.right);
    Vector6 change{};
    if (!solve(total.weighted, total.right, change)) return {};
    result.plane.height += change[3];
    result.plane.slope_x += change[4] / problem.radius();
    result.plane.slope_y += change[5] / problem.radius();
  }
  const PoseUncertainty u = jackknifed(problem, scale, options.tuning);
  result.possible = u.possible;
  result.u = u.plane;
  return result;
}

}  // namespace asperity::registration
