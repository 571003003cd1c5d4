// SPDX-License-Identifier: GPL-3.0-or-later
// Weights along one axis: Keys' cubic convolution (Keys 1981, a = -1/2), through the nodes and exact for
// parabolas up to the rim; and means of the piecewise linear profile, for coarsening. Thread-safe, O(1).
#pragma once

#include <array>
#include <vector>

#include "engine/core/grid.hpp"

namespace asperity {

// Height = sum of weight[k] * height[node[k]].
struct CubicWeights {
  std::array<int, 4> node{};
  std::array<double, 4> weight{};
};

// `place` in cells on an axis of n nodes. Wrapping: any finite place; otherwise 0 <= place < n, linear past
// the last node.
CubicWeights cubic_weights(double place, int n, bool wraps);

// With `holes`, skips nodes of weight 0; a NaN at another node gives NaN.
double cubic_height(const Field& heights, const CubicWeights& x, const CubicWeights& y, bool holes);

struct BandWeights {
  int first = 0;
  std::vector<double> weight;
};

// Mean of the piecewise linear profile over [place - half, place + half] (cells, 0 <= place < n). Near a rim
// the interval shrinks symmetrically, which preserves planes.
BandWeights mean_weights(double place, double half, int n);

}  // namespace asperity
