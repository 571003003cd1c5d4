// SPDX-License-Identifier: GPL-3.0-or-later
// The bicubic spline through the nodes of a map, natural at the rim (no second derivative across it), with
// its gradient. Exact for planes; between nodes far from the rim its error is of fourth order in the cell.
// Coefficients of B-splines by a banded elimination along rows, then columns. Thread-safe once it is made.
#pragma once

#include "engine/core/grid.hpp"

namespace asperity::registration {

class NaturalSpline {
 public:
  struct Value {
    double height, along_x, along_y;  // derivatives per node
  };

  // Through finite heights, at least 2 x 2 nodes. O(nodes), as much memory as the map.
  explicit NaturalSpline(const Field& heights);

  int nx() const { return coefficients_.nx() - 2; }
  int ny() const { return coefficients_.ny() - 2; }
  // 0 <= x <= nx-1, 0 <= y <= ny-1, in nodes.
  Value at(double x, double y) const;

 private:
  Field coefficients_;  // one more beyond each rim
};

}  // namespace asperity::registration
