// SPDX-License-Identifier: GPL-3.0-or-later
// Five-point Laplacian on the missing nodes, positive definite because every hole touches a measured node.
// Conjugate gradients, preconditioned on two levels: a Gauss-Seidel sweep, a correction constant on blocks of
// nodes, and the mirrored sweep. Small maps have blocks of one node: the correction is the solution.
#include "engine/surface/operations/holes.hpp"

// Own namespace: the linker must not merge this code with Eigen code compiled with other vectors.
#define Eigen asperity_holes_eigen
#define EIGEN_DONT_VECTORIZE
#define EIGEN_MAX_ALIGN_BYTES 0
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
using Vector = Eigen::VectorXd;
using Cholesky = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>>;

// Relative residual; the error of heights is up to a hundred times as large.
constexpr double enough = 1e-14;
constexpr int most_steps = 1000;
constexpr std::int64_t parts_of_task = 1000;

// Eigen's memory, counted against the limit of the run.
class CountedMemory {
 public:
  CountedMemory(std::size_t nodes, std::size_t cells)
      : bytes_(220 * static_cast<std::int64_t>(nodes) + 4 * static_cast<std::int64_t>(cells)) {
    constexpr std::size_t most_nodes = std::numeric_limits<std::int32_t>::max() / 5;
    if (nodes > most_nodes || bytes_ > memory::of_machine() || !memory::account(bytes_))
      throw Error(ErrorCode::out_of_memory,
                  "interpolating " + std::to_string(nodes) + " missing heights needs " +
                      format_short(static_cast<double>(bytes_) / 1e9, 3) + " GB, more than there is",
                  "crop the map, or give `fill` a height instead");
  }
  ~CountedMemory() { memory::account(-bytes_); }
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

 private:
  std::int64_t bytes_;
};

struct Place {
  int x, y;
};

struct Holes {
  std::vector<Place> nodes;
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Holes holes_of(const Field& heights) {
  Holes holes;
  for (int j = 0; j < heights.ny(); ++j)
    for (int i = 0; i < heights.nx(); ++i) {
      const double h = heights(i, j);
      if (std::isnan(h)) {
        holes.nodes.push_back({i, j});
      } else {
        holes.low = std::min(holes.low, h);
        holes.high = std::max(holes.high, h);
      }
    }
  return holes;
}

// Couplings along x and y; weaker ones would vanish in rounding.
struct Couplings {
  Couplings(double hx, double hy) {
    constexpr double weakest = 1e-12;
    (hx > hy ? x : y) = std::max(hx > hy ? (hy / hx) * (hy / hx) : (hx / hy) * (hx / hy), weakest);
  }
  double x = 1, y = 1;
};

struct Equations {
  Matrix a;
  Vector right;
};

// Heights from the lowest, in units of their range, against overflow.
Equations laplacian_of(const Field& heights, const Holes& holes, const Couplings& couplings) {
  const auto n = static_cast<Eigen::Index>(holes.nodes.size());
  const double span = holes.high - holes.low;
  std::vector<std::int32_t> numbers(heights.size());
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(j) * heights.nx() + i; };
  for (std::size_t k = 0; k < holes.nodes.size(); ++k)
    numbers[at(holes.nodes[k].x, holes.nodes[k].y)] = static_cast<std::int32_t>(k);
  Equations equations{Matrix(n, n), Vector::Zero(n)};
  equations.a.reserve(Eigen::VectorXi::Constant(n, 5));
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto [i, j] = holes.nodes[static_cast<std::size_t>(k)];
    double diagonal = 0;
    for (const auto& [step_x, step_y] : {Place{0, -1}, Place{-1, 0}, Place{1, 0}, Place{0, 1}}) {
      const int p = i + step_x, q = j + step_y;
      if (p < 0 || p >= heights.nx() || q < 0 || q >= heights.ny()) continue;
      const double coupling = step_x != 0 ? couplings.x : couplings.y, height = heights(p, q);
      diagonal += coupling;
      if (std::isnan(height))
        equations.a.insert(k, numbers[at(p, q)]) = -coupling;
      else
        equations.right[k] += coupling * ((height - holes.low) / span);
    }
    equations.a.insert(k, k) = diagonal;
  }
  equations.a.makeCompressed();
  return equations;
}

