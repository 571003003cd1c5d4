// SPDX-License-Identifier: GPL-3.0-or-later
// Roughness by scale, after Sanner, Nöhring, Thimons, Jacobs & Pastewka (2022), "Scale-dependent roughness
// parameters for topography analysis":
//   slope at the distance l       √ mean ((h(x + l) - h(x))/l)²  =  √(2 Rq² (1 - f(l)))/l with the
//   autocorrelation f curvature at the distance 2l  √ mean ((h(x + l) - 2 h(x) + h(x - l))/l²)² height in
//   blocks of width l   √ mean (h - plane of the block)²  (variable bandwidth), over all samples of all
//   blocks
// along x, along y, and (slope, curvature) over both. Distances are those of the whole stencil and whole
// cells; a map that is not periodic does not wrap; a stencil that touches a hole is left out, as is a block
// of fewer than four samples.
//
// Reliability: a spherical tip of radius R cannot leave curvatures below -1/R. Scales at which the most
// negative curvature passes -c/R, c = 1/2, are suspect; the cut-off is the greatest of them, for the
// condition is not monotonic. It is on the safe side for mild tips.
#pragma once

#include <vector>

#include "engine/surface/surface.hpp"

namespace asperity {

enum class ScaleQuantity { slope, curvature, height };

struct ScaleDependence {
  std::vector<double> distance;  // m, of the whole stencil, rising
  std::vector<double> value;     // rms: none, 1/m or m; NaN where no stencil was measured
  std::vector<double> least;     // curvature alone: the most negative, 1/m
};

enum class ScaleAxis { x, y };

// Of slope and curvature: at the given numbers of cells l (of `height`: the numbers of blocks a side). Each
// from 1; l and 2l up to the cells along the axis less one. Throws Error{bad_value} for others. One pass over
// the map each; the same bits for any number of threads.
ScaleDependence scale_dependence(const Surface& surface, ScaleQuantity quantity, ScaleAxis axis,
                                 const std::vector<int>& cells);

// The rms height about the planes of s x s blocks of which a node (i, j) is in (i s/nx, j s/ny).
double height_in_blocks(const Surface& surface, int blocks);

// The stencil, m, from which on the curvature along the axis stays above -`share`/`radius`: 0 where all do;
// half the map, the longest that is looked at, where even that is suspect.
double tip_cut_off(const Surface& surface, ScaleAxis axis, double radius, double share = 0.5);

}  // namespace asperity
