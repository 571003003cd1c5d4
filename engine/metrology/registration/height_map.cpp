// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/registration/height_map.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/metrology/blocked_sums.hpp"

namespace asperity::registration {

namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

// Sums of the plane fit; x and y from -1 to 1.
std::array<double, 9> plane_sums(const Field& z, double middle) {
  const auto nx = static_cast<std::size_t>(z.nx());
  const double half_x = std::max(0.5 * (z.nx() - 1), 0.5), half_y = std::max(0.5 * (z.ny() - 1), 0.5);
  return blocked_sums<9>(z.size(), [&](std::size_t k) -> std::array<double, 9> {
    if (std::isnan(z[k])) return {};
    const double x = (static_cast<double>(k % nx) - 0.5 * (z.nx() - 1)) / half_x;
    const double y = (static_cast<double>(k / nx) - 0.5 * (z.ny() - 1)) / half_y;
    const double v = z[k] - middle;
    return {1, x, y, x * x, x * y, y * y, v, v * x, v * y};
  });
}

std::vector<double> gaussian_weights(double sigma) {
  const int reach = static_cast<int>(std::ceil(4.5 * sigma));
  std::vector<double> weights(static_cast<std::size_t>(2 * reach + 1));
  double sum = 0;
  for (int k = -reach; k <= reach; ++k)
    sum += weights[static_cast<std::size_t>(k + reach)] = elementary::exp(-0.5 * (k / sigma) * (k / sigma));
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Zero beyond the rim.
Field convolved_rows(const Field& in, const std::vector<double>& weights) {
  const int reach = static_cast<int>(weights.size() / 2), nx = in.nx();
  Field out(nx, in.ny());
  for_each_row(in.ny(), [&](int j) {
    const double* from = in.row(j).data();
    double* to = out.row(j).data();
    for (int k = -reach; k <= reach; ++k) {
      const double weight = weights[static_cast<std::size_t>(k + reach)];
      for (int i = std::max(0, -k); i < std::min(nx, nx - k); ++i) to[i] += weight * from[i + k];
    }
  });
  return out;
}
Field convolved_columns(const Field& in, const std::vector<double>& weights) {
  const int reach = static_cast<int>(weights.size() / 2), ny = in.ny();
  Field out(in.nx(), ny);
  for_each_row(ny, [&](int j) {
    double* to = out.row(j).data();
    for (int k = std::max(-reach, -j); k <= std::min(reach, ny - 1 - j); ++k) {
      const double weight = weights[static_cast<std::size_t>(k + reach)];
      const double* from = in.row(j + k).data();
      for (int i = 0; i < in.nx(); ++i) to[i] += weight * from[i];
    }
  });
  return out;
}

}  // namespace

HeightMap levelled_map(const Surface& surface, double cell, Plane& plane) {
  const Grid& grid = surface.grid();
  HeightMap map{surface.measured_heights(), grid.hx() / cell, grid.hy() / cell};
  Field& z = map.heights;
  plane = {};
  // The second pass removes the rounding of a steep plane.
  for (int pass = 0; pass < 2; ++pass) {
    const double middle = known_mean(z.values());
    const auto [n, x, y, xx, xy, yy, v, vx, vy] = plane_sums(z, middle);
    const double cxx = xx - x * x / n, cxy = xy - x * y / n, cyy = yy - y * y / n;
    const double cvx = vx - v * x / n, cvy = vy - v * y / n;
    const double determinant = cxx * cyy - cxy * cxy;
    double a = 0, b = 0;
    if (determinant > 1e-12 * cxx * cyy) {
      a = (cvx * cyy - cvy * cxy) / determinant;
      b = (cvy * cxx - cvx * cxy) / determinant;
    }
    const double c = middle + (v - a * x - b * y) / n;
    const double half_x = std::max(0.5 * (z.nx() - 1), 0.5), half_y = std::max(0.5 * (z.ny() - 1), 0.5);
    a /= half_x * map.hx;
    b /= half_y * map.hy;
    for_each_row(z.ny(), [&](int j) {
      for (int i = 0; i < z.nx(); ++i) z(i, j) -= c + a * map.x(i) + b * map.y(j);
    });
    plane.height += c;
    plane.slope_x += a;
    plane.slope_y += b;
  }
  return map;
}

double rms_height(const HeightMap& map) {
  const Field& z = map.heights;
  const auto [sum, count] = blocked_sums<2>(z.size(), [&](std::size_t k) -> std::array<double, 2> {
    if (std::isnan(z[k])) return {};
    return {z[k] * z[k], 1};
  });
  return count > 0 ? std::sqrt(sum / count) : 0;
}

HeightMap without_spikes(const HeightMap& map) {
  const int nx = map.nx(), ny = map.ny();
  const Field& z = map.heights;
  // Distance from the neighbours' median, else NaN.
  Field apart(nx, ny, not_measured);
  for_each_row(ny, [&](int j) {
    std::array<double, 8> around{};  // sorted
    for (int i = 0; i < nx; ++i) {
      if (std::isnan(z(i, j))) continue;
      std::size_t count = 0;
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, ny - 1); ++b)
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, nx - 1); ++a)
          if ((a != i || b != j) && !std::isnan(z(a, b))) {
            std::size_t at = count++;
            for (; at > 0 && around[at - 1] > z(a, b); --at) around[at] = around[at - 1];
            around[at] = z(a, b);
          }
      if (count < 3) continue;
      apart(i, j) = std::abs(z(i, j) - 0.5 * (around[(count - 1) / 2] + around[count / 2]));
    }
  });
  Array<double> sorted;
  sorted.reserve(apart.size());
  for (const double d : apart.values())
    if (!std::isnan(d)) sorted.push_back(d);
  HeightMap result = map;
  if (sorted.empty()) return result;
  const double limit = 8 * 1.4826 * upper_median(sorted);
  if (!(limit > 0)) return result;
  for_each_row(ny, [&](int j) {
    for (int i = 0; i < nx; ++i) {
      if (!(apart(i, j) > limit)) continue;
      int others = -1;
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, ny - 1); ++b)
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, nx - 1); ++a)
          others += apart(a, b) > limit ? 1 : 0;
      if (others <= 1) result.heights(i, j) = not_measured;
    }
  });
  return result;
}

