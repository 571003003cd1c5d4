// SPDX-License-Identifier: GPL-3.0-or-later
// The displacement of an elastic half-space under a uniformly loaded rectangle (Love 1929):
// u(x, y) = 1/(π E*) ∬ dξ dη / √((x−ξ)² + (y−η)²), here with E* = 1 and a rectangle of 1 × aspect.
// The textbook form is a difference of four logarithms that cancels away from the rectangle, so it is
// used on the rectangle only; elsewhere one integral is done in closed form without cancellation and
// the other by Gauss's rule, and far away moments of the rectangle are enough. The relative error is
// below 1e-13 at any distance. No anisotropy, no shear.
#pragma once

namespace asperity {

class LoveKernel {
 public:
  // The rectangle is 1 wide along x and `aspect` > 0 along y.
  explicit LoveKernel(double aspect);
  // Displacement under a unit pressure at (i, j·aspect) from the centre of the rectangle: between
  // nodes i and j are integers. Even in both. Thread-safe.
  double operator()(double i, double j) const;

 private:
  double far(double x, double y) const;

  double aspect_;
  double far_;  // square of the distance beyond which moments are used
};

}  // namespace asperity
