// SPDX-License-Identifier: GPL-3.0-or-later
// Undeformed contact: combined heights h = z1 + T z2 of the placed bodies. First touch is at the greatest h;
// the gap is max h − h. Nodes without a counterpart have h = NaN, no gap and no load. Under a flat, h is the
// lower body's own field. Immutable; threads may read at once.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "engine/contact/bodies/node_memory.hpp"
#include "engine/contact/bodies/pose.hpp"
#include "engine/contact/scene/scene.hpp"

namespace asperity {

class ContactGeometry {
 public:
  // The bodies of `scene` (after check) placed by `pose`, `memory` in their own frames. `uncovered`: 1 at
  // additional nodes without a counterpart; empty: none. O(n); one field for two rough bodies. Throws
  // Error{bad_value} if sums of heights or squares overflow, or if the bodies do not overlap.
  ContactGeometry(const Scene& scene, const Pose& pose, BodyMemory memory = {},
                  std::span<const std::uint8_t> uncovered = {});

  // The bodies after an event, placed as `before`. `yielded`: m removed from both together, at the nodes of
  // the lower body; none: shapes unchanged. Off the lattice the mapped shapes are approximate, but the
  // combined heights decrease by exactly `yielded` until the bodies move.
  ContactGeometry(const Scene& scene, const ContactGeometry& before, BodyMemory memory,
                  const std::optional<Field>& yielded);

  const Grid& grid() const { return lower_.grid(); }
  const Surface& lower() const { return lower_; }
  const UpperBody& upper() const { return upper_; }
  Boundary boundary() const { return boundary_; }
  const Pose& pose() const { return pose_; }
  // Besides shapes; all, or by name (empty if none).
  const BodyMemory& memory() const { return memory_; }
  const NodeMemory& kept(std::string_view name) const;
  bool upper_is_flat() const { return std::holds_alternative<Material>(upper_); }

  // m; NaN at nodes without a counterpart; the next two functions exclude them.
  const Field& combined() const { return combined_ ? *combined_ : lower_.heights(); }
  Range combined_range() const { return range_; }          // m
  double peak_to_valley() const { return range_.span(); }  // m
  // m, before any event changed the shapes.
  double first_touch() const { return first_touch_.value_or(range_.max); }
  void keep_first_touch(const ContactGeometry& before) { first_touch_ = before.first_touch_; }
  Array<double> facing_heights() const;
  // Fewer than all only with overhang on a free boundary.
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
  std::optional<double> first_touch_;  // none while unworn
  std::int64_t facing_ = 0;
};

// Null without a material.
const Material* lower_material(const Surface& lower);
const Material* upper_material(const UpperBody& upper);

}  // namespace asperity
