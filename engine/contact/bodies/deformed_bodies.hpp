// SPDX-License-Identifier: GPL-3.0-or-later
// The heights of two bodies under load, each in its own frame: less its share of the elastic displacement and
// of what has yielded. What every way of solving does once it knows the two.
#pragma once

#include <optional>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solution.hpp"

namespace asperity {

// What a load does to the bodies beside moving them.
struct Deformation {
  Field displacement;      // m, elastic, of both bodies together; as Solution::displacement_field()
  double lower_share = 1;  // of it that the lower body takes
  std::optional<PlasticChange> change{};
};

// `yield` is of the plan and is read only where something has changed.
Field lower_heights(const ContactGeometry& geometry, const std::optional<PlannedYield>& yield,
                    const Deformation& deformation);
Field upper_heights(const ContactGeometry& geometry, const std::optional<PlannedYield>& yield,
                    const Deformation& deformation);

}  // namespace asperity
