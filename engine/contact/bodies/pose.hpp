// SPDX-License-Identifier: GPL-3.0-or-later
// How the upper body lies over the lower one: an exact lattice isometry, then a turn by any angle about
// the centre of the nodes, counter-clockwise seen from above the lower body. The angle is kept as it
// adds up and is snapped to whole quarter turns within 1e-9 rad, where the pose is a permutation of
// nodes; only what is left between them interpolates, and then afresh from the stored heights, never
// from heights that were turned before. An interpolated turn needs a free boundary.
#pragma once

#include "engine/contact/bodies/lattice_isometry.hpp"

namespace asperity {

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
