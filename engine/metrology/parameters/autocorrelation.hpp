// SPDX-License-Identifier: GPL-3.0-or-later
// Autocorrelation of a surface, with Sal and Str of ISO 25178-2. For heights v about their mean,
//   f(t) = [mean of v(r) v(r + t) over measured pairs] / [mean of v²],
// by zero-padded transforms of v and the mask; lags up to half the map.
//
// Sal is the shortest distance at which f falls to 0.2; Str its ratio to the longest. Rays every half degree
// follow f on a cubic spline (bilinear: 1 % error below three cells). Unless f falls on every ray, only a
// bound of Str exists. Isotropic maps: Str .78 ± .15 (13 correlation lengths) or .95 ± .03 (51).
#pragma once

#include <optional>

#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct TextureAspect {
  std::optional<double> Sal;        // m; empty if f falls on no ray
  std::optional<double> Str;        // 0 … 1; empty if f does not fall on every ray
  std::optional<double> Str_bound;  // upper bound if only Sal exists
  bool resolved = true;             // Sal is at least three cells
};

// Immutable. Memory: seven grids during construction, then one. Thread-safe.
class Autocorrelation {
 public:
  // Throws Error{bad_value} for equal heights or one node of width.
  explicit Autocorrelation(const Surface& surface);

  int lags_x() const { return lags_x_; }  // nx/2
  int lags_y() const { return lags_y_; }
  // f at a lag in cells; NaN without measured pairs. Throws Error{bad_value} beyond lags_x, lags_y.
  double operator()(int i, int j) const;
  TextureAspect texture(double level = 0.2) const;

 private:
  class Spline;
  int lags_x_, lags_y_;
  double hx_, hy_;
  Field half_;  // row j: lag j, 0 … lags_y; columns -lags_x … lags_x
};

}  // namespace asperity
