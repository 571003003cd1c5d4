// SPDX-License-Identifier: GPL-3.0-or-later
// Creep: the longer a load dwells, the lower the hardness that limits the pressure, H(t) = H (1 + b ln(1 +
// t_ref/t_c)) / (1 + b ln(1 + t/t_c)). It scales the limit that plasticity gives and costs nothing else.
#pragma once

#include "engine/contact/effect.hpp"

namespace asperity {

struct CreepOptions {
  double rate = 0.02;      // b
  double onset = 1;        // t_c, s
  double reference = 600;  // t_ref, s: the dwell at which the hardness is the stated one
  static const Effect& effect();
};

// H(t)/H; a press that names no dwell lasts t_ref.
double softening(const CreepOptions& creep, std::optional<double> dwell);

}  // namespace asperity
