// SPDX-License-Identifier: GPL-3.0-or-later
// Roughness by scale (Sanner, Nöhring, Thimons, Jacobs & Pastewka 2022, "Scale-dependent roughness parameters
// for topography analysis"):
//   slope at l           √ mean ((h(x + l) - h(x))/l)² = √(2 Rq² (1 - f(l)))/l, f: autocorrelation
//   curvature at 2l      √ mean ((h(x + l) - 2 h(x) + h(x - l))/l²)²
//   height in blocks l   √ mean (h - plane of the block)²  (variable bandwidth)
// Only periodic maps wrap. Stencils with a hole and blocks under four samples are left out.
//
// A tip of radius R cannot trace curvatures below -1/R. Scales with curvatures below -1/(2R) are suspect; the
// cut-off is the largest: the condition is not monotonic. Conservative for mild tips.
#pragma once

#include <vector>

#include "engine/surface/surface.hpp"

namespace asperity {

enum class ScaleQuantity { slope, curvature, height };

struct ScaleDependence {
  std::vector<double> distance;  // m, whole stencil
  std::vector<double> value;     // rms; NaN without stencils
  std::vector<double> least;     // curvature: most negative, 1/m
};

enum class ScaleAxis { x, y };

// `cells`: l for slope and curvature (stencil l or 2l, below the map's cells), blocks per side for height.
// Throws Error{bad_value} outside. One pass each.
ScaleDependence scale_dependence(const Surface& surface, ScaleQuantity quantity, ScaleAxis axis,
                                 const std::vector<int>& cells);

// About the planes of s x s blocks; node (i, j) is in block (i s/nx, j s/ny).
double height_in_blocks(const Surface& surface, int blocks);

// Smallest stencil, m, from which on curvatures exceed -`share`/`radius`; 0 if all do; at most half the map.
double tip_cut_off(const Surface& surface, ScaleAxis axis, double radius, double share = 0.5);

}  // namespace asperity
