// SPDX-License-Identifier: GPL-3.0-or-later
// What an elastic half-space adds to a plan: its modulus, how two bodies share the displacement, and what
// a solve holds and costs.
#pragma once

#include "engine/contact/elastic_model.hpp"

namespace asperity {

struct HalfSpaceOptions {
  static const ElasticModel& model();
};

// Fills operator, term, buffers, solver name, expected transforms and time. Both bodies need `young` and
// `poisson`, or are rigid, not both. Throws Error{bad_state} naming effect and body.
void plan_half_space(const ContactGeometry& geometry, Plan& plan);

// The solver of a plan whose operator that is, or a layer's.
std::shared_ptr<const Solver> half_space_solver(const Plan& plan,
                                                std::shared_ptr<const ContactGeometry> geometry);

}  // namespace asperity
