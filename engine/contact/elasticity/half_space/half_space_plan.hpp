// SPDX-License-Identifier: GPL-3.0-or-later
// Plan of an elastic half-space: modulus, split of the displacement, memory and cost.
#pragma once

#include "engine/contact/scene/elastic_model.hpp"

namespace asperity {

struct HalfSpaceOptions {
  static const ElasticModel& model();
};

// Fills the plan. Each body needs `young` and `poisson` or is rigid, not both rigid. Throws Error{bad_state}
// naming effect and body.
void plan_half_space(const ContactGeometry& geometry, Plan& plan);

std::shared_ptr<const Solver> half_space_solver(const Plan& plan,
                                                std::shared_ptr<const ContactGeometry> geometry);

}  // namespace asperity
