// SPDX-License-Identifier: GPL-3.0-or-later
// Plasticity: the pressure is limited by the hardness of the softer body, and what yields stays flattened.
// Which body gives way, and how a node hardens, is in contact/planned_yield.hpp, which every solver reads.
#pragma once

#include <limits>

#include "engine/contact/effect.hpp"

namespace asperity {

struct PlasticityOptions {
  // Pa, of both bodies; by default each body's own. Infinite: never yields.
  std::optional<double> hardness;
  // K_h, Pa/m: a node that yields by w carries its hardness and K_h·w, and is as hard afterwards. Infinite:
  // none named, the pressure never passes the hardness.
  double hardening = std::numeric_limits<double>::infinity();
  static const Effect& effect();
};

}  // namespace asperity
