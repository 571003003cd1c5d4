// SPDX-License-Identifier: GPL-3.0-or-later
// Five-point Laplacian on the missing nodes; symmetric positive definite because every hole touches a
// measured node. Conjugate gradients with one multigrid V-cycle as preconditioner: every second node,
// bilinear interpolation with zero on measured nodes, Galerkin coarse operators, one Gauss-Seidel sweep
// down and its mirror up (Trottenberg, Oosterlee & Schueller, Multigrid, 2001, ch. 2 and 7). On elongated
// cells, only the direction of stronger coupling is coarsened.
#include "engine/surface/operations/holes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// 32 bits suffice for at most 65536^2 nodes, at least one measured.
using Index = std::uint32_t;

// Missing nodes, row by row. Absent neighbours have the index size(); vectors hold zero there.
struct Nodes {
  int nx = 0, ny = 0;
  Array<std::int32_t> x, y;
  Array<std::size_t> row;  // first nodes, and the end

  std::size_t size() const { return x.size(); }
  void close_rows() {
    row.assign(static_cast<std::size_t>(ny) + 1, 0);
    for (const std::int32_t j : y) ++row[static_cast<std::size_t>(j) + 1];
    for (std::size_t j = 1; j < row.size(); ++j) row[j] += row[j - 1];
  }
};

// Fast for calls from left to right.
class Cursor {
 public:
  void enter(const Nodes& nodes, int j) {
    nodes_ = &nodes;
    const bool inside = j >= 0 && j < nodes.ny;
    begin_ = at_ = inside ? nodes.row[static_cast<std::size_t>(j)] : 0;
    end_ = inside ? nodes.row[static_cast<std::size_t>(j) + 1] : 0;
  }
  Index find(int i) {
    while (at_ > begin_ && nodes_->x[at_ - 1] >= i) --at_;
    while (at_ < end_ && nodes_->x[at_] < i) ++at_;
    return static_cast<Index>(at_ < end_ && nodes_->x[at_] == i ? at_ : nodes_->size());
  }

 private:
  const Nodes* nodes_ = nullptr;
  std::size_t begin_ = 0, end_ = 0, at_ = 0;
};

// Offset of neighbour k: (k % 3 - 1, k / 3 - 1).
constexpr std::size_t centre = 4;

struct FivePoints {
  static constexpr std::array<std::size_t, 4> places{1, 3, 5, 7};
  double wx = 1, wy = 1;
  Array<std::array<Index, 4>> neighbours;
  Array<double> diagonal, inverse;

  double pull(std::size_t k, const Array<double>& u) const {
    const auto& n = neighbours[k];
    return wy * (u[n[0]] + u[n[3]]) + wx * (u[n[1]] + u[n[2]]);
  }
  double coupling(std::size_t, std::size_t side) const { return side == 1 || side == 2 ? wx : wy; }
};

struct NinePoints {
  static constexpr std::array<std::size_t, 8> places{0, 1, 2, 3, 5, 6, 7, 8};
  Array<std::array<Index, 8>> neighbours;
  Array<std::array<double, 8>> couplings;
  Array<double> diagonal, inverse;

  double pull(std::size_t k, const Array<double>& u) const {
    double sum = 0;
    for (std::size_t side = 0; side < 8; ++side) sum += couplings[k][side] * u[neighbours[k][side]];
    return sum;
  }
  double coupling(std::size_t k, std::size_t side) const { return couplings[k][side]; }
};

template <class Operator>
void link(const Nodes& nodes, Operator& a) {
  std::array<Cursor, 3> rows;
  a.neighbours.resize(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int i = nodes.x[k], j = nodes.y[k];
    if (k == 0 || nodes.y[k - 1] != j)
      for (int step = 0; step < 3; ++step) rows[static_cast<std::size_t>(step)].enter(nodes, j + step - 1);
    for (std::size_t side = 0; side < Operator::places.size(); ++side) {
      const std::size_t place = Operator::places[side];
      a.neighbours[k][side] = rows[place / 3].find(i + static_cast<int>(place % 3) - 1);
    }
  }
}

template <class Operator>
void sweep_forward(const Operator& a, Array<double>& u, const Array<double>& b) {
  stop_flag().check();
  for (std::size_t k = 0; k < a.neighbours.size(); ++k) u[k] = (b[k] + a.pull(k, u)) * a.inverse[k];
}

