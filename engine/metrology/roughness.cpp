// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/roughness.hpp"

#include <algorithm>
#include <cmath>

#include "engine/metrology/blocked_sums.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

// (z·down - mean - rest)·up is of order one, with powers of two; `rest`: rounding of the mean.
struct Normalised {
  int exponent = 0;  // unit: 2^exponent m
  double down = 1, mean = 0, rest = 0, up = 1;
  double operator()(double z) const { return ((z * down - mean) - rest) * up; }
};

Normalised normalise(std::span<const double> heights, const Range& r, double mean) {
  Normalised n;
  const int coarse = scale_exponent(magnitude(r));
  n.down = std::ldexp(1.0, -coarse);
  n.mean = mean * n.down;
  const int fine = scale_exponent(std::max(r.max * n.down - n.mean, n.mean - r.min * n.down));
  n.up = std::ldexp(1.0, -fine);
  n.exponent = coarse + fine;
  n.rest = blocked_sums<1>(heights.size(),
                           [&](std::size_t k) { return std::array{heights[k] * n.down - n.mean}; })[0] /
           static_cast<double>(heights.size());
  return n;
}

Roughness amplitudes(std::span<const double> heights, const Range& r, const Normalised& unit, double mean) {
  const auto n = static_cast<double>(heights.size());
  const auto [first, second, third, fourth] = blocked_sums<4>(heights.size(), [&](std::size_t k) {
    const double u = unit(heights[k]), u2 = u * u;
    return std::array{std::abs(u), u2, u2 * u, u2 * u2};
  });
  const double variance = second / n;
  Roughness result;
  result.Ra = std::ldexp(first / n, unit.exponent);
  result.Rq = std::ldexp(std::sqrt(variance), unit.exponent);
  result.skewness = third / n / (variance * std::sqrt(variance));
  result.kurtosis = fourth / n / (variance * variance);
  result.amplitude = r.span();
  result.peak = r.max;
  result.valley = r.min;
  result.mean = mean;
  return result;
}

Roughness flat(const Range& r) {
  Roughness result;
  result.peak = result.valley = result.mean = r.max;
  return result;
}

// From squares of order one.
double rms_slope(const Field& z, const Grid& grid, const Normalised& unit) {
  const bool along_x = grid.nx > 1, along_y = grid.ny > 1;
  const int columns = along_x ? grid.nx - 1 : 1, rows = along_y ? grid.ny - 1 : 1;
  const double h = along_x && along_y ? std::min(grid.hx(), grid.hy()) : (along_x ? grid.hx() : grid.hy());
  const double to_x = along_x ? h / grid.hx() : 0, to_y = along_y ? h / grid.hy() : 0;
  Array<double> row_sums(static_cast<std::size_t>(rows));
  for_each_row(rows, [&](int j) {
    Array<double> squares(static_cast<std::size_t>(columns));
    const std::span<const double> here = z.row(j), above = z.row(along_y ? j + 1 : j);
    const std::size_t right = along_x ? 1 : 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const double u = unit(here[i]);
      const double dx = (unit(here[i + right]) - u) * to_x, dy = (unit(above[i]) - u) * to_y;
      squares[i] = dx * dx + dy * dy;
    }
    row_sums[static_cast<std::size_t>(j)] = block_sum(squares);
  });
  const double mean_square = block_sum(row_sums) / (static_cast<double>(rows) * columns);
  return std::ldexp(std::sqrt(mean_square) / h, unit.exponent);
}

// Mean over pairs (k, k + step); NaN without pairs. `holds` excludes pairs across a rim.
template <class Holds>
double mean_square_difference(std::span<const double> z, std::size_t step, const Normalised& unit,
                              const Holds& holds) {
  if (z.size() <= step) return std::numeric_limits<double>::quiet_NaN();
  const auto [sum, pairs] = blocked_sums<2>(z.size() - step, [&](std::size_t k) {
    const double d = unit(z[k + step]) - unit(z[k]);
    const bool counts = !std::isnan(d) && holds(k);
    return std::array{counts ? d * d : 0.0, counts ? 1.0 : 0.0};
  });
  return pairs > 0 ? sum / pairs : std::numeric_limits<double>::quiet_NaN();
}
constexpr auto every_pair = [](std::size_t) { return true; };

double rms_slope_of_pairs(const Field& z, const Grid& grid, const Normalised& unit) {
  const bool along_x = grid.nx > 1, along_y = grid.ny > 1;
  const double h = along_x && along_y ? std::min(grid.hx(), grid.hy()) : (along_x ? grid.hx() : grid.hy());
  const auto nx = static_cast<std::size_t>(grid.nx);
  double mean_square = 0;
  if (along_x) {
    const double share = h / grid.hx();
    const auto in_row = [nx](std::size_t k) { return (k + 1) % nx != 0; };
    mean_square += mean_square_difference(z.values(), 1, unit, in_row) * share * share;
  }
  if (along_y) {
    const double share = h / grid.hy();
    mean_square += mean_square_difference(z.values(), nx, unit, every_pair) * share * share;
  }
  return std::ldexp(std::sqrt(mean_square) / h, unit.exponent);
}

// `slope` is called with the unit of the heights.
template <class Body, class Slope>
Roughness roughness_of(const Body& body, const Slope& slope) {
  const MeasuredValues measured(body);
  const Range r = body.height_range();
  if (r.min == r.max && body.complete()) return flat(r);
  const double mean = exact_mean(measured.values(), r);
  const Normalised unit = normalise(measured.values(), r, mean);
  Roughness result = r.min == r.max ? flat(r) : amplitudes(measured.values(), r, unit, mean);
  if (!body.complete()) result.measured = static_cast<std::int64_t>(body.measured());
  result.rms_slope = slope(unit);
  return result;
}

}  // namespace

Roughness roughness(const Surface& surface) {
  return roughness_of(surface, [&](const Normalised& unit) {
    const auto slope = surface.complete() ? rms_slope : rms_slope_of_pairs;
    return slope(surface.measured_heights(), surface.grid(), unit);
  });
}

Roughness roughness(const Profile& profile) {
  return roughness_of(profile, [&](const Normalised& unit) {
    const double squares = mean_square_difference(profile.measured_heights(), 1, unit, every_pair);
    return std::ldexp(std::sqrt(squares) / profile.spacing(), unit.exponent);
  });
}

}  // namespace asperity
