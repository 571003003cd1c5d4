// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stability/cross_checks/dense_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity::stability {

namespace {
using std::numbers::pi;

// ∫∫ 1/√(x² + y²) over the rectangle from the origin to (x, y).
double corner(double x, double y) {
  const auto term = [](double a, double b) { return a == 0 ? 0.0 : a * std::asinh(b / std::abs(a)); };
  return term(x, y) + term(y, x);
}

double love(const Grid& grid, int i, int j) {
  const double x = i * grid.hx(), y = j * grid.hy(), a = grid.hx() / 2, b = grid.hy() / 2;
  return (corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b) + corner(x - a, y - b)) / pi;
}

double waves(const Grid& grid, int i, int j) {
  double sum = 0;
  for (int b = 0; b < grid.ny; ++b)
    for (int a = 0; a < grid.nx; ++a) {
      if (a == 0 && b == 0) continue;
      const double qx = 2 * pi * std::min(a, grid.nx - a) / grid.size_x;
      const double qy = 2 * pi * std::min(b, grid.ny - b) / grid.size_y;
      sum += 2 / std::hypot(qx, qy) *
             std::cos(2 * pi * (static_cast<double>(a) * i / grid.nx + static_cast<double>(b) * j / grid.ny));
    }
  return sum / static_cast<double>(grid.nodes());
}

enum class At { zero, elastic, yielding, cap };

class Pivoting {
 public:
  Pivoting(const DenseProblem& problem, double mean_pressure)
      : problem_(problem),
        nodes_(static_cast<Eigen::Index>(problem.grid.nodes())),
        load_(mean_pressure * static_cast<double>(nodes_)),
        matrix_(influence_matrix(problem.grid, problem.boundary, problem.modulus)),
        at_(problem.grid.nodes(), At::elastic) {}

  DenseAnswer solve();

 private:
  At& at(Eigen::Index k) { return at_[static_cast<std::size_t>(k)]; }
  bool moves(Eigen::Index k) { return at(k) == At::elastic || at(k) == At::yielding; }
  bool any_moves() const {
    return std::any_of(at_.begin(), at_.end(), [](At s) { return s == At::elastic || s == At::yielding; });
  }
  void balance();
  At wanted(Eigen::Index k);
  bool pivot(DenseAnswer& answer);
  bool descend(DenseAnswer& answer);
  void make_feasible();
  bool let_two_go();

  const DenseProblem& problem_;
  Eigen::Index nodes_;
  double load_;
  Eigen::MatrixXd matrix_;
  std::vector<At> at_;
  Eigen::VectorXd p_, gap_;
  double offset_ = 0;
  double slack_ = 0;  // m: rounding error of the gaps
};

void Pivoting::balance() {
  std::vector<Eigen::Index> moving;
  p_ = Eigen::VectorXd::Zero(nodes_);
  double carried = 0;
  for (Eigen::Index k = 0; k < nodes_; ++k) {
    if (moves(k)) moving.push_back(k);
    if (at(k) == At::cap) carried += p_[k] = problem_.cap;
  }
  const auto m = static_cast<Eigen::Index>(moving.size());
  const Eigen::VectorXd held = matrix_ * p_;
  // The offset's row and column get the size of the others.
  const double unit = matrix_(0, 0);
  Eigen::MatrixXd a(m + 1, m + 1);
  Eigen::VectorXd b(m + 1);
  for (Eigen::Index r = 0; r < m; ++r) {
    const Eigen::Index k = moving[static_cast<std::size_t>(r)];
    for (Eigen::Index c = 0; c < m; ++c) a(r, c) = matrix_(k, moving[static_cast<std::size_t>(c)]);
    a(r, m) = a(m, r) = -unit;
    b[r] = problem_.heights[k] - held[k];
    if (at(k) == At::yielding) {
      a(r, r) += 1 / problem_.hardening;
      b[r] += problem_.yield / problem_.hardening;
    }
  }
  a(m, m) = 0;
  b[m] = -unit * (load_ - carried);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(a);
  Eigen::VectorXd x = lu.solve(b);
  x += lu.solve(b - a * x);
  for (Eigen::Index r = 0; r < m; ++r) p_[moving[static_cast<std::size_t>(r)]] = x[r];
  offset_ = x[m] * unit;
  gap_ = matrix_ * p_ - problem_.heights - Eigen::VectorXd::Constant(nodes_, offset_);
  const double lengths = (matrix_ * p_).cwiseAbs().maxCoeff() + problem_.heights.cwiseAbs().maxCoeff();
  slack_ = 1e-13 * lengths;
}

At Pivoting::wanted(Eigen::Index k) {
  const double p = p_[k];
  switch (at(k)) {
    case At::zero:
      return gap_[k] < -slack_ ? At::elastic : At::zero;
    case At::cap:
      return gap_[k] > slack_ ? At::elastic : At::cap;
    default:
      if (p < 0) return At::zero;
      if (p > problem_.cap) return At::cap;
      return p > problem_.yield ? At::yielding : At::elastic;
  }
}

