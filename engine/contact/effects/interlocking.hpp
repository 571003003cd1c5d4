// SPDX-License-Identifier: GPL-3.0-or-later
// Interlocking: slopes of two rough bodies add to the friction angle of their junctions
// (friction/interlocking.hpp). No term of the normal problem.
#pragma once

#include "engine/contact/effect.hpp"

namespace asperity {

struct InterlockingOptions {
  // rad, push of the upper body, counter-clockwise from x seen from above the lower body.
  double direction = 0;
  static const Effect& effect();
};

}  // namespace asperity
