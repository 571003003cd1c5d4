// SPDX-License-Identifier: GPL-3.0-or-later
// The same surface on other cells; size, material and node (0, 0) are kept. Periodic surfaces use the
// spectrum: refining preserves common nodes, coarsening drops unresolved waves. Others, and those with holes,
// use Keys' cubic along a refined axis and averages over one new cell along a coarsened axis. Holes end
// periodicity; a touched hole gives a hole.
#pragma once

#include <array>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Weights along one axis: Keys' cubic convolution (Keys 1981, a = -1/2), exact for parabolas up to the rim;
// and means of the piecewise linear profile, for coarsening. Thread-safe, O(1).

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

// Mean over [place - half, place + half] (cells, 0 <= place < n). Near a rim the interval shrinks
// symmetrically, which preserves planes.
BandWeights mean_weights(double place, double half, int n);

// O(n log n) periodic, else O(n); three grids of the larger kind. Drops the aliased share unless nothing
// changes. Throws Error{bad_value} for `cells` outside 1 … 65536.
Surface resampled(const Surface& surface, double nx, double ny);

// The height of the old node there or next below: short waves and NaN stay. O(new nodes).
Field sampled(const Field& heights, int nx, int ny);

struct AtCells {
  Surface surface;
  enum class How {
    unchanged,
    sampled,       // same heights, to the bit
    made_again,    // by the generator
    interpolated,  // by resampled()
  } how = How::unchanged;
};
// Unresolved waves alias, unlike in resampled(). Keeps recipe and material. Throws Error{bad_value} for
// `cells` outside 1 … 65536, and for holes when sampling.
AtCells at_cells(const Surface& surface, int nx, int ny, Monitor& monitor = Monitor::silent());

}  // namespace asperity
