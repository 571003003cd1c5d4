// SPDX-License-Identifier: GPL-3.0-or-later
// Plasticity: the softer body's hardness limits the pressure; flattening is permanent
// (contact/planned_yield.hpp).
#pragma once

#include <limits>

#include "engine/contact/scene/effect.hpp"

namespace asperity {

struct PlasticityOptions {
  // Pa, both bodies; default: each body's own. Infinite: no yield.
  std::optional<double> hardness;
  // K_h, Pa/m: a node yielding by w carries hardness + K_h·w, its new hardness. Infinite: a constant cap.
  double hardening = std::numeric_limits<double>::infinity();
  static const Effect& effect();
};

}  // namespace asperity
