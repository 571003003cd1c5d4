// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/scale_dependence.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/require.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace {

struct Stencils {
  double squares = 0, count = 0, least = std::numeric_limits<double>::infinity();
  void add(double value) {
    if (std::isnan(value)) return;
    squares += value * value;
    count += 1;
    least = std::min(least, value);
  }
};

// Over rows for both axes: reads memory in order.
Stencils over_map(const Surface& surface, ScaleQuantity quantity, ScaleAxis axis, int cells) {
  const Field& z = surface.measured_heights();
  const Grid& grid = surface.grid();
  const bool wrap = surface.traits().periodic, slope = quantity == ScaleQuantity::slope;
  const bool along_x = axis == ScaleAxis::x;
  const double l = cells * (along_x ? grid.hx() : grid.hy());
  const int reach = along_x ? cells : 0, rise = along_x ? 0 : cells;
  const auto one = [&](double behind, double here, double ahead) {
    return slope ? (ahead - here) / l : ((ahead - here) - (here - behind)) / l / l;
  };
  const int first_i = wrap || slope ? 0 : reach, last_i = wrap ? grid.nx : grid.nx - reach;
  const int first_j = wrap || slope ? 0 : rise, last_j = wrap ? grid.ny : grid.ny - rise;
  if (first_i >= last_i || first_j >= last_j) return {};
  const auto rows = static_cast<std::size_t>(last_j - first_j);
  Array<double> squares(rows), count(rows), least(rows);
  for_each_row(last_j - first_j, [&](int k) {
    const auto row = [&](int step) { return z.row(wrapped_index(first_j + k + step, grid.ny)); };
    const std::span<const double> here = row(0), ahead = row(rise), behind = row(-rise);
    Stencils sums;
    for (int i = first_i; i < last_i; ++i) {
      const auto at = [&](int step) { return static_cast<std::size_t>(wrapped_index(i + step, grid.nx)); };
      sums.add(one(slope ? 0 : behind[at(-reach)], here[at(0)], ahead[at(reach)]));
    }
    const auto at = static_cast<std::size_t>(k);
    squares[at] = sums.squares;
    count[at] = sums.count;
    least[at] = sums.least;
  });
  return {block_sum(squares), block_sum(count), *std::min_element(least.begin(), least.end())};
}

// Residuals of a block's least-squares plane.
void add_residuals(const Field& z, int i0, int i1, int j0, int j1, double& squares, double& count) {
  double n = 0, x = 0, y = 0, h = 0;
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i)
      if (const double v = z(i, j); !std::isnan(v)) n += 1, x += i, y += j, h += v;
  if (n < 4) return;
  x /= n, y /= n, h /= n;
  double xx = 0, xy = 0, yy = 0, xh = 0, yh = 0;
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i)
      if (const double v = z(i, j); !std::isnan(v)) {
        xx += (i - x) * (i - x), xy += (i - x) * (j - y), yy += (j - y) * (j - y);
        xh += (i - x) * (v - h), yh += (j - y) * (v - h);
      }
  // Collinear samples: no slope across.
  const double determinant = xx * yy - xy * xy;
  double p = 0, q = 0;
  if (determinant > 1e-12 * xx * yy) {
    p = (xh * yy - yh * xy) / determinant, q = (yh * xx - xh * xy) / determinant;
  } else if (xx + yy > 0) {
    const double along = (xh * xx + yh * xy + xh * xy + yh * yy) != 0 && xx > 0 ? xh / xx : 0;
    if (xx >= yy)
      p = along;
    else
      q = yh / yy;
  }
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i)
      if (const double v = z(i, j); !std::isnan(v)) {
        const double rest = (v - h) - p * (i - x) - q * (j - y);
        squares += rest * rest;
        count += 1;
      }
}

}  // namespace

ScaleDependence scale_dependence(const Surface& surface, ScaleQuantity quantity, ScaleAxis axis,
                                 const std::vector<int>& cells) {
  const Grid& grid = surface.grid();
  const int along = axis == ScaleAxis::x ? grid.nx : grid.ny;
  const double h = axis == ScaleAxis::x ? grid.hx() : grid.hy();
  ScaleDependence result;
  for (const int l : cells) {
    if (quantity == ScaleQuantity::height) {
      result.value.push_back(height_in_blocks(surface, l));
      result.distance.push_back(h * along / l);
      continue;
    }
    const int stencil = quantity == ScaleQuantity::slope ? l : 2 * l;
    require(l >= 1 && stencil < along, "cells", l, "",
            "give numbers of cells whose stencil fits into the map");
    const Stencils sums = over_map(surface, quantity, axis, l);
    result.distance.push_back(stencil * h);
    result.value.push_back(sums.count > 0 ? std::sqrt(sums.squares / sums.count) : NAN);
    if (quantity == ScaleQuantity::curvature) result.least.push_back(sums.count > 0 ? sums.least : NAN);
  }
  return result;
}

double height_in_blocks(const Surface& surface, int blocks) {
  const Grid& grid = surface.grid();
  require(blocks >= 1 && blocks <= std::min(grid.nx, grid.ny), "blocks", blocks, "",
          "give a number of blocks a side, from 1 to the cells");
  const Field& z = surface.measured_heights();
  // Node i is in block i·s/n: block b starts at the smallest i with i·s >= b·n.
  const auto begin = [blocks](int b, int n) {
    return static_cast<int>((static_cast<std::int64_t>(b) * n + blocks - 1) / blocks);
  };
  Array<double> squares(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks)),
      count(squares.size());
  parallel_for(blocks, [&](std::int64_t b) {
    for (int a = 0; a < blocks; ++a) {
      const auto k =
          static_cast<std::size_t>(b) * static_cast<std::size_t>(blocks) + static_cast<std::size_t>(a);
      const int row = static_cast<int>(b);
      add_residuals(z, begin(a, grid.nx), begin(a + 1, grid.nx), begin(row, grid.ny), begin(row + 1, grid.ny),
                    squares[k], count[k]);
    }
  });
  const double samples = block_sum(count);
  return samples > 0 ? std::sqrt(block_sum(squares) / samples) : NAN;
}

double tip_cut_off(const Surface& surface, ScaleAxis axis, double radius, double share) {
  require_positive("radius", radius, "m");
  require_positive("share", share);
  const Grid& grid = surface.grid();
  const int longest = (axis == ScaleAxis::x ? grid.nx : grid.ny) / 4;
  const double h = axis == ScaleAxis::x ? grid.hx() : grid.hy();
  for (int l = longest; l >= 1; --l) {
    const Stencils sums = over_map(surface, ScaleQuantity::curvature, axis, l);
    if (sums.count > 0 && -sums.least > share / radius) return 2 * std::min(l + 1, longest) * h;
  }
  return 0;
}

}  // namespace asperity
