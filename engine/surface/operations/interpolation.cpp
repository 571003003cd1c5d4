// SPDX-License-Identifier: GPL-3.0-or-later
// Outside nodes are extrapolated by the parabola through the last three nodes (Keys' boundary condition),
// folded into their weights.
#include "engine/surface/operations/interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

CubicWeights cubic_weights(double place, int n, bool wraps) {
  CubicWeights result;
  if (n == 1) {
    result.weight[0] = 1;
    return result;
  }
  if (!wraps && place >= n - 1) {
    const double t = place - (n - 1);
    result.node = {n - 2, n - 1, 0, 0};
    result.weight = {-t, 1 + t, 0, 0};
    return result;
  }
  const double below = std::floor(place), t = place - below;
  const std::array<double, 4> keys{((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1,
                                   ((-1.5 * t + 2) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
  if (wraps) {
    const int start = static_cast<int>(std::fmod(std::fmod(below, n) + n, n));
    for (int k = 0; k < 4; ++k) {
      result.node[static_cast<std::size_t>(k)] = ((start + k - 1) % n + n) % n;
      result.weight[static_cast<std::size_t>(k)] = keys[static_cast<std::size_t>(k)];
    }
    return result;
  }
  const int start = static_cast<int>(below) - 1;
  const int first = std::clamp(start, 0, std::max(0, n - 4));
  const int held = std::min(n, 4);
  for (int k = 0; k < held; ++k) result.node[static_cast<std::size_t>(k)] = first + k;
  const auto give = [&](int node, double weight) {
    result.weight[static_cast<std::size_t>(node - first)] += weight;
  };
  for (int k = 0; k < 4; ++k) {
    const int node = start + k;
    const double weight = keys[static_cast<std::size_t>(k)];
    if (node >= 0 && node < n) {
      give(node, weight);
      continue;
    }
    const int inward = node < 0 ? 1 : -1;
    const int rim = node < 0 ? 0 : n - 1;
    if (n == 2) {
      give(rim, 2 * weight);
      give(rim + inward, -weight);
    } else {
      give(rim, 3 * weight);
      give(rim + inward, -3 * weight);
      give(rim + 2 * inward, weight);
    }
  }
  return result;
}

double cubic_height(const Field& heights, const CubicWeights& x, const CubicWeights& y, bool holes) {
  double sum = 0;
  for (std::size_t b = 0; b < 4; ++b) {
    if (holes && y.weight[b] == 0) continue;
    double line = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      if (holes && x.weight[a] == 0) continue;
      line += x.weight[a] * heights(x.node[a], y.node[b]);
    }
    sum += y.weight[b] * line;
  }
  return sum;
}

BandWeights mean_weights(double place, double half, int n) {
  half = std::min({half, place, n - place});
  BandWeights result;
  const double low = place - half, high = place + half;
  if (half <= 0) {
    result.first = static_cast<int>(place);
    result.weight = {1.0};
    return result;
  }
  // Extrapolation needs the last two nodes.
  const int last_stretch = std::max(0, n - 2);
  result.first = std::min(static_cast<int>(low), last_stretch);
  const int last = std::min(static_cast<int>(std::ceil(high)), n - 1);
  result.weight.assign(static_cast<std::size_t>(std::max(last, result.first) - result.first + 1), 0.0);
  if (n == 1) {
    result.weight[0] = 1;
    return result;
  }
  for (int k = result.first; k <= std::min(last, last_stretch); ++k) {
    const double from = std::max(low, static_cast<double>(k));
    const double to = k == last_stretch ? high : std::min(high, k + 1.0);
    if (to <= from) continue;
    const double part = (to - from) / (2 * half), t = 0.5 * (from + to) - k;
    const auto at = static_cast<std::size_t>(k - result.first);
    result.weight[at] += part * (1 - t);
    result.weight[at + 1] += part * t;
  }
  return result;
}

}  // namespace asperity