HeightMap coarser_map(const HeightMap& map, double spacing) {
  const int nx = static_cast<int>(std::floor(map.extent_x() / spacing + 1e-9)) + 1;
  const int ny = static_cast<int>(std::floor(map.extent_y() / spacing + 1e-9)) + 1;
  Field sum(nx, ny), count(nx, ny);
  for (int j = 0; j < map.ny(); ++j) {
    const int to_j = static_cast<int>(std::floor(map.y(j) / spacing + 0.5 * ny));
    if (to_j < 0 || to_j >= ny) continue;
    for (int i = 0; i < map.nx(); ++i) {
      const double z = map.heights(i, j);
      const int to_i = static_cast<int>(std::floor(map.x(i) / spacing + 0.5 * nx));
      if (std::isnan(z) || to_i < 0 || to_i >= nx) continue;
      sum(to_i, to_j) += z;
      count(to_i, to_j) += 1;
    }
  }
  const double half = 0.5 * spacing * spacing / (map.hx * map.hy);
  for (std::size_t k = 0; k < sum.size(); ++k)
    sum[k] = count[k] > 0 && count[k] >= half - 1e-9 ? sum[k] / count[k] : not_measured;
  return {std::move(sum), spacing, spacing};
}

SmoothMap smoothed_map(const HeightMap& map, double sigma) {
  const std::vector<double> along_x = gaussian_weights(sigma / map.hx);
  const std::vector<double> along_y = gaussian_weights(sigma / map.hy);
  Field known(map.nx(), map.ny()), weighed(map.nx(), map.ny());
  for (std::size_t k = 0; k < known.size(); ++k) {
    const bool is_known = !std::isnan(map.heights[k]);
    known[k] = is_known ? 1 : 0;
    weighed[k] = is_known ? map.heights[k] : 0;
  }
  weighed = convolved_columns(convolved_rows(weighed, along_x), along_y);
  known = convolved_columns(convolved_rows(known, along_x), along_y);
  for (std::size_t k = 0; k < known.size(); ++k) weighed[k] = known[k] > 1e-5 ? weighed[k] / known[k] : 0;
  return {{std::move(weighed), map.hx, map.hy}, std::move(known)};
}

}  // namespace asperity::registration
