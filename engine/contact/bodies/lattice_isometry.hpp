// SPDX-License-Identifier: GPL-3.0-or-later
// How the nodes of the upper body lie over those of the lower one: T = shift ∘ turn ∘ mirror, where
// the mirror i → nx−1−i turns the upper body over about the y axis, the turn is k·90° about the
// centre of the nodes (counter-clockwise seen from above the lower body) and the shift is a whole
// number of cells, cyclic. Every T is a permutation of nodes, so applying it and its inverse gives
// back the same bits; turns by other angles are not expressed here.
#pragma once

#include "engine/core/grid.hpp"

namespace asperity {

class LatticeIsometry {
 public:
  struct Node {
    int i = 0, j = 0;
    bool operator==(const Node&) const = default;
  };

  // Turned over and nothing else: upper node (i, j) lies on lower node (nx−1−i, j).
  LatticeIsometry(int nx, int ny);

  // The same, then a further turn of the upper body by quarters·90°, any sign. Throws
  // Error{bad_value} for an odd number of quarters on a grid with nx != ny.
  LatticeIsometry turned(int quarters) const;
  // The same, then a further cyclic shift of the upper body by whole cells, any sign.
  LatticeIsometry shifted(int cells_x, int cells_y) const;

  // Where upper node `own` lies over the lower body, and back. The node must be on the grid.
  Node to_lower(Node own) const;
  Node to_upper(Node lower) const;

  // A field of the upper body's own frame seen from the lower body, and back. Values are copied,
  // never changed; O(n).
  Field to_lower(const Field& own) const;
  Field to_upper(const Field& lower) const;

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int quarters() const { return quarters_; }  // 0 … 3
  int shift_x() const { return shift_x_; }    // 0 … nx−1
  int shift_y() const { return shift_y_; }    // 0 … ny−1
  bool operator==(const LatticeIsometry&) const = default;

 private:
  Node turn(Node node, int quarters) const;
  int nx_, ny_;
  int quarters_ = 0;
  int shift_x_ = 0, shift_y_ = 0;
};

}  // namespace asperity
