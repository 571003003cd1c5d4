// SPDX-License-Identifier: GPL-3.0-or-later
// Interlocking: the slopes of two rough bodies add to the angle of friction of their junctions. No term of
// the normal problem, only the direction that friction is asked for along. What the slopes do is in
// friction/interlocking.hpp.
#pragma once

#include "engine/contact/effect.hpp"

namespace asperity {

struct InterlockingOptions {
  // rad, counter-clockwise from x seen from above the lower body: the way the upper body is pushed over it.
  double direction = 0;
  static const Effect& effect();
};

}  // namespace asperity
