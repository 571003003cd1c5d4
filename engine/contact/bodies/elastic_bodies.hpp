// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic side of two bodies: their contact modulus, 1/E* = Σ (1−ν²)/E, and how they share a
// displacement, as their compliances, which the operators of elasticity ask of the materials. And the heights
// of both under load, each in its own frame: less its share of the elastic displacement and of what has
// yielded.
#pragma once

#include <optional>
#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solution.hpp"

namespace asperity {

// E*, Pa. `needs` begins the sentence of an error ("the half-space needs `young` and `poisson`"),
// `purpose` ends it and `otherwise` is one more way out for its hint; both may be empty. Throws
// Error{bad_state} naming effect and body where a property is missing or both bodies are rigid.
double contact_modulus(const ContactGeometry& geometry, const std::string& needs, const std::string& purpose,
                       const std::string& otherwise);

// The share of an elastic displacement that the lower body takes: a rigid body takes none; where the
// materials do not say, a flat takes none and two rough bodies take half each.
double lower_elastic_share(const ContactGeometry& geometry);

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
