// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/noise_correlation.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

namespace {

constexpr double greatest_correlation = 0.98, least_correlation = 0.4;

// The variance of a second difference over so many readings, of noise of variance 1.
double bend_variance(double r, int stride) {
  const double far = elementary::pow(r, stride);
  return 1.5 - 2 * far + 0.5 * far * far;
}

struct Bends {
  std::size_t count = 0;
  double square = 0;  // of the deviation that their median tells
};

// Within pieces, their ends left out: a corner may lie there.
Bends bends_of(std::span<const double> time, std::span<const double> value,
               std::span<const StraightPiece> pieces, int stride) {
  Array<double> magnitudes;
  // A sensor at its limit has no noise.
  const double top = *std::max_element(value.begin(), value.end());
  const auto lag = static_cast<std::size_t>(stride);
  constexpr std::size_t rim = 1;
  for (const StraightPiece& piece : pieces) {
    const double slope = piece.line.slope();
    const auto left = [&](std::size_t k) {
      return value[k] - piece.line.y - slope * (time[k] - piece.line.t);
    };
    for (std::size_t k = piece.first + rim + lag; k + lag + rim <= piece.last; ++k)
      if (value[k] != top || value[k - lag] != top || value[k + lag] != top)
        magnitudes.push_back(std::abs(left(k) - 0.5 * (left(k - lag) + left(k + lag))));
  }
  if (magnitudes.empty()) return {};
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  constexpr double per_deviation = 0.6745;  // median magnitude of a Gaussian
  const double deviation = *middle / per_deviation;
  return {magnitudes.size(), deviation * deviation};
}

}  // namespace

std::optional<NoiseCorrelation> noise_correlation(std::span<const double> time, std::span<const double> value,
                                                  std::span<const StraightPiece> pieces) {
  constexpr std::size_t enough = 400;
  const Bends near = bends_of(time, value, pieces, 1);
  if (near.count < enough || !(near.square > 0)) return {};
  for (const int stride : {16, 8, 4}) {
    const Bends far = bends_of(time, value, pieces, stride);
    if (far.count < enough) continue;
    // The ratio grows with r, from 1 on.
    const double ratio = far.square / near.square;
    const auto ratio_of = [stride](double r) { return bend_variance(r, stride) / bend_variance(r, 1); };
    double low = 0, high = greatest_correlation;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (ratio_of(middle) < ratio ? low : high) = middle;
    }
    if (low < least_correlation) return {};
    return NoiseCorrelation{std::sqrt(near.square / bend_variance(low, 1)), (1 - low) / (1 + low)};
  }
  return {};
}

}  // namespace asperity
