// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/friction/tilt_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

std::string degrees(double angle) { return format_short(angle * 180 / std::numbers::pi) + " deg"; }

void check_stage(double step, double limit) {
  require_positive("step", step, "rad");
  // Degrees may convert to an ulp past a right angle.
  if (!(limit > 0 && limit <= right_angle * (1 + 1e-12)))
    refuse("`limit` is " + degrees(limit), "a stage is raised to at most 90 deg");
  constexpr double most_steps = 1e6;
  if (limit / step > most_steps)
    refuse("`step` is " + degrees(step) + ", over a million steps to the `limit` of " + degrees(limit),
           "give a coarser step: the exact angle does not depend on it");
}

}  // namespace

void check(const TiltOptions& options) {
  require_positive("mass", options.mass, "kg");
  require_positive("gravity", options.gravity, "m/s^2");
  check_stage(options.step, options.limit);
}

SlipAngle slip_angle(const FrictionForce& friction, double weight, double step, double limit) {
  require_positive("weight", weight, "N");
  check_stage(step, limit);
  limit = std::min(limit, right_angle);
  auto holds = [&](double angle) {
    const double force = friction(weight * elementary::cos(angle));
    if (!(force >= 0 && std::isfinite(force)))
      refuse("the friction force at " + degrees(angle) + " is " + format_short(force) + " N",
             "it must be finite and not negative");
    return force >= weight * elementary::sin(angle);
  };

  double held = 0;
  // Multiples, not sums, snapped to the limit: rounding does not accumulate.
  for (std::int64_t k = 0;; ++k) {
    stop_flag().check();
    const double reached = static_cast<double>(k) * step;
    const bool last = reached >= limit * (1 - 1e-12);
    const double angle = last ? limit : reached;
    if (!holds(angle)) {
      double low = held, high = angle;
      // To neighbouring doubles: under sixty halvings.
      for (;;) {
        const double middle = low + 0.5 * (high - low);
        if (!(low < middle && middle < high)) break;
        (holds(middle) ? low : high) = middle;
      }
      // A slip angle negligible to the step is mu = 0.
      constexpr double nothing = 1e-3;
      if (held == 0 && low > nothing * step)
        refuse("`step` is " + degrees(step) + ", above the angle of slip of " + degrees(low) +
                   ": no step would be held, and mu would be 0",
               "give a finer step, such as \"0.1 deg\"; a number without a unit is in radians");
      return {low, held, true};
    }
    held = angle;
    if (last) return {limit, limit, false};
  }
}

SlipAngle slip_angle(const FrictionForce& friction, const TiltOptions& options) {
  check(options);
  return slip_angle(friction, options.mass * options.gravity, options.step, options.limit);
}

}  // namespace asperity
