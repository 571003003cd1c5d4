// SPDX-License-Identifier: GPL-3.0-or-later
// Interlocking: slopes of rough bodies add to the friction angle of junctions (friction/interlocking.hpp).
#pragma once

#include "engine/contact/scene/effect.hpp"

namespace asperity {

struct InterlockingOptions {
  // rad, push of the upper body, counter-clockwise from x seen from above.
  double direction = 0;
  static const Effect& effect();
};

}  // namespace asperity
