// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical tip of radius R on a surface S: its lowest point at x rests at the grey-scale dilation
//
//   t(x) = max over |x' - x| <= R of  S(x') + √(R² - |x' - x|²) - R
//
// (Villarrubia 1997, J. Res. NIST 102, 425). Closing (dilation, then erosion; ISO 16610-85) fills places the
// tip cannot enter. SphericalTip uses the bilinear surface; operations on maps use nodes only. No wear,
// bouncing, tilting or deformation.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/surface/operations/sections.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Thread-safe.
class SphericalTip {
 public:
  // Radius 0: a needle. Throws Error{bad_value} naming `tip` for a negative or infinite radius, or a positive
  // radius on a surface with holes.
  SphericalTip(const Surface& surface, double radius);

  // t in m: not below height_between(surface, point), equal for radius 0, never falling with the radius
  // beyond rounding. Periodic surfaces continue, others end at the outermost nodes. Cost: cells within reach,
  // where the sphere rises by up to the height range.
  double height(Point point) const;

 private:
  Surface surface_;
  int exponent_;             // length unit: 2^exponent_ m
  double radius_, hx_, hy_;  // in this unit
  double top_;               // m, highest node
};

// At the nodes. Heights never fall, both grow with the radius, closing is idempotent (to one or two last
// bits). Periodic surfaces wrap; nothing exists beyond other rims. Material and periodicity stay. O(nodes ·
// cells within reach); two grids; same bits for any thread count. Throw Error{bad_value} for a negative or
// infinite radius.
Surface dilated(const Surface& surface, double radius, Monitor& monitor = Monitor::silent());
Surface closed(const Surface& surface, double radius, Monitor& monitor = Monitor::silent());

}  // namespace asperity