// All nodes at once: few pivots, but no proof for a cap.
bool Pivoting::pivot(DenseAnswer& answer) {
  constexpr int together = 60;
  const int most = std::isfinite(problem_.yield) ? 3000 : together;  // without yielding, descend() is safer
  for (int n = 0; n < most; ++n, ++answer.pivots) {
    balance();
    const std::vector<At> before = at_;
    for (Eigen::Index k = 0; k < nodes_; ++k) {
      at(k) = wanted(k);
      // The first node by number cannot cycle (Murty 1974).
      if (n >= together && at_ != before) break;
    }
    if (at_ == before) return true;
    if (any_moves()) continue;
    at_ = before;
    return false;
  }
  return false;
}

// Nodes with room share the missing load.
void Pivoting::make_feasible() {
  p_ = p_.cwiseMax(0).cwiseMin(problem_.cap);
  const double carried = p_.sum();
  if (carried > load_)
    p_ *= load_ / carried;
  else if (std::isfinite(problem_.cap))
    p_ += (load_ - carried) / (problem_.cap * static_cast<double>(nodes_) - carried) *
          (Eigen::VectorXd::Constant(nodes_, problem_.cap) - p_);
  else
    p_.array() += (load_ - carried) / static_cast<double>(nodes_);
  for (Eigen::Index k = 0; k < nodes_; ++k)
    at(k) = p_[k] <= 0 ? At::zero : p_[k] >= problem_.cap ? At::cap : At::elastic;
}

// Only the gaps of both sets bracket the offset, unless two nodes should exchange pressure.
bool Pivoting::let_two_go() {
  gap_ = matrix_ * p_ - problem_.heights;
  Eigen::Index open = -1, full = -1;
  for (Eigen::Index k = 0; k < nodes_; ++k) {
    Eigen::Index& nearest = at(k) == At::cap ? full : open;
    const double sign = at(k) == At::cap ? 1 : -1;
    if (nearest < 0 || sign * gap_[k] > sign * gap_[nearest]) nearest = k;
  }
  offset_ = open < 0 ? gap_[full] : full < 0 ? gap_[open] : 0.5 * (gap_[open] + gap_[full]);
  if (open < 0 || full < 0 || gap_[full] <= gap_[open]) return false;
  at(open) = at(full) = At::elastic;
  return true;
}

// Active-set method (Nocedal & Wright 2006, §16.5): feasible throughout, one bound at a time.
bool Pivoting::descend(DenseAnswer& answer) {
  make_feasible();
  for (const int most = answer.pivots + 3000; answer.pivots < most; ++answer.pivots) {
    const Eigen::VectorXd from = p_;
    if (!any_moves() && !let_two_go()) return true;
    balance();
    double length = 1;
    Eigen::Index blocking = -1;
    for (Eigen::Index k = 0; k < nodes_; ++k) {
      const double step = p_[k] - from[k], bound = step > 0 ? problem_.cap : 0.0;
      if (at(k) != At::elastic || (p_[k] >= 0 && p_[k] <= problem_.cap)) continue;
      const double room = std::max(0.0, (bound - from[k]) / step);
      if (room < length) {
        length = room;
        blocking = k;
      }
    }
    if (blocking >= 0) {
      at(blocking) = p_[blocking] > from[blocking] ? At::cap : At::zero;
      p_ = from + length * (p_ - from);
      p_[blocking] = at(blocking) == At::cap ? problem_.cap : 0;
      continue;
    }
    Eigen::Index worst = -1;
    double most_wrong = slack_;
    for (Eigen::Index k = 0; k < nodes_; ++k) {
      const double wrong = at(k) == At::zero ? -gap_[k] : at(k) == At::cap ? gap_[k] : 0.0;
      if (wrong > most_wrong) {
        most_wrong = wrong;
        worst = k;
      }
    }
    if (worst < 0) return true;
    at(worst) = At::elastic;
  }
  return false;
}

DenseAnswer Pivoting::solve() {
  DenseAnswer answer;
  const bool yields = std::isfinite(problem_.yield);
  answer.solved = pivot(answer) || (!yields && descend(answer));
  answer.pressure = p_;
  answer.offset = offset_;
  return answer;
}

}  // namespace

Eigen::MatrixXd influence_matrix(const Grid& grid, Boundary boundary, double modulus) {
  const bool free = boundary == Boundary::free;
  Field influence(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      influence(i, j) = (free ? love(grid, i, j) : waves(grid, i, j)) / modulus;
  const auto n = static_cast<Eigen::Index>(grid.nodes());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index r = 0; r < n; ++r)
    for (Eigen::Index c = 0; c < n; ++c) {
      const int di = static_cast<int>(std::abs(r % grid.nx - c % grid.nx));
      const int dj = static_cast<int>(std::abs(r / grid.nx - c / grid.nx));
      matrix(r, c) = influence(di, dj);
    }
  return matrix;
}

DenseAnswer solve_densely(const DenseProblem& problem, double mean_pressure) {
  return Pivoting(problem, mean_pressure).solve();
}

}  // namespace asperity::stability
