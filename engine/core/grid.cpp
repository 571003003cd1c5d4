// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/grid.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/require.hpp"

namespace asperity {

Grid make_grid(double nx, double ny, double size_x, double size_y) {
  for (const double n : {nx, ny}) {
    if (!(n >= 1 && n <= max_cells && n == std::floor(n)))
      refuse("`cells` is " + format_short(n) + " a side",
             "give a whole number from 1 to " + std::to_string(max_cells));
  }
  for (const double size : {size_x, size_y}) {
    require_positive("size", size, "m", "give a finite length above zero");
  }
  for (const auto& [size, n] : {std::pair{size_x, nx}, std::pair{size_y, ny}})
    if (!(size / n > 0))
      refuse(
          "`size` is " + format_short(size) + " m, which leaves its " + format_short(n) + " cells no width",
          "check its unit");
  return Grid{static_cast<int>(nx), static_cast<int>(ny), size_x, size_y};
}

namespace {
constexpr std::size_t block = 1024;

double sum_of_block(const double* v, std::size_t n) {
  // Eight partial sums in fixed order.
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

bool is_known(double value) { return !std::isnan(value); }

Array<double> known_values(std::span<const double> values) {
  Array<double> known;
  known.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(known), is_known);
  return known;
}

bool all_known(std::span<const double> values) { return std::ranges::all_of(values, is_known); }

}  // namespace

Field::Field(int nx, int ny, UnsetArray<double>&& values) : nx_(nx), ny_(ny), values_(std::move(values)) {
  if (values_.size() != static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny))
    throw Error(ErrorCode::internal, "a field's values are not on its grid");
}

double block_sum(std::span<const double> values) { return pairwise(values.data(), values.size()); }

double upper_median(std::span<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(std::span<const double> values) {
  return values.empty() ? 0.0 : block_sum(values) / static_cast<double>(values.size());
}

Range range(std::span<const double> values) {
  if (values.empty()) return {};
  // Lanes hide latency.
  constexpr std::size_t lanes = 16;
  double low[lanes], high[lanes];
  std::fill_n(low, lanes, values.front());
  std::fill_n(high, lanes, values.front());
  const double* const from = values.data();
  const std::size_t whole = values.size() / lanes * lanes;
  for (std::size_t k = 0; k < whole; k += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double value = from[k + lane];
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
    }
  const auto rest = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(whole), values.end());
  Range range{*std::min_element(low, low + lanes), *std::max_element(high, high + lanes)};
  if (whole < values.size()) range = {std::min(range.min, *rest.first), std::max(range.max, *rest.second)};
  return range;
}

std::size_t known_count(std::span<const double> values) {
  return static_cast<std::size_t>(std::ranges::count_if(values, is_known));
}

double known_mean(std::span<const double> values) {
  return all_known(values) ? mean(values) : mean(known_values(values));
}

Range known_range(std::span<const double> values) {
  return all_known(values) ? range(values) : range(known_values(values));
}

double node_value(const Field& field, double i, double j) {
  const bool inside =
      i >= 0 && i < field.nx() && i == std::floor(i) && j >= 0 && j < field.ny() && j == std::floor(j);
  if (!inside)
    refuse("there is no node (" + format_short(i, 17) + ", " + format_short(j, 17) + ")",
           "i runs from 0 to " + std::to_string(field.nx() - 1) + ", j from 0 to " +
               std::to_string(field.ny() - 1));
  return field(static_cast<int>(i), static_cast<int>(j));
}

}  // namespace asperity
