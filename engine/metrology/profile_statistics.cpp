// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/profile_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

namespace {

// With `holes` only between measured ends.
template <class Pair>
int for_each_step(std::span<const double> z, int s, bool wrap, bool every_offset, bool holes,
                  const Pair& pair) {
  const auto n = static_cast<int>(z.size());
  int counted = 0;
  const int stride = every_offset ? 1 : s;
  const int steps = every_offset ? (wrap ? n : n - s) : (wrap ? n : n - 1) / s;
  for (int k = 0; k < steps; ++k) {
    const int i = k * stride, j = i + s;
    const auto from = static_cast<std::size_t>(i), to = static_cast<std::size_t>(j < n ? j : j - n);
    if (holes && (std::isnan(z[from]) || std::isnan(z[to]))) continue;
    pair(from, to);
    ++counted;
  }
  return counted;
}

struct Length {
  double excess, mean_square_slope;
};

Length length_at(std::span<const double> z, double spacing, int s, const Stepping& stepping) {
  double excess = 0, squares = 0;
  const double run = s * spacing;
  const int steps =
      for_each_step(z, s, stepping.wrap, stepping.offsets, stepping.holes, [&](std::size_t i, std::size_t j) {
        const double slope = std::abs(z[j] - z[i]) / run;
        // √(1 + slope²) - 1 without cancellation or overflow.
        excess += slope < 1e150 ? slope * slope / (1 + std::sqrt(1 + slope * slope)) : slope;
        squares += std::min(slope, 1e150) * std::min(slope, 1e150);
      });
  return {excess / steps, squares / steps};
}

double difference_at(std::span<const double> z, double unit, int s, const Stepping& stepping, bool squared) {
  double sum = 0;
  const int steps =
      for_each_step(z, s, stepping.wrap, true, stepping.holes, [&](std::size_t i, std::size_t j) {
        const double d = (z[j] - z[i]) / unit;
        sum += squared ? d * d : std::abs(d);
      });
  return sum / steps;
}

// Boxes start at the lowest point and first sample; whole columns are scaled up to the length.
double boxes_at(std::span<const double> z, double unit, int s, bool wrap) {
  const auto n = z.size();
  const std::size_t intervals = wrap ? n : n - 1;
  const auto width = static_cast<std::size_t>(s);
  const std::size_t columns = intervals / width;
  const double low = range(z).min;
  const double per_box = static_cast<double>(intervals) / s;
  const double top = std::ceil(per_box) - 1;
  double count = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    double least = z[c * width], most = least;
    for (std::size_t k = c * width + 1; k <= (c + 1) * width; ++k) {
      const double height = z[k < n ? k : k - n];
      least = std::min(least, height);
      most = std::max(most, height);
    }
    count += std::min(std::floor((most - low) / unit * per_box), top) -
             std::min(std::floor((least - low) / unit * per_box), top) + 1;
  }
  return count * (per_box / static_cast<double>(columns));
}

// √(2x/π) eˣ times K0(x), K1(x): of order one where the functions vanish.
struct ScaledBessel {
  double k0, k1;
};

// Σ Π (4ν² - (2m-1)²)/(8x m), to the least term.
double hankel_series(double four_nu_squared, double x) {
  double sum = 1, term = 1;
  for (int m = 1; m < 60; ++m) {
    const double odd = 2 * m - 1;
    const double next = term * (four_nu_squared - odd * odd) / (8 * x * m);
    if (std::abs(next) >= std::abs(term) || std::abs(next) < 1e-18) break;
    sum += term = next;
  }
  return sum;
}

// Trapezoidal rule for K_ν(x) eˣ = ∫ exp(−x(cosh t − 1)) cosh νt dt, t > 0; error exp(−π²/step).
ScaledBessel scaled_bessel(double x) {
  if (x > 25) return {hankel_series(0, x), hankel_series(4, x)};
  constexpr double step = 0.125, vanished = 60;
  double k0 = 0.5, k1 = 0.5;  // in steps
  for (int n = 1;; ++n) {
    const double half = elementary::exp(0.5 * step * n);
    const double sinh_half = 0.5 * (half - 1 / half);
    const double rise = 2 * sinh_half * sinh_half;  // cosh t − 1
    const double share = elementary::exp(-x * rise);
    k0 += share;
    k1 += share * (1 + rise);
    if (x * rise > vanished + step * n) break;
  }
  const double scale = std::sqrt(2 * x / std::numbers::pi) * step;
  return {scale * k0, scale * k1};
}

// Above, E√(1 + s²g²) = s E|g| to the last digit.
constexpr double very_steep = 1e9;
// Below, 1/s² overflows.
constexpr double very_flat = 1e-150;

}  // namespace

void step_statistics(std::span<const double> heights, double spacing, double unit, const Stepping& stepping,
                     std::span<double> statistics, std::span<double> mean_square_slopes) {
  for (std::size_t k = 0; k < stepping.steps.size(); ++k) {
    const int s = stepping.steps[k];
    if (stepping.method == DimensionMethod::length) {
      const Length length = length_at(heights, spacing, s, stepping);
      statistics[k] = length.excess;
      if (!mean_square_slopes.empty()) mean_square_slopes[k] = length.mean_square_slope;
    } else if (stepping.method == DimensionMethod::box) {
      statistics[k] = boxes_at(heights, unit, s, stepping.wrap);
    } else {
      statistics[k] =
          difference_at(heights, unit, s, stepping, stepping.method == DimensionMethod::structure);
    }
  }
}

double expected_length_ratio(double rms_slope) {
  const double s = std::abs(rms_slope);
  if (s < very_flat) return 1;
  if (s > very_steep) return s * std::sqrt(2 / std::numbers::pi);
  const ScaledBessel k = scaled_bessel(1 / (4 * s * s));
  return (k.k0 + k.k1) / 2;
}

double length_sensitivity(double rms_slope) {
  const double s = std::abs(rms_slope);
  if (s < 1e-3) return s * s * (1 - 2 * s * s);
  if (s > very_steep) return 1;
  const ScaledBessel k = scaled_bessel(1 / (4 * s * s));
  return (k.k1 - k.k0) / (k.k1 + k.k0);
}

}  // namespace asperity
