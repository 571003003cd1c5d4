// SPDX-License-Identifier: GPL-3.0-or-later
// What limits the contact pressure: nothing; a cap, p <= H, perfectly plastic; or linear hardening, where
// a node whose pressure passes its yield pressure Y gives way by w = (p − Y)/K_h beyond its elastic
// displacement, the energy term Σ max(0, p − Y)²/(2 K_h). K_h -> 0 is the cap again, K_h -> ∞ no yield.
#pragma once

#include <limits>
#include <memory>

#include "engine/core/grid.hpp"

namespace asperity {

struct YieldLaw {
  // Pa, one for all nodes; in force while no hardening is given. Infinite: no cap.
  double cap = std::numeric_limits<double>::infinity();
  // Pa at each node, the pressure at which it begins to yield; only with a finite `hardening`. Where it is
  // empty, `cap` stands for every node.
  std::shared_ptr<const Field> yield;
  // K_h, Pa/m; infinite: none given.
  double hardening = std::numeric_limits<double>::infinity();

  // Whether pressures past the yield pressure are met by linear hardening.
  bool hardens() const;
  // Whether no pressure may pass `cap`.
  bool caps() const;
  // The pressure at which node k begins to yield.
  double yields_at(std::size_t k) const { return yield ? (*yield)[k] : cap; }
  bool limits() const { return hardens() || caps(); }
};

// Throws Error{bad_value} for a cap, yield pressure or hardening that is not positive, a field that is not
// nx × ny, or one given without hardening.
void check(const YieldLaw& law, int nx, int ny);

}  // namespace asperity
