// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double snap = 1e-9;  // rad, to a whole number of quarter turns

// The field turned counter-clockwise by `angle` about the centre of its nodes, bilinear; `outside` where
// no node of the original lies around.
Field turned_field(const Field& field, const Grid& grid, double angle, double outside) {
  Field result(grid.nx, grid.ny);
  double c = elementary::cos(angle), s = elementary::sin(angle);
  const double middle_i = 0.5 * (grid.nx - 1), middle_j = 0.5 * (grid.ny - 1);
  double hx = grid.hx(), hy = grid.hy();
  // A quarter turn of square cells brings nodes onto nodes, or between them by half a cell: without rounding.
  if (std::abs(std::abs(angle) - quarter) <= snap && std::abs(hx - hy) <= 1e-12 * hx) {
    c = 0;
    s = angle > 0 ? 1 : -1;
    hx = hy = 1;
  }
  // The cell a place lies in and how far along; a place past the rim by rounding is on the rim.
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
