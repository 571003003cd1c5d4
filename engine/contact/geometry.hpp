// SPDX-License-Identifier: GPL-3.0-or-later
// The undeformed geometry of a contact: the combined heights h = z1 + T z2, both bodies as they lie
// over each other. With no deformation the bodies first touch where h is greatest, and the gap at
// node (i, j) is max h − h there. Under a flat, h is the lower body's own height field, shared and
// not copied. Immutable; any number of threads may read it.
#pragma once

#include <memory>

#include "engine/contact/lattice_isometry.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

class ContactGeometry {
 public:
  // The bodies of `scene` (which must have passed check) lying as `placement` says. O(n), and one
  // field of memory for two rough bodies. Throws Error{bad_value} when the sums of heights leave the
  // range of a double.
  ContactGeometry(const Scene& scene, const LatticeIsometry& placement);

  const Grid& grid() const { return lower_.grid(); }
  const Surface& lower() const { return lower_; }
  const UpperBody& upper() const { return upper_; }
  Boundary boundary() const { return boundary_; }
  const LatticeIsometry& placement() const { return placement_; }
  bool upper_is_flat() const { return std::holds_alternative<Material>(upper_); }

  const Field& combined() const { return combined_ ? *combined_ : lower_.heights(); }  // m
  Range combined_range() const { return range_; }                                      // m
  double peak_to_valley() const { return range_.span(); }                              // m

 private:
  Surface lower_;
  UpperBody upper_;
  Boundary boundary_;
  LatticeIsometry placement_;
  std::shared_ptr<const Field> combined_;  // none under a flat
  Range range_;
};

// The material of a body, if it has one.
const Material* lower_material(const Surface& lower);
const Material* upper_material(const UpperBody& upper);

}  // namespace asperity