template <class Operator>
void sweep_back(const Operator& a, Array<double>& u, const Array<double>& b) {
  stop_flag().check();
  for (std::size_t k = a.neighbours.size(); k-- > 0;) u[k] = (b[k] + a.pull(k, u)) * a.inverse[k];
}

// Coarse nodes for interpolation. At the rim, a single parent gets full weight: zero slope.
struct Parents {
  bool halve_x = false, halve_y = false;
  Array<std::array<Index, 4>> of;
  Array<float> weight;  // of each parent: 1, 1/2 or 1/4
};

struct Level {
  Nodes nodes;
  NinePoints a;
  Parents parents;
  Array<double> u, b;
};

Nodes coarse_nodes(const Nodes& fine, bool halve_x, bool halve_y) {
  Nodes coarse;
  coarse.nx = halve_x ? (fine.nx + 1) / 2 : fine.nx;
  coarse.ny = halve_y ? (fine.ny + 1) / 2 : fine.ny;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    if ((halve_x && fine.x[k] % 2 != 0) || (halve_y && fine.y[k] % 2 != 0)) continue;
    coarse.x.push_back(halve_x ? fine.x[k] / 2 : fine.x[k]);
    coarse.y.push_back(halve_y ? fine.y[k] / 2 : fine.y[k]);
  }
  coarse.close_rows();
  return coarse;
}

Parents parents_of(const Nodes& fine, const Nodes& coarse, bool halve_x, bool halve_y) {
  Parents parents{halve_x, halve_y, {}, {}};
  parents.of.resize(fine.size());
  parents.weight.resize(fine.size());
  const auto absent = static_cast<Index>(coarse.size());
  std::array<Cursor, 2> rows;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    const int i = fine.x[k], j = fine.y[k];
    const int left = halve_x ? i / 2 : i, low = halve_y ? j / 2 : j;
    const bool two_x = halve_x && i % 2 != 0 && left + 1 < coarse.nx;
    const bool two_y = halve_y && j % 2 != 0 && low + 1 < coarse.ny;
    if (k == 0 || fine.y[k - 1] != j) {
      rows[0].enter(coarse, low);
      rows[1].enter(coarse, two_y ? low + 1 : -1);
    }
    parents.of[k] = {rows[0].find(left), two_x ? rows[0].find(left + 1) : absent, rows[1].find(left),
                     two_x ? rows[1].find(left + 1) : absent};
    parents.weight[k] = (two_x ? 0.5F : 1.0F) * (two_y ? 0.5F : 1.0F);
  }
  return parents;
}

// Galerkin operator P' A P: nine points again.
template <class Operator>
void project(const Operator& fine, Level& coarse) {
  const Nodes& nodes = coarse.nodes;
  const auto absent = static_cast<Index>(nodes.size());
  Array<std::array<double, 9>> sums(nodes.size(), std::array<double, 9>{});
  const auto add = [&](std::size_t k, std::size_t m, double entry) {
    const double both =
        entry * static_cast<double>(coarse.parents.weight[k]) * static_cast<double>(coarse.parents.weight[m]);
    for (const Index p : coarse.parents.of[k]) {
      if (p == absent) continue;
      for (const Index q : coarse.parents.of[m]) {
        if (q == absent) continue;
        const int place = (nodes.y[q] - nodes.y[p] + 1) * 3 + nodes.x[q] - nodes.x[p] + 1;
        sums[p][static_cast<std::size_t>(place)] += both;
      }
    }
  };
  for (std::size_t k = 0; k < fine.neighbours.size(); ++k) {
    add(k, k, fine.diagonal[k]);
    for (std::size_t side = 0; side < Operator::places.size(); ++side)
      if (const Index m = fine.neighbours[k][side]; m < fine.neighbours.size())
        add(k, m, -fine.coupling(k, side));
  }
  NinePoints& a = coarse.a;
  link(nodes, a);
  a.couplings.resize(nodes.size());
  a.diagonal.resize(nodes.size());
  a.inverse.resize(nodes.size());
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    for (std::size_t side = 0; side < 8; ++side) a.couplings[p][side] = -sums[p][NinePoints::places[side]];
    a.diagonal[p] = sums[p][centre];
    a.inverse[p] = 1 / a.diagonal[p];
  }
}

