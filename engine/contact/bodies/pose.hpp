// SPDX-License-Identifier: GPL-3.0-or-later
// How the upper body lies over the lower one: an exact lattice isometry, then a turn by any angle about
// the centre of the nodes, counter-clockwise seen from above the lower body. The angle is kept as it
// adds up and is snapped to whole quarter turns within 1e-9 rad, where the pose is a permutation of
// nodes; only what is left between them interpolates, and then afresh from the stored heights, never
// from heights that were turned before. An interpolated turn needs a free boundary.
#pragma once

#include "engine/core/grid.hpp"

namespace asperity {

// How the nodes of the upper body lie over those of the lower one: T = shift ∘ turn ∘ mirror, where
// the mirror i → nx−1−i turns the upper body over about the y axis, the turn is k·90° about the
// centre of the nodes (counter-clockwise seen from above the lower body) and the shift is a whole
// number of cells, cyclic. Every T is a permutation of nodes, so applying it and its inverse gives
// back the same bits; turns by other angles are not expressed here.
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

class Pose {
 public:
  // The turn that this lattice isometry holds counts as the angle so far.
  Pose(const LatticeIsometry& lattice);  // NOLINT: a lattice isometry is a pose

  // The same, then a further turn by `angle` (finite, rad). On a tile whose cells or sides differ in x
  // and y, only half turns are on the lattice.
  Pose turned(double angle, const Grid& grid) const;

  const LatticeIsometry& lattice() const { return lattice_; }
  bool on_lattice() const { return rest_ == 0; }
  double rest() const { return rest_; }    // rad, the turn beyond the lattice
  double angle() const { return angle_; }  // rad, all turns together, −π … π

  // A field of the upper body's own frame seen from the lower body, bilinear between nodes; where the
  // turned body has no node, NaN. A quarter turn of an oblong tile of square cells copies values where it
  // brings nodes onto nodes. O(n).
  Field to_lower(const Field& own, const Grid& grid) const;
  // A field over the lower body brought into the upper body's own frame, bilinear between nodes: weights
  // are positive and sum to one, so no new sign and no new extreme appears. Zero where the lower body has no
  // node. O(n).
  Field to_upper(const Field& lower, const Grid& grid) const;

  bool operator==(const Pose&) const = default;

 private:
  LatticeIsometry lattice_;
  double angle_;
  double rest_ = 0;
};

}  // namespace asperity
