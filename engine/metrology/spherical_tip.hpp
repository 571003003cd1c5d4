// SPDX-License-Identifier: GPL-3.0-or-later
// What a spherical tip of radius R can feel of a surface S: the height of its lowest point when it
// rests at x is the grey-scale dilation of the surface by the sphere,
//
//   t(x) = max over |x' - x| <= R of  S(x') + √(R² - |x' - x|²) - R,
//
// (Villarrubia 1997, J. Res. NIST 102, 425), and dilation followed by erosion, the closing of ISO
// 16610-85, fills what the tip cannot enter. SphericalTip touches the surface as it is between its nodes,
// bilinear, so that a tip smaller than a cell does not fall between nodes; the operations on whole
// maps see nodes alone and are exactly those of mathematical morphology. A tip does not wear, bounce or
// tilt, and presses nothing down.
#pragma once

#include "engine/core/monitor.hpp"
#include "engine/surface/operations/sections.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// A tip over one surface. Thread-safe.
class SphericalTip {
 public:
  // Radius 0 is a needle that follows the surface. Throws Error{bad_value} naming `tip` unless the
  // radius is finite and at least 0, and for a surface with holes unless it is 0.
  SphericalTip(const Surface& surface, double radius);

  // t at a point (m): never below height_between(surface, point), equal to it for radius 0, and not
  // falling with the radius beyond rounding. A periodic surface goes on past its rim; beyond the outermost
  // nodes of any other there is nothing to touch. Costs the cells within reach, which ends where the tip
  // has risen by the surface's range.
  double height(Point point) const;

 private:
  Surface surface_;
  int exponent_;             // lengths along the surface are in units of 2^exponent_ m
  double radius_, hx_, hy_;  // in that unit
  double top_;               // m, the highest node
};

// Dilation and closing at the nodes by the sphere sampled at the nodes: heights never fall, both grow with
// the radius, and closing twice is closing once (each to the last bit or two). Periodic surfaces wrap; any
// other is alone in the world: nothing beyond its rim holds the tip up, or counts when it
// is eroded. Material and periodicity stay. O(nodes · cells within reach); two grids; same bits for any
// number of threads. Throw Error{bad_value} for a radius below 0 or not finite.
Surface dilated(const Surface& surface, double radius, Monitor& monitor = Monitor::silent());
Surface closed(const Surface& surface, double radius, Monitor& monitor = Monitor::silent());

}  // namespace asperity
