// SPDX-License-Identifier: GPL-3.0-or-later
// Placement of the upper body on the lower: an exact lattice isometry, then the rest of the turn,
// counter-clockwise seen from above the lower body. The angle snaps to quarter turns within 1e-9 rad, where
// the pose permutes nodes. The rest interpolates, always from the stored heights, and needs a free boundary.
#pragma once

#include "engine/core/grid.hpp"

namespace asperity {

// T = shift ∘ turn ∘ mirror on the nodes: mirror i → nx−1−i (upper body turned over about y), turn by k·90°
// about the centre of the nodes, cyclic shift by whole cells. A permutation: the inverse restores the same
// bits.
class LatticeIsometry {
 public:
  struct Node {
    int i = 0, j = 0;
    bool operator==(const Node&) const = default;
  };

  // The mirror: upper node (i, j) on lower node (nx−1−i, j).
  LatticeIsometry(int nx, int ny);

  // quarters·90°, any sign. Throws Error{bad_value} for an odd number if nx != ny.
  LatticeIsometry turned(int quarters) const;
  // Cyclic, any sign.
  LatticeIsometry shifted(int cells_x, int cells_y) const;

  // The node must be on the grid.
  Node to_lower(Node own) const;
  Node to_upper(Node lower) const;

  // Upper body's frame to lower body's nodes, and back. Copies values; O(n).
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
  // The lattice turn is the initial angle.
  Pose(const LatticeIsometry& lattice);  // NOLINT: a lattice isometry is a pose

  // Adds a turn (finite, rad). With different cells or sides in x and y, only half turns are on the lattice.
  Pose turned(double angle, const Grid& grid) const;

  const LatticeIsometry& lattice() const { return lattice_; }
  bool on_lattice() const { return rest_ == 0; }
  double rest() const { return rest_; }    // rad, the part off the lattice
  double angle() const { return angle_; }  // rad, total, −π … π

  // Upper body's frame to lower body's nodes, bilinear; NaN off the turned body. A quarter turn of an oblong
  // tile of square cells copies values between coinciding nodes. O(n).
  Field to_lower(const Field& own, const Grid& grid) const;
  // Lower body to upper body's frame, bilinear: positive weights with sum one give no new sign or extreme.
  // Zero off the lower body. O(n).
  Field to_upper(const Field& lower, const Grid& grid) const;

  bool operator==(const Pose&) const = default;

 private:
  LatticeIsometry lattice_;
  double angle_;
  double rest_ = 0;
};

}  // namespace asperity
