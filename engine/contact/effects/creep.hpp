// SPDX-License-Identifier: GPL-3.0-or-later
// Creep: scales the hardness by the dwell, H(t) = H (1 + b ln(1 + t_ref/t_c)) / (1 + b ln(1 + t/t_c)).
#pragma once

#include "engine/contact/scene/effect.hpp"

namespace asperity {

struct CreepOptions {
  double rate = 0.02;      // b
  double onset = 1;        // t_c, s
  double reference = 600;  // t_ref, s: dwell of the stated hardness
  static const Effect& effect();
};

// H(t)/H; default dwell t_ref.
double softening(const CreepOptions& creep, std::optional<double> dwell);

}  // namespace asperity
