// SPDX-License-Identifier: GPL-3.0-or-later
// A contact on an elastic layer: what a scene may ask of one, and what it adds to a plan. The layer is the
// lower body, of its material, on a rigid base; what presses on it is rigid. The solver is that of the
// half-space with another multiplier (elastic_layer.hpp).
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

// Throws Error{bad_value} for a thickness that is no length above zero, a boundary that is not periodic, a
// lower body that is rigid or an upper one that is not, and beside an effect that is not computed on a layer.
void check_layer(const LayerOptions& options, const Scene& scene);

// As plan_half_space, with the layer in the operator, in the sentence and in what a solve holds. Throws what
// that does.
void plan_layer(const LayerOptions& options, const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
