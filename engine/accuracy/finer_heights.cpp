// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/accuracy/finer_heights.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/operations/resampling.hpp"

namespace asperity {

namespace {

using LatticeNode = LatticeIsometry::Node;

// Bilinear; `outside` beyond the last node.
double between(const Field& field, double x, double y, int last_x, int last_y, double outside) {
  constexpr double slack = 1e-9;
  if (!(x >= -slack && x <= last_x + slack && y >= -slack && y <= last_y + slack)) return outside;
  const auto low = [](double at, int n) { return std::clamp(static_cast<int>(at), 0, std::max(0, n - 2)); };
  const int i = low(x, field.nx()), j = low(y, field.ny());
  const double u = std::max(x, 0.0) - i, v = std::max(y, 0.0) - j;
  const int right = std::min(i + 1, field.nx() - 1), above = std::min(j + 1, field.ny() - 1);
  return (1 - v) * ((1 - u) * field(i, j) + u * field(right, j)) +
         v * ((1 - u) * field(i, above) + u * field(right, above));
}

// About the middle of the contact nodes (every third node); NaN outside the body.
Field turned_about(const Field& field, const Grid& given, const Grid& fine, double angle) {
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  const int last_x = (given.nx - 1) * (fine.nx / given.nx), last_y = (given.ny - 1) * (fine.ny / given.ny);
  const double hx = fine.hx(), hy = fine.hy(), middle_x = 0.5 * last_x, middle_y = 0.5 * last_y;
  Field result(fine.nx, fine.ny);
  parallel_for(fine.ny, [&](std::int64_t row) {
    const double y = (static_cast<double>(row) - middle_y) * hy;
    for (int i = 0; i < fine.nx; ++i) {
      const double x = (i - middle_x) * hx;
      result(i, static_cast<int>(row)) =
          between(field, (c * x + s * y) / hx + middle_x, (c * y - s * x) / hy + middle_y, last_x, last_y,
                  std::numeric_limits<double>::quiet_NaN());
    }
  });
  return result;
}

// Adds off-lattice flattening, which only `geometry` stores unmapped.
void add_what_mapping_lost(const Scene& scene, const ContactGeometry& geometry, const Grid& fine, Field& h) {
  const Grid& given = geometry.grid();
  const ContactGeometry mapped(scene, geometry.pose());
  Field lost = geometry.combined();
  for (std::size_t k = 0; k < lost.size(); ++k) {
    const double height = mapped.combined()[k];
    lost[k] = std::isnan(height) ? 0.0 : lost[k] - height;
  }
  const double step_x = static_cast<double>(given.nx) / fine.nx,
               step_y = static_cast<double>(given.ny) / fine.ny;
  for (int j = 0; j < fine.ny; ++j)
    for (int i = 0; i < fine.nx; ++i)
      h(i, j) += between(lost, std::min(i * step_x, given.nx - 1.0), std::min(j * step_y, given.ny - 1.0),
                         given.nx - 1, given.ny - 1, 0.0);
}

}  // namespace

Field over_lower(const Field& upper, const LatticeIsometry& lattice, Boundary boundary) {
  const int nx = upper.nx(), ny = upper.ny();
  const int factor_x = nx / lattice.nx(), factor_y = ny / lattice.ny();
  // Affine in the nodes without shift.
  const LatticeIsometry turned = LatticeIsometry(lattice.nx(), lattice.ny()).turned(lattice.quarters());
  const LatticeNode origin = turned.to_upper(LatticeNode{0, 0});
  const auto step = [&](LatticeNode over) {
    const LatticeNode to = turned.to_upper(over);
    return LatticeNode{to.i - origin.i, to.j - origin.j};
  };
  const LatticeNode along_x = lattice.nx() > 1 ? step({1, 0}) : LatticeNode{1, 0};
  const LatticeNode along_y = lattice.ny() > 1 ? step({0, 1}) : LatticeNode{0, 1};
  const int shift_x = factor_x * lattice.shift_x(), shift_y = factor_y * lattice.shift_y();
  const auto on_grid = [&](int k, int n) {
    return boundary == Boundary::periodic ? (k % n + n) % n : std::clamp(k, 0, n - 1);
  };
  Field seen(nx, ny);
  parallel_for(ny, [&](std::int64_t row) {
    const int j = static_cast<int>(row) - shift_y;
    for (int column = 0; column < nx; ++column) {
      const int i = column - shift_x;
      const int own_i = factor_x * origin.i + along_x.i * i + along_y.i * j;
      const int own_j = factor_y * origin.j + along_x.j * i + along_y.j * j;
      seen(column, static_cast<int>(row)) = upper(on_grid(own_i, nx), on_grid(own_j, ny));
    }
  });
  return seen;
}

Grid finer_grid(const Grid& grid) {
  const std::string asked = "`estimate` = \"finer\" is given for a tile of " + std::to_string(grid.nx) +
                            " x " + std::to_string(grid.ny) + " cells";
  if (std::max(grid.nx, grid.ny) < 2) refuse(asked, "give at least 2 along x or y");
  if (std::max(grid.nx, grid.ny) > max_cells / times_finer)
    refuse(asked, "it needs " + std::to_string(times_finer) +
                      " times the cells a side, and a tile has at most " + std::to_string(max_cells) +
                      ": estimate=true compares with coarser ones");
  const auto times = [](int cells) { return cells > 1 ? times_finer * cells : cells; };
  return {times(grid.nx), times(grid.ny), grid.size_x, grid.size_y};
}

Field finer_heights(const Scene& scene, const ContactGeometry& geometry, Monitor& monitor) {
  const Grid& given = geometry.grid();
  const Grid fine = finer_grid(given);
  Field h = at_cells(scene.lower, fine.nx, fine.ny, monitor).surface.heights();
  const auto* upper = std::get_if<Surface>(&scene.upper);
  if (upper == nullptr) return h;
  const Pose& pose = geometry.pose();
  Field seen = over_lower(at_cells(*upper, fine.nx, fine.ny, monitor).surface.heights(), pose.lattice(),
                          geometry.boundary());
  if (!pose.on_lattice()) seen = turned_about(seen, given, fine, pose.rest());
  for (std::size_t k = 0; k < h.size(); ++k) h[k] += seen[k];
  if (pose.on_lattice()) return h;
  if (scene.effects.any_that(Effect::Acts::bounds_pressure)) add_what_mapping_lost(scene, geometry, fine, h);
  return h;
}

}  // namespace asperity