// Blocks are as long in a direction as nodes are coupled in it.
Matrix block_sums(const Field& heights, const Holes& holes, const Couplings& couplings) {
  constexpr double most_blocks = 60'000;
  const double area = std::max(1.0, static_cast<double>(holes.nodes.size()) / most_blocks);
  const double longest = std::min(static_cast<double>(heights.nx()), area);
  const double along_x = std::clamp(std::sqrt(area * std::sqrt(couplings.x / couplings.y)), 1.0, longest);
  const int wide = static_cast<int>(std::ceil(along_x));
  const int high = std::min(heights.ny(), static_cast<int>(std::ceil(area / along_x)));
  const int columns = (heights.nx() + wide - 1) / wide, rows = (heights.ny() + high - 1) / high;
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(columns) * rows, -1);
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  std::int32_t blocks = 0, node = 0;
  for (const auto& [x, y] : holes.nodes) {
    std::int32_t& number = numbers[static_cast<std::size_t>(y / high) * columns + x / wide];
    if (number < 0) number = blocks++;
    entries.emplace_back(number, node++, 1.0);
  }
  Matrix sums(blocks, node);
  sums.setFromTriplets(entries.begin(), entries.end());
  return sums;
}

// With the interface of Eigen's preconditioners.
class TwoLevels {
 public:
  void prepare(const Matrix& a, Matrix sums, Task& task) {
    a_ = &a;
    task_ = &task;
    sums_ = std::move(sums);
    coarse_.compute(sums_ * a * sums_.transpose());
  }
  template <class Operator>
  void compute(const Operator&) {}
  static Eigen::ComputationInfo info() { return Eigen::Success; }

  Vector solve(const Vector& right) const {
    report(right.lpNorm<Eigen::Infinity>());
    Vector value = a_->triangularView<Eigen::Lower>().solve(right);
    value += sums_.transpose() * coarse_.solve(sums_ * (right - *a_ * value));
    value += a_->triangularView<Eigen::Upper>().solve(right - *a_ * value);
    return value;
  }

 private:
  void report(double residual) const {
    stop_flag().check();
    if (first_ == 0) first_ = residual;
    const double decades =
        elementary::log(std::max(residual, enough * first_) / first_) / elementary::log(enough);
    const auto now = static_cast<std::int64_t>(static_cast<double>(parts_of_task) * decades);
    if (now <= reported_) return;
    task_->advance(now - reported_);
    reported_ = now;
  }

  const Matrix* a_ = nullptr;
  Task* task_ = nullptr;
  Matrix sums_;
  Cholesky coarse_;
  mutable double first_ = 0;
  mutable std::int64_t reported_ = 0;
};

}  // namespace

int fill_harmonic(Field& heights, double hx, double hy, Monitor& monitor) {
  const Holes holes = holes_of(heights);
  if (holes.nodes.empty()) return 0;
  if (holes.nodes.size() == heights.size())
    refuse("every height is missing, so there is nothing to interpolate between");
  const double low = holes.low, high = holes.high, span = high - low;
  if (low == high) {
    for (double& h : heights.values()) h = low;
    return 0;
  }
  if (!std::isfinite(span))
    refuse("the heights run from " + format_short(low) + " m to " + format_short(high) +
               " m, too far apart to interpolate between",
           "mark missing points with nan, and check the unit");
  const CountedMemory counted(holes.nodes.size(), heights.size());
  Task task(monitor, "filling missing points", parts_of_task);
  stop_flag().check();
  const Couplings couplings(hx, hy);
  const Equations equations = laplacian_of(heights, holes, couplings);
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, TwoLevels> solver;
  solver.preconditioner().prepare(equations.a, block_sums(heights, holes, couplings), task);
  solver.setTolerance(enough).setMaxIterations(most_steps).compute(equations.a);
  const Vector value = solver.solve(equations.right);
  if (solver.info() != Eigen::Success)
    throw Error(ErrorCode::not_converged, "the holes of the map could not be filled from their neighbours",
                "give `fill` a height instead");
  for (std::size_t k = 0; k < holes.nodes.size(); ++k)
    heights(holes.nodes[k].x, holes.nodes[k].y) =
        std::clamp(low + span * value[static_cast<Eigen::Index>(k)], low, high);
  return static_cast<int>(solver.iterations()) + 1;
}

}  // namespace asperity
