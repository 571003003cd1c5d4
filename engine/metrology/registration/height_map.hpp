// SPDX-License-Identifier: GPL-3.0-or-later
// The maps that registration works on: heights less their plane, in units of their own roughness, about the
// centre of the nodes, NaN where nothing was measured; the same on fewer nodes, and smoothed by a Gaussian.
// Weights of what was not measured are zero and the rest is renormalised, so that a hole or the rim bends
// what stands near it: `share` tells how much of the Gaussian fell on measured nodes, and who needs heights
// that are not bent asks for nodes where it is close to 1.
#pragma once

#include <array>

#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::registration {

// Node (i, j) stands at ((i - (nx-1)/2)·hx, (j - (ny-1)/2)·hy): lengths in cells, a unit that both maps
// share.
struct HeightMap {
  Field heights;  // NaN: not measured
  double hx = 1, hy = 1;

  int nx() const { return heights.nx(); }
  int ny() const { return heights.ny(); }
  double x(int i) const { return (i - 0.5 * (nx() - 1)) * hx; }
  double y(int j) const { return (j - 0.5 * (ny() - 1)) * hy; }
  double extent_x() const { return (nx() - 1) * hx; }
  double extent_y() const { return (ny() - 1) * hy; }
};

// The plane of a map, about the centre of its nodes: height + slope·(x, y) with x, y in cells.
struct Plane {
  double height = 0, slope_x = 0, slope_y = 0;
};

// Less the plane that fits the measured nodes best by least squares, which goes to `plane`.
HeightMap levelled_map(const Surface& surface, double cell, Plane& plane);

// Root mean square of the measured heights about zero.
double rms_height(const HeightMap& map);

// Without the spikes of an instrument, which would outweigh the ground around them: heights further from the
// median of their eight neighbours than eight robust standard deviations of that distance over the map,
// unless more than one neighbour is so too (a scratch, an edge), count as not measured.
HeightMap without_spikes(const HeightMap& map);

// Means over squares of `spacing` cells, NaN where less than half of a square was measured.
HeightMap coarser_map(const HeightMap& map, double spacing);

struct SmoothMap {
  HeightMap map;  // 0 where nothing measured is within reach, never NaN
  Field share;    // of the Gaussian's weight on measured nodes: 0 … 1
};

// By a Gaussian of standard deviation `sigma` cells in every direction. O(nodes · sigma).
SmoothMap smoothed_map(const HeightMap& map, double sigma);

}  // namespace asperity::registration
