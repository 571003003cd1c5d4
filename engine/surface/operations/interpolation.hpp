// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of nodes along one axis for a height between them: Keys' cubic convolution (Keys 1981,
// a = -1/2), which passes through the nodes and is exact for parabolas, up to the rim as well; and
// means over a stretch of the piecewise linear profile, for coarsening. Thread-safe, O(1).
#pragma once

#include <array>
#include <vector>

#include "engine/core/grid.hpp"

namespace asperity {

// Height at a place = sum of weight[k] * height[node[k]].
struct CubicWeights {
  std::array<int, 4> node{};
  std::array<double, 4> weight{};
};

// At `place` (in cells) of an axis of n nodes. Wrapping: any finite place. Otherwise 0 <= place < n:
// between the nodes cubic, past the last one the line through the last two goes on.
CubicWeights cubic_weights(double place, int n, bool wraps);

// Σ over both axes. A node of weight 0 is not touched; with `holes`, where one that is touched is NaN the
// height is.
double cubic_height(const Field& heights, const CubicWeights& x, const CubicWeights& y, bool holes);

// A band of weights of any width.
struct BandWeights {
  int first = 0;
  std::vector<double> weight;
};

// Mean over [place - half, place + half] (in cells, 0 <= place < n) of the line through the nodes;
// near a rim the stretch is shortened on both sides alike, so that planes stay planes.
BandWeights mean_weights(double place, double half, int n);

}  // namespace asperity
