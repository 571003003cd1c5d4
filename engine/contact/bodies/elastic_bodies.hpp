// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic side of two bodies: their contact modulus, 1/E* = Σ (1−ν²)/E, and how they share a
// displacement, as their compliances. What the operators of elasticity ask of the materials.
#pragma once

#include <string>

#include "engine/contact/bodies/geometry.hpp"

namespace asperity {

// E*, Pa. `needs` begins the sentence of an error ("the half-space needs `young` and `poisson`"),
// `purpose` ends it and `otherwise` is one more way out for its hint; both may be empty. Throws
// Error{bad_state} naming effect and body where a property is missing or both bodies are rigid.
double contact_modulus(const ContactGeometry& geometry, const std::string& needs, const std::string& purpose,
                       const std::string& otherwise);

// The share of an elastic displacement that the lower body takes: a rigid body takes none; where the
// materials do not say, a flat takes none and two rough bodies take half each.
double lower_elastic_share(const ContactGeometry& geometry);

}  // namespace asperity
