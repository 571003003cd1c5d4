// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

Grid make_grid(double nx, double ny, double size_x, double size_y) {
  for (const double n : {nx, ny}) {
    if (!(n >= 1 && n <= max_cells && n == std::floor(n)))
      throw Error(ErrorCode::bad_value, "`cells` is " + format_short(n) + " a side",
                  "give a whole number from 1 to " + std::to_string(max_cells));
  }
  for (const double size : {size_x, size_y}) {
    if (!(std::isfinite(size) && size > 0))
      throw Error(ErrorCode::bad_value, "`size` is " + format_short(size) + " m",
                  "give a finite length above zero");
  }
  for (const auto& [size, n] : {std::pair{size_x, nx}, std::pair{size_y, ny}})
    if (!(size / n > 0))
      throw Error(
          ErrorCode::bad_value,
          "`size` is " + format_short(size) + " m, which leaves its " + format_short(n) + " cells no width",
          "check its unit");
  return Grid{static_cast<int>(nx), static_cast<int>(ny), size_x, size_y};
}

namespace {
constexpr std::size_t block = 1024;

double sum_of_block(const double* v, std::size_t n) {
  // Eight running sums: a fixed order that the compiler can keep in registers.
  double lanes[8] = {};
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) lanes[lane] += v[k + lane];
  for (std::size_t lane = 0; k < n; ++k, ++lane) lanes[lane] += v[k];
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

double pairwise(const double* v, std::size_t n) {
  if (n <= block) return sum_of_block(v, n);
  const std::size_t blocks = (n + block - 1) / block;
  const std::size_t left = blocks / 2 * block;
  return pairwise(v, left) + pairwise(v + left, n - left);
}
}  // namespace

double block_sum(std::span<const double> values) { return pairwise(values.data(), values.size()); }

double mean(std::span<const double> values) {
  return values.empty() ? 0.0 : block_sum(values) / static_cast<double>(values.size());
}

Range range(std::span<const double> values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

}  // namespace asperity
