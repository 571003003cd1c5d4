// SPDX-License-Identifier: GPL-3.0-or-later
// Heights minus their plane, in units of roughness, about the centre, NaN in holes. Smoothing renormalises
// over measured nodes, which biases heights near holes and rims; use nodes with `share` near 1.
#pragma once

#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::registration {

// Node (i, j) is at ((i - (nx-1)/2)·hx, (j - (ny-1)/2)·hy), in cells common to both maps.
struct HeightMap {
  Field heights;
  double hx = 1, hy = 1;

  int nx() const { return heights.nx(); }
  int ny() const { return heights.ny(); }
  double x(int i) const { return (i - 0.5 * (nx() - 1)) * hx; }
  double y(int j) const { return (j - 0.5 * (ny() - 1)) * hy; }
  double extent_x() const { return (nx() - 1) * hx; }
  double extent_y() const { return (ny() - 1) * hy; }
};

// height + slope·(x, y) about the centre of the nodes; x, y in cells.
struct Plane {
  double height = 0, slope_x = 0, slope_y = 0;
};

// Returns the subtracted plane in `plane`.
HeightMap levelled_map(const Surface& surface, double cell, Plane& plane);

double rms_height(const HeightMap& map);

// Heights farther from the median of eight neighbours than eight robust standard deviations become holes,
// unless two neighbours are outliers too (scratch, edge).
HeightMap without_spikes(const HeightMap& map);

// Means over squares of `spacing` cells; NaN if less than half was measured.
HeightMap coarser_map(const HeightMap& map, double spacing);

struct SmoothMap {
  HeightMap map;  // 0 without measured nodes in reach, never NaN
  Field share;    // measured weight of the Gaussian, 0 … 1
};

// `sigma`: standard deviation in cells. O(nodes · sigma).
SmoothMap smoothed_map(const HeightMap& map, double sigma);

}  // namespace asperity::registration
