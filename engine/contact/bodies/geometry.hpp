// SPDX-License-Identifier: GPL-3.0-or-later
// Undeformed contact: combined heights h = z1 + T z2 of the placed bodies. First touch is at the greatest h;
// the gap is max h − h. Nodes without a counterpart have h = NaN, no gap and no load. Under a flat, h is the
// lower body's own field. Immutable; threads may read at once.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/contact/bodies/pose.hpp"
#include "engine/contact/scene/scene.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

class ContactGeometry;

// Named fields of each body in its own frame, moved with the body. Their effect reads them at the lower
// body's nodes (met) and updates them after an event (raised). Null without memory.
struct NodeMemory {
  std::shared_ptr<const Field> lower, upper;
  // After events off the lattice: `upper` at the lower body's nodes, exact until the bodies move.
  std::shared_ptr<const Field> upper_here;

  bool empty() const { return !lower && !upper && !upper_here; }
};

using BodyMemory = std::map<std::string, NodeMemory, std::less<>>;

// At the lower body's nodes; null without memory.
struct MetMemory {
  std::shared_ptr<const Field> lower, upper;
};
// `at_first`: value without a counterpart.
MetMemory met(const ContactGeometry& geometry, const NodeMemory& memory, double at_first);

// After an event with `values` at the lower body's nodes: the greater of old and new. A body without memory
// starts from its `at_first`, or stores none.
NodeMemory raised(const ContactGeometry& geometry, const NodeMemory& before, const Field& values,
                  std::optional<double> lower_at_first, std::optional<double> upper_at_first);

class ContactGeometry {
 public:
  // `scene` after check, placed by `pose`; `memory` in the bodies' own frames. `uncovered`: 1 at additional
  // nodes without a counterpart, or empty. O(n); one field for two rough bodies. Throws Error{bad_value} for
  // overflow of sums of heights or squares, or bodies without overlap.
  ContactGeometry(const Scene& scene, const Pose& pose, BodyMemory memory = {},
                  std::span<const std::uint8_t> uncovered = {});

  // After an event, placed as `before`. `yielded`: m removed from both together, at the lower body's nodes.
  // Off the lattice, mapped shapes are approximate; combined heights fall by exactly `yielded` until the
  // bodies move.
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

  // m; NaN without a counterpart, excluded by the next two functions.
  const Field& combined() const { return combined_ ? *combined_ : lower_.heights(); }
  Range combined_range() const { return range_; }          // m
  double peak_to_valley() const { return range_.span(); }  // m
  // m, before any change of shape.
  double first_touch() const { return first_touch_.value_or(range_.max); }
  void keep_first_touch(const ContactGeometry& before) { first_touch_ = before.first_touch_; }
  Array<double> facing_heights() const;
  // All, unless overhanging a free boundary.
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

// Contact modulus, 1/E* = Σ (1−ν²)/E, and shares of a displacement, as the compliances.

// E*, Pa. Throws Error{bad_state} naming effect and body for a missing property or two rigid bodies: `needs`
// ("the half-space needs `young` and `poisson`"), body, `purpose`; `otherwise` extends the hint.
double contact_modulus(const ContactGeometry& geometry, const std::string& needs, const std::string& purpose,
                       const std::string& otherwise);

// 1/E*; none if a material lacks moduli.
std::optional<double> contact_compliance(const ContactGeometry& geometry);

// A rigid body takes none. Without moduli: a flat none, two rough bodies half each.
double lower_elastic_share(const ContactGeometry& geometry);

}  // namespace asperity
