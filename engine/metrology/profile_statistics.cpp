// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/profile_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

// Calls pair(from, to) for every step of `s` samples, with `holes` only between measured ends.
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

}  // namespace

void step_statistics(std::span<const double> heights, double spacing, double unit, const Stepping& stepping,
                     std::span<double> statistics, std::span<double> mean_square_slopes) {
  for (std::size_t k = 0; k < stepping.steps.size(); ++k) {
    const int s = stepping.steps[k];
    switch (stepping.method) {
      case DimensionMethod::length: {
        const Length length = length_at(heights, spacing, s, stepping);
        statistics[k] = length.excess;
        if (!mean_square_slopes.empty()) mean_square_slopes[k] = length.mean_square_slope;
        break;
      }
      case DimensionMethod::structure:
        statistics[k] = difference_at(heights, unit, s, stepping, true);
        break;
      case DimensionMethod::madogram:
        statistics[k] = difference_at(heights, unit, s, stepping, false);
        break;
      case DimensionMethod::box:
        statistics[k] = boxes_at(heights, unit, s, stepping.wrap);
        break;
      case DimensionMethod::psd:
        break;
    }
  }
}

}  // namespace asperity