class Multigrid {
 public:
  Multigrid(const Nodes& nodes, const FivePoints& a) : fine_(a) {
    double wx = a.wx, wy = a.wy;
    const Nodes* below = &nodes;
    while (below->nx > 1 || below->ny > 1) {
      stop_flag().check();
      const bool halve_x = below->nx > 1 && (below->ny == 1 || wx > 0.5 * wy);
      const bool halve_y = below->ny > 1 && (below->nx == 1 || wy > 0.5 * wx);
      auto level = std::make_unique<Level>();
      level->nodes = coarse_nodes(*below, halve_x, halve_y);
      if (level->nodes.size() == 0) break;
      level->parents = parents_of(*below, level->nodes, halve_x, halve_y);
      if (levels_.empty()) {
        project(fine_, *level);
      } else {
        project(levels_.back()->a, *level);
      }
      level->u.assign(level->nodes.size() + 1, 0.0);
      level->b.assign(level->nodes.size() + 1, 0.0);
      if (halve_x) wx /= 4;
      if (halve_y) wy /= 4;
      levels_.push_back(std::move(level));
      below = &levels_.back()->nodes;
    }
  }

  void apply(const Array<double>& b, Array<double>& u) { cycle(fine_, 0, u, b); }

 private:
  template <class Operator>
  void cycle(const Operator& a, std::size_t next, Array<double>& u, const Array<double>& b) {
    std::fill(u.begin(), u.end(), 0.0);
    sweep_forward(a, u, b);
    if (next < levels_.size()) {
      Level& coarse = *levels_[next];
      const Parents& parents = coarse.parents;
      std::fill(coarse.b.begin(), coarse.b.end(), 0.0);
      for (std::size_t k = 0; k < a.neighbours.size(); ++k) {
        const double left =
            static_cast<double>(parents.weight[k]) * (b[k] - a.diagonal[k] * u[k] + a.pull(k, u));
        for (const Index p : parents.of[k]) coarse.b[p] += left;
      }
      coarse.b.back() = 0;
      cycle(coarse.a, next + 1, coarse.u, coarse.b);
      for (std::size_t k = 0; k < a.neighbours.size(); ++k) {
        const auto& p = parents.of[k];
        u[k] += static_cast<double>(parents.weight[k]) *
                ((coarse.u[p[0]] + coarse.u[p[1]]) + (coarse.u[p[2]] + coarse.u[p[3]]));
      }
    }
    sweep_back(a, u, b);
  }

  const FivePoints& fine_;
  std::vector<std::unique_ptr<Level>> levels_;  // from fine to coarse; about thirty at most
};

double product(const Array<double>& a, const Array<double>& b, Array<double>& work) {
  for (std::size_t k = 0; k < a.size(); ++k) work[k] = a[k] * b[k];
  return block_sum(work);
}

