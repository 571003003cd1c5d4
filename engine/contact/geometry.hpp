// SPDX-License-Identifier: GPL-3.0-or-later
// The undeformed geometry of a contact: the combined heights h = z1 + T z2, both bodies as they lie
// over each other. With no deformation the bodies first touch where h is greatest, and the gap at
// node (i, j) is max h − h there. Under a flat, h is the lower body's own height field, shared and
// not copied. Immutable; any number of threads may read it.
#pragma once

#include <memory>

#include "engine/contact/pose.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

// What earlier events left in the bodies beside their shapes: the hardness of each node, Pa, in each body's
// own frame. None until a body has hardened: its material then says how hard it is.
struct HardnessMemory {
  std::shared_ptr<const Field> lower, upper;
  // Off the lattice, after events there: the upper body's as the nodes of the lower one meet it, exact until
  // the bodies are moved.
  std::shared_ptr<const Field> upper_here;
};

class ContactGeometry {
 public:
  // The bodies of `scene` (which must have passed check) lying as `pose` says. O(n), and one field of
  // memory for two rough bodies. Nodes of the lower body over which the upper one, turned off the lattice,
  // has no node lie as low as the lowest of the others: they are the last to touch. The bodies are taken as
  // put down afresh: `hardness` counts in each body's own frame. Throws Error{bad_value} when the sums of
  // heights leave the range of a double.
  ContactGeometry(const Scene& scene, const Pose& pose, HardnessMemory hardness = {});

  // The bodies after an event that took `yielded` from both together, still lying as in `before`. Off the
  // lattice each body keeps its share only as well as its nodes map onto the other's; what they lost
  // together here is kept exactly until they are moved.
  ContactGeometry(const Scene& scene, const ContactGeometry& before, HardnessMemory hardness,
                  const Field& yielded);

  const Grid& grid() const { return lower_.grid(); }
  const Surface& lower() const { return lower_; }
  const UpperBody& upper() const { return upper_; }
  Boundary boundary() const { return boundary_; }
  const Pose& pose() const { return pose_; }
  const HardnessMemory& hardness() const { return hardness_; }
  bool upper_is_flat() const { return std::holds_alternative<Material>(upper_); }

  const Field& combined() const { return combined_ ? *combined_ : lower_.heights(); }  // m
  Range combined_range() const { return range_; }                                      // m
  double peak_to_valley() const { return range_.span(); }                              // m

 private:
  Surface lower_;
  UpperBody upper_;
  Boundary boundary_;
  Pose pose_;
  HardnessMemory hardness_;
  std::shared_ptr<const Field> combined_;  // none under a flat
  Range range_;
};

// The material of a body, if it has one.
const Material* lower_material(const Surface& lower);
const Material* upper_material(const UpperBody& upper);

}  // namespace asperity
