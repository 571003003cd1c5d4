// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure that one element carries at a depth, where it may yield: p = k δ up to its yield pressure Y,
// then Y itself (perfectly plastic) or Y + (δ − Y/k)/(1/k + 1/K_h), the two springs one after the other. A
// rigid element carries Y as soon as it is touched, then Y + K_h δ. Never falls with the depth.
#pragma once

#include <algorithm>
#include <cmath>

namespace asperity {

struct ElementLaw {
  double stiffness = 0;  // k, Pa/m; infinite: rigid
  double hardening = 0;  // K_h, Pa/m; 0: perfectly plastic

  bool rigid() const { return !std::isfinite(stiffness); }
  double depth_at_yield(double yield) const { return yield / stiffness; }  // 0 of a rigid one
  // Pa/m, past the yield pressure.
  double slope_past_yield() const { return hardening == 0 ? 0 : 1 / (1 / stiffness + 1 / hardening); }

  bool touched(double depth) const { return rigid() ? depth >= 0 : depth > 0; }
  bool yields(double depth, double yield) const { return touched(depth) && depth >= depth_at_yield(yield); }
  double pressure(double depth, double yield) const {
    if (!touched(depth)) return 0;
    if (yields(depth, yield)) return yield + slope_past_yield() * (depth - depth_at_yield(yield));
    return std::min(stiffness * depth, yield);
  }
  // What of the shortening stays. From the depth and not from the pressure, in which a weak hardening leaves
  // few digits of it.
  double plastic_part(double depth, double yield) const {
    if (!yields(depth, yield)) return 0;
    const double past = depth - depth_at_yield(yield);
    return hardening == 0 || rigid() ? past : past * (stiffness / (stiffness + hardening));
  }
};

}  // namespace asperity
