// SPDX-License-Identifier: GPL-3.0-or-later
// The autocorrelation function of a surface and what ISO 25178-2 reads from it, Sal and Str. With v the
// heights about their mean,
//   f(t) = [mean of v(r) v(r + t) over the pairs of which both are measured] / [mean of v²],
// by zero-padded transforms of v and of the mask: nothing wraps, and long lags do not shrink, for each is
// divided by the pairs it has. Lags go to half the map either way; beyond there are too few pairs.
//
// Sal is the shortest way from the origin on which f falls to 0.2, Str that over the longest. f is carried
// between lags by a tensor cubic spline (bilinear misses Sal by a hundredth where it is under three cells); a
// ray every half degree, and the shortest is then sought. Where a ray leaves the lags before f has fallen,
// Str does not exist and only its upper bound is known. The Str of a finite isotropic map is below 1: .78 ±
// .15 for a map 13 correlation lengths wide, .95 ± .03 at 51.
#pragma once

#include <optional>

#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct TextureAspect {
  std::optional<double> Sal;        // m; none where f falls on no ray
  std::optional<double> Str;        // 0 … 1; none where f does not fall on every ray
  std::optional<double> Str_bound;  // Str is below, where it does not exist and Sal does
  double shortest_angle = 0;        // rad from x, 0 … π: where f falls soonest
  bool resolved = true;             // Sal is three cells or more
};

// Immutable. Takes some seven times the grid while it is made, one and a bit afterwards. Thread-safe; the
// same bits for any number of threads.
class Autocorrelation {
 public:
  // Throws Error{bad_value} for a surface of equal heights or one node wide.
  explicit Autocorrelation(const Surface& surface);

  int lags_x() const { return lags_x_; }  // nx/2
  int lags_y() const { return lags_y_; }
  // f at a lag of whole cells, |i| <= lags_x, |j| <= lags_y. NaN where no pair was measured. Throws
  // Error{bad_value} outside.
  double operator()(int i, int j) const;
  TextureAspect texture(double level = 0.2) const;

 private:
  class Spline;
  int lags_x_, lags_y_;
  double hx_, hy_;
  Field half_;  // row j is lag j, 0 … lags_y; columns -lags_x … lags_x
};

}  // namespace asperity
