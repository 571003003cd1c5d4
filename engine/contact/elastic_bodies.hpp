// SPDX-License-Identifier: GPL-3.0-or-later
// Contact modulus of two bodies, 1/E* = Σ (1−ν²)/E, their shares of a displacement (as their compliances),
// and their heights under load in their own frames.
#pragma once

#include <optional>
#include <string>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/plan.hpp"
#include "engine/contact/solution.hpp"

namespace asperity {

// E*, Pa. An error's sentence is `needs` ("the half-space needs `young` and `poisson`"), body and `purpose`;
// `otherwise` extends its hint. Throws Error{bad_state} naming effect and body if a property is missing or
// both bodies are rigid.
double contact_modulus(const ContactGeometry& geometry, const std::string& needs, const std::string& purpose,
                       const std::string& otherwise);

// Share of the lower body; a rigid body takes none. Without moduli a flat takes none, two rough bodies half
// each.
double lower_elastic_share(const ContactGeometry& geometry);

struct Deformation {
  Field displacement;      // m, elastic, of both bodies, as Solution::displacement_field()
  double lower_share = 1;  // of the displacement
  std::optional<PlasticChange> change{};
};

// The planned `yield` is read only with a `change`.
Field lower_heights(const ContactGeometry& geometry, const std::optional<PlannedYield>& yield,
                    const Deformation& deformation);
Field upper_heights(const ContactGeometry& geometry, const std::optional<PlannedYield>& yield,
                    const Deformation& deformation);

}  // namespace asperity
