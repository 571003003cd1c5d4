// SPDX-License-Identifier: GPL-3.0-or-later
// Tilt stage: raised in steps until a specimen of weight W slides, T(W cos θ) = W sin θ with friction T.
// Gives the exact angle and the reading, the last step held.
#pragma once

#include <functional>
#include <numbers>

namespace asperity {

// T(N), N. N > 0; finite, >= 0, may jump.
using FrictionForce = std::function<double(double normal_force)>;

struct TiltOptions {
  double mass = 0;                             // kg, > 0
  double gravity = 9.81;                       // m/s², > 0
  double step = 0.1 * std::numbers::pi / 180;  // rad, > 0; at most a million steps to the limit
  double limit = 0.5 * std::numbers::pi;       // rad, in (0, 90 deg]
};

struct SlipAngle {
  double angle = 0;      // rad, failure to 1e-12; the limit without slip
  double held = 0;       // rad, last step held
  bool slipped = false;  // false: no slip up to the limit
};

// Throws Error{bad_value} naming `mass`, `gravity`, `step` or `limit`.
void check(const TiltOptions& options);

// Balance at k·step for k = 0, 1, … and at the limit; bisects after the first failure. Exact balance holds.
// At 90 deg rounding leaves a positive normal force. Throws Error{bad_value} naming `step` for slip within
// the first step at an angle above 0.
SlipAngle slip_angle(const FrictionForce& friction, double weight, double step, double limit);
SlipAngle slip_angle(const FrictionForce& friction, const TiltOptions& options);

}  // namespace asperity
