// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {
int modulo(long long value, int n) {
  const long long rest = value % n;
  return static_cast<int>(rest < 0 ? rest + n : rest);
}

// `place`: node of `from` at a node of the result.
template <class Place>
Field moved(const Field& from, Place place) {
  Field result(from.nx(), from.ny());
  parallel_for(result.ny(), [&](std::int64_t row) {
    const auto j = static_cast<int>(row);
    for (int i = 0; i < result.nx(); ++i) {
      const LatticeIsometry::Node node = place(LatticeIsometry::Node{i, j});
      result(i, j) = from(node.i, node.j);
    }
  });
  return result;
}

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double snap = 1e-9;  // rad, to a whole number of quarter turns

// Counter-clockwise about the centre of the nodes, bilinear; elsewhere `outside`.
Field turned_field(const Field& field, const Grid& grid, double angle, double outside) {
  Field result(grid.nx, grid.ny);
  double c = elementary::cos(angle), s = elementary::sin(angle);
  const double middle_i = 0.5 * (grid.nx - 1), middle_j = 0.5 * (grid.ny - 1);
  double hx = grid.hx(), hy = grid.hy();
  // Quarter turns of square cells map nodes to nodes or half-way between: no rounding.
  if (std::abs(std::abs(angle) - quarter) <= snap && std::abs(hx - hy) <= 1e-12 * hx) {
    c = 0;
    s = angle > 0 ? 1 : -1;
    hx = hy = 1;
  }
  // Cell and fraction; a place past the rim by rounding is on the rim.
  struct Place {
    int low, high;
    double part;
    bool inside;
  };
  const auto place = [](double index, int n) {
    constexpr double slack = 1e-9;
    if (!(index >= -slack && index <= n - 1 + slack)) return Place{0, 0, 0, false};
    const double clamped = std::clamp(index, 0.0, static_cast<double>(n - 1));
    const int low = std::min(static_cast<int>(clamped), std::max(0, n - 2));
    return Place{low, std::min(low + 1, n - 1), clamped - low, true};
  };
  parallel_for(grid.ny, [&](std::int64_t row) {
    const auto j = static_cast<int>(row);
    const double y = (j - middle_j) * hy;
    for (int i = 0; i < grid.nx; ++i) {
      const double x = (i - middle_i) * hx;
      const Place u = place((c * x + s * y) / hx + middle_i, grid.nx);
      const Place v = place((c * y - s * x) / hy + middle_j, grid.ny);
      if (!u.inside || !v.inside) {
        result(i, j) = outside;
        continue;
      }
      const double below = (1 - u.part) * field(u.low, v.low) + u.part * field(u.high, v.low);
      const double above = (1 - u.part) * field(u.low, v.high) + u.part * field(u.high, v.high);
      result(i, j) = (1 - v.part) * below + v.part * above;
    }
  });
  return result;
}

}  // namespace

LatticeIsometry::LatticeIsometry(int nx, int ny) : nx_(nx), ny_(ny) {}

LatticeIsometry::Node LatticeIsometry::turn(Node node, int quarters) const {
  if (quarters == 1) return {ny_ - 1 - node.j, node.i};
  if (quarters == 2) return {nx_ - 1 - node.i, ny_ - 1 - node.j};
  if (quarters == 3) return {node.j, nx_ - 1 - node.i};
  return node;
}

LatticeIsometry LatticeIsometry::turned(int quarters) const {
  const int turns = modulo(quarters, 4);
  if (turns % 2 != 0 && nx_ != ny_)
    refuse("a turn by " + std::to_string(turns * 90) + " deg does not fit a grid of " + std::to_string(nx_) +
               " x " + std::to_string(ny_) + " cells",
           "turn it by 180 deg, or use a square tile");
  LatticeIsometry result = *this;
  result.quarters_ = modulo(quarters_ + turns, 4);
  // turn ∘ shift(s) = shift(R s) ∘ turn
  int x = shift_x_, y = shift_y_;
  for (int turn = 0; turn < turns; ++turn) x = -std::exchange(y, x);
  result.shift_x_ = modulo(x, nx_);
  result.shift_y_ = modulo(y, ny_);
  return result;
}

LatticeIsometry LatticeIsometry::shifted(int cells_x, int cells_y) const {
  LatticeIsometry result = *this;
  result.shift_x_ = modulo(static_cast<long long>(shift_x_) + cells_x, nx_);
  result.shift_y_ = modulo(static_cast<long long>(shift_y_) + cells_y, ny_);
  return result;
}

LatticeIsometry::Node LatticeIsometry::to_lower(Node own) const {
  const Node turned = turn({nx_ - 1 - own.i, own.j}, quarters_);
  return {modulo(static_cast<long long>(turned.i) + shift_x_, nx_),
          modulo(static_cast<long long>(turned.j) + shift_y_, ny_)};
}

LatticeIsometry::Node LatticeIsometry::to_upper(Node lower) const {
  const Node back = turn({modulo(static_cast<long long>(lower.i) - shift_x_, nx_),
                          modulo(static_cast<long long>(lower.j) - shift_y_, ny_)},
                         (4 - quarters_) % 4);
  return {nx_ - 1 - back.i, back.j};
}

Field LatticeIsometry::to_lower(const Field& own) const {
  return moved(own, [this](Node node) { return to_upper(node); });
}

Field LatticeIsometry::to_upper(const Field& lower) const {
  return moved(lower, [this](Node node) { return to_lower(node); });
}

Pose::Pose(const LatticeIsometry& lattice)
    : lattice_(lattice), angle_(std::remainder(lattice.quarters() * quarter, 4 * quarter)) {}

Pose Pose::turned(double angle, const Grid& grid) const {
  Pose result = *this;
  result.angle_ = std::remainder(angle_ + angle, 4 * quarter);
  const bool square = grid.nx == grid.ny && grid.size_x == grid.size_y;
  const double unit = square ? quarter : 2 * quarter;
  const double whole = std::round(result.angle_ / unit);
  const int quarters = static_cast<int>(whole) * (square ? 1 : 2);
  result.lattice_ = lattice_.turned(quarters - lattice_.quarters());
  result.rest_ = result.angle_ - whole * unit;
  if (std::abs(result.rest_) <= snap) result.rest_ = 0;
  return result;
}

Field Pose::to_lower(const Field& own, const Grid& grid) const {
  Field on_lattice_nodes = lattice_.to_lower(own);
  if (on_lattice()) return on_lattice_nodes;
  return turned_field(on_lattice_nodes, grid, rest_, std::numeric_limits<double>::quiet_NaN());
}

Field Pose::to_upper(const Field& lower, const Grid& grid) const {
  if (on_lattice()) return lattice_.to_upper(lower);
  return lattice_.to_upper(turned_field(lower, grid, -rest_, 0.0));
}

}  // namespace asperity