double largest(const Array<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// `known` receives sums over measured neighbours; heights relative to `low`, in units of `span`.
FivePoints laplacian_of(const Field& heights, const Nodes& nodes, double hx, double hy, double low,
                        double span, Array<double>& known) {
  // Weaker couplings would vanish in rounding.
  constexpr double weakest = 1e-12;
  FivePoints a;
  a.wx = hx > hy ? std::max((hy / hx) * (hy / hx), weakest) : 1.0;
  a.wy = hx > hy ? 1.0 : std::max((hx / hy) * (hx / hy), weakest);
  link(nodes, a);
  a.diagonal.resize(nodes.size());
  a.inverse.resize(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int i = nodes.x[k], j = nodes.y[k];
    for (std::size_t side = 0; side < 4; ++side) {
      const int place = static_cast<int>(FivePoints::places[side]);
      const int p = i + place % 3 - 1, q = j + place / 3 - 1;
      if (p < 0 || p >= nodes.nx || q < 0 || q >= nodes.ny) continue;
      a.diagonal[k] += a.coupling(k, side);
      if (a.neighbours[k][side] == nodes.size())
        known[k] += a.coupling(k, side) * ((heights(p, q) - low) / span);
    }
    a.inverse[k] = 1 / a.diagonal[k];
  }
  return a;
}

// Nodes without a height, and the range of the others.
Nodes missing_nodes(const Field& heights, Range& measured) {
  Nodes nodes{heights.nx(), heights.ny(), {}, {}, {}};
  measured.min = std::numeric_limits<double>::infinity();
  measured.max = -measured.min;
  for (int j = 0; j < nodes.ny; ++j)
    for (int i = 0; i < nodes.nx; ++i) {
      const double h = heights(i, j);
      if (std::isnan(h)) {
        nodes.x.push_back(i);
        nodes.y.push_back(j);
      } else {
        measured.min = std::min(measured.min, h);
        measured.max = std::max(measured.max, h);
      }
    }
  return nodes;
}

constexpr std::int64_t parts_of_task = 1000;

// Conjugate gradients for a·value = `residual`, which they overwrite. Returns the number of steps.
int solve_laplace(const Nodes& nodes, const FivePoints& a, Array<double>& residual, Array<double>& value,
                  Task& task) {
  const std::size_t n = nodes.size();
  Array<double> direction(n + 1, 0.0), scaled(n + 1, 0.0), image(n + 1, 0.0), work(n + 1, 0.0);
  Multigrid multigrid(nodes, a);
  const auto laplacian = [&](const Array<double>& u) {
    for (std::size_t k = 0; k < n; ++k) image[k] = a.diagonal[k] * u[k] - a.pull(k, u);
  };
  laplacian(value);
  for (std::size_t k = 0; k < n; ++k) residual[k] -= image[k];

  // Approximate error, in units of the height range.
  constexpr double enough = 1e-12;
  constexpr int most = 1000;
  multigrid.apply(residual, scaled);
  direction = scaled;
  double descent = product(residual, scaled, work);
  double error = largest(scaled);
  const double decades = elementary::log(std::max(error, 2 * enough) / enough);
  std::int64_t told = 0;
  int turn = 0;
  for (; error > enough; ++turn) {
    if (turn == most)
      throw Error(ErrorCode::not_converged, "the holes of the map could not be filled from their neighbours",
                  "give `fill` a height instead");
    laplacian(direction);
    const double step = descent / product(direction, image, work);
    for (std::size_t k = 0; k < n; ++k) {
      value[k] += step * direction[k];
      residual[k] -= step * image[k];
    }
    multigrid.apply(residual, scaled);
    error = largest(scaled);
    const double next = product(residual, scaled, work);
    const double turnback = next / descent;
    for (std::size_t k = 0; k < n; ++k) direction[k] = scaled[k] + turnback * direction[k];
    descent = next;
    const double left = error > enough ? elementary::log(error / enough) / decades : 0.0;
    const auto now =
        static_cast<std::int64_t>(static_cast<double>(parts_of_task) * std::clamp(1 - left, 0.0, 1.0));
    task.advance(std::max<std::int64_t>(now - told, 0));
    told = std::max(told, now);
  }
  return turn;
}

}  // namespace

int fill_harmonic(Field& heights, double hx, double hy, Monitor& monitor) {
  Range measured;
  Nodes nodes = missing_nodes(heights, measured);
  const double low = measured.min, high = measured.max;
  const std::size_t n = nodes.size();
  if (n == 0) return 0;
  if (n == heights.size())
    throw Error(ErrorCode::bad_value, "every height is missing, so there is nothing to interpolate between");
  if (low == high) {
    for (double& h : heights.values()) h = low;
    return 0;
  }
  if (!std::isfinite(high - low))
    throw Error(ErrorCode::bad_value,
                "the heights run from " + format_short(low) + " m to " + format_short(high) +
                    " m, too far apart to interpolate between",
                "mark missing points with nan, and check the unit");
  nodes.close_rows();

  Task task(monitor, "filling missing points", parts_of_task);
  // Avoids overflow and underflow in products.
  const double span = high - low;
  Array<double> value(n + 1, 0.5), residual(n + 1, 0.0);
  value[n] = 0;
  const FivePoints a = laplacian_of(heights, nodes, hx, hy, low, span, residual);
  const int steps = solve_laplace(nodes, a, residual, value, task);
  for (std::size_t k = 0; k < n; ++k)
    heights(nodes.x[k], nodes.y[k]) = std::clamp(low + span * value[k], low, high);
  return steps;
}

}  // namespace asperity
