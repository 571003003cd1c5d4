// SPDX-License-Identifier: GPL-3.0-or-later
// The undeformed geometry of a contact: the combined heights h = z1 + T z2, both bodies as they lie
// over each other. With no deformation the bodies first touch where h is greatest, and the gap at
// node (i, j) is max h − h there. Where a turned upper body does not cover the lower one there is no h (NaN):
// nothing faces that ground, so it has no gap and carries nothing. Under a flat, h is the lower body's own
// height field, shared and not copied. Immutable; any number of threads may read it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "engine/contact/bodies/node_memory.hpp"
#include "engine/contact/bodies/pose.hpp"
#include "engine/contact/scene.hpp"

namespace asperity {

class ContactGeometry {
 public:
  // The bodies of `scene` (which must have passed check) lying as `pose` says, put down afresh: `memory`
  // holds in each body's own frame. A rough upper body that is turned off the lattice leaves some nodes of
  // the lower body uncovered; `uncovered` marks further ones (1 at each such node; empty: none). O(n), and
  // one field of memory for two rough bodies. Throws Error{bad_value} when the sums of heights or of their
  // squares leave the range of a double, or no node of one body lies over the other.
  ContactGeometry(const Scene& scene, const Pose& pose, BodyMemory memory = {},
                  std::span<const std::uint8_t> uncovered = {});

  // The bodies after an event, still lying as in `before`. The event took `yielded` (m, at the nodes of the
  // lower body) from both together; none: the shapes are as they were. Off the lattice the shape of each body
  // is known only as well as its nodes map onto those of the other, but the combined heights have lost
  // exactly `yielded` until the bodies are moved.
  ContactGeometry(const Scene& scene, const ContactGeometry& before, BodyMemory memory,
                  const std::optional<Field>& yielded);

  const Grid& grid() const { return lower_.grid(); }
  const Surface& lower() const { return lower_; }
  const UpperBody& upper() const { return upper_; }
  Boundary boundary() const { return boundary_; }
  const Pose& pose() const { return pose_; }
  // What events have left on the bodies beside their shapes: all of it, and the memory of one name (empty
  // where there is none).
  const BodyMemory& memory() const { return memory_; }
  const NodeMemory& kept(std::string_view name) const;
  bool upper_is_flat() const { return std::holds_alternative<Material>(upper_); }

  // m; NaN at nodes where nothing faces the lower body. The two functions below leave such nodes out.
  const Field& combined() const { return combined_ ? *combined_ : lower_.heights(); }
  Range combined_range() const { return range_; }          // m
  double peak_to_valley() const { return range_.span(); }  // m
  // m, the greatest combined height of the bodies as they lay before any event changed their shapes.
  double first_touch() const { return first_touch_.value_or(range_.max); }
  void keep_first_touch(const ContactGeometry& before) { first_touch_ = before.first_touch_; }
  // The combined heights at the nodes where the bodies face each other, in the order of the nodes.
  Array<double> facing_heights() const;
  // The nodes at which the bodies face each other; all, unless a free boundary lets one body overhang.
  std::int64_t facing() const { return facing_; }
  bool overhangs() const { return facing_ < static_cast<std::int64_t>(grid().nodes()); }
  double overlap_fraction() const {
    return static_cast<double>(facing_) / static_cast<double>(grid().nodes());
  }

 private:
  Surface lower_;
  UpperBody upper_;
  Boundary boundary_;
  Pose pose_;
  BodyMemory memory_;
  std::shared_ptr<const Field> combined_;  // none under a flat
  Range range_;
  std::optional<double> first_touch_;  // none while the bodies are unworn
  std::int64_t facing_ = 0;
};

// The material of a body, if it has one.
const Material* lower_material(const Surface& lower);
const Material* upper_material(const UpperBody& upper);

}  // namespace asperity
