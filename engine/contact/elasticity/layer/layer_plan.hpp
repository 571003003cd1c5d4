// SPDX-License-Identifier: GPL-3.0-or-later
// A contact on an elastic layer: what a scene may ask of one, and what it adds to a plan. The layer is the
// lower body, of its material, on a rigid base; what presses on it is rigid. The solver is that of the
// half-space with another multiplier (elastic_layer.hpp).
#pragma once

#include "engine/contact/elastic_model.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"

namespace asperity {

// The material is that of the lower body.
struct LayerOptions {
  double thickness = 0;  // m, > 0
  LayerBase base = LayerBase::bonded;
  static const ElasticModel& model();
};

}  // namespace asperity
