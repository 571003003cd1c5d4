// SPDX-License-Identifier: GPL-3.0-or-later
// The five-point Laplacian on the missing nodes only, scaled by its diagonal. The system is
// symmetric and positive definite because every hole of a connected grid touches a measured node.
#include "engine/surface/io/holes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/core/error.hpp"

namespace asperity {

namespace {

struct Hole {
  std::size_t node = 0;
  std::array<std::int64_t, 4> neighbours{-1, -1, -1, -1};  // holes left, right, below, above
  double diagonal = 0;                                     // of the Laplacian
  double known = 0;                                        // weighted sum of measured neighbours
};

double product(const Array<double>& a, const Array<double>& b, Array<double>& work) {
  for (std::size_t k = 0; k < a.size(); ++k) work[k] = a[k] * b[k];
  return block_sum(work);
}

}  // namespace

void fill_harmonic(Field& heights, double hx, double hy, Monitor& monitor) {
  const int nx = heights.nx(), ny = heights.ny();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::size_t missing = 0;
  for (const double h : heights.values()) {
    if (std::isnan(h)) {
      ++missing;
    } else {
      low = std::min(low, h);
      high = std::max(high, h);
    }
  }
  if (missing == 0) return;
  if (missing == heights.size())
    throw Error(ErrorCode::bad_value, "every height is missing, so there is nothing to interpolate between");
  if (low == high) {
    for (double& h : heights.values()) h = low;
    return;
  }

  // Heights relative to the range, so that products neither overflow nor underflow.
  const double span = high - low;
  const double wx = hx > hy ? (hy / hx) * (hy / hx) : 1.0, wy = hx > hy ? 1.0 : (hx / hy) * (hx / hy);
  Array<std::int64_t> number(heights.size(), -1);
  Array<Hole> holes;
  holes.reserve(missing);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!std::isnan(heights[k])) continue;
    number[k] = std::ssize(holes);
    holes.push_back({.node = k});
  }
  for (Hole& hole : holes) {
    const int i = static_cast<int>(hole.node % static_cast<std::size_t>(nx));
    const int j = static_cast<int>(hole.node / static_cast<std::size_t>(nx));
    const std::array<std::array<int, 2>, 4> around{{{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}};
    for (std::size_t side = 0; side < 4; ++side) {
      const auto [a, b] = around[side];
      if (a < 0 || a >= nx || b < 0 || b >= ny) continue;
      const double weight = side < 2 ? wx : wy;
      const std::size_t node =
          static_cast<std::size_t>(b) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(a);
      hole.diagonal += weight;
      if (number[node] >= 0) {
        hole.neighbours[side] = number[node];
      } else {
        hole.known += weight * ((heights[node] - low) / span);
      }
    }
  }

  const std::size_t n = holes.size();
  Array<double> value(n, 0.5), residual(n), direction(n), scaled(n), image(n), work(n);
  const auto laplacian = [&](const Array<double>& u, Array<double>& result) {
    for (std::size_t k = 0; k < n; ++k) {
      double sum = holes[k].diagonal * u[k];
      for (std::size_t side = 0; side < 4; ++side)
        if (holes[k].neighbours[side] >= 0)
          sum -= (side < 2 ? wx : wy) * u[static_cast<std::size_t>(holes[k].neighbours[side])];
      result[k] = sum;
    }
  };
  laplacian(value, image);
  for (std::size_t k = 0; k < n; ++k) {
    residual[k] = holes[k].known - image[k];
    scaled[k] = residual[k] / holes[k].diagonal;
    direction[k] = scaled[k];
  }
  double descent = product(residual, scaled, work);
  // With the diagonal scaled out, the mean square of `scaled` is in units of the height range.
  // Below 1e-30 there is only rounding.
  const double enough = std::max(1e-24 * std::min(wx, wy), 1e-30) * static_cast<double>(n);
  const auto most = static_cast<std::int64_t>(10 * n + 100);
  Task task(monitor, "filling holes", most);
  for (std::int64_t turn = 0; descent > enough; ++turn) {
    if (turn == most)
      throw Error(ErrorCode::not_converged, "the holes of the map could not be filled from their neighbours",
                  "give `fill` a height instead");
    task.advance();
    laplacian(direction, image);
    const double step = descent / product(direction, image, work);
    for (std::size_t k = 0; k < n; ++k) {
      value[k] += step * direction[k];
      residual[k] -= step * image[k];
      scaled[k] = residual[k] / holes[k].diagonal;
    }
    const double next = product(residual, scaled, work);
    const double turnback = next / descent;
    for (std::size_t k = 0; k < n; ++k) direction[k] = scaled[k] + turnback * direction[k];
    descent = next;
  }
  for (std::size_t k = 0; k < n; ++k) heights[holes[k].node] = std::clamp(low + span * value[k], low, high);
}

}  // namespace asperity
