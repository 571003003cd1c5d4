// SPDX-License-Identifier: GPL-3.0-or-later
// A tilt stage: it is raised in steps until the specimen of weight W slides, which is where the
// friction T under the normal force N = W cos θ no longer balances the pull, T(W cos θ) = W sin θ. The
// stage gives both the exact angle and what a person reads, the last step that held. Friction comes
// in as a function of the normal force alone; how a contact answers it is not known here.
#pragma once

#include <functional>
#include <numbers>

namespace asperity {

// T(N), N. N > 0; need not be continuous (real area jumps as nodes touch), must be finite and >= 0.
using FrictionForce = std::function<double(double normal_force)>;

struct TiltOptions {
  double mass = 0;                             // kg, > 0
  double gravity = 9.81;                       // m/s², > 0
  double step = 0.1 * std::numbers::pi / 180;  // rad, > 0; at most a million steps to the limit
  double limit = 0.5 * std::numbers::pi;       // rad, in (0, 90 deg]
};

struct SlipAngle {
  double angle = 0;      // rad, where the balance fails, to 1e-12; the limit if it never does
  double held = 0;       // rad, the last step that held
  bool slipped = false;  // false: it does not slip up to the limit
};

// Throws Error{bad_value} naming `mass`, `gravity`, `step` or `limit`.
void check(const TiltOptions& options);

// The stage stands at k·step for k = 0, 1, … and last at the limit. At each step the balance is tried; in
// the first that fails it is solved for, by halving, between the last step that held and this one. A
// specimen that balances exactly holds. At 90 deg the normal force is the last positive one a double
// gives: a contact is not lost by reaching the limit itself. Throws Error{bad_value} naming `step` where the
// specimen slips within the first step at an angle above 0: no step would be held.
SlipAngle slip_angle(const FrictionForce& friction, double weight, double step, double limit);
SlipAngle slip_angle(const FrictionForce& friction, const TiltOptions& options);

}  // namespace asperity
