// SPDX-License-Identifier: GPL-3.0-or-later
// Natural bicubic spline through a map, with gradient. Exact for planes; fourth order far from the rim.
// Thread-safe once made.
#pragma once

#include "engine/core/grid.hpp"

namespace asperity::registration {

class NaturalSpline {
 public:
  struct Value {
    double height, along_x, along_y;  // per node
  };

  // Finite heights, 2 x 2 nodes or more. O(nodes); memory of a map.
  explicit NaturalSpline(const Field& heights);

  int nx() const { return coefficients_.nx() - 2; }
  int ny() const { return coefficients_.ny() - 2; }
  // 0 <= x <= nx-1, 0 <= y <= ny-1, in nodes.
  Value at(double x, double y) const;

 private:
  Field coefficients_;  // B-splines, one more beyond each rim
};

}  // namespace asperity::registration
