// SPDX-License-Identifier: GPL-3.0-or-later
// What limits the contact pressure: nothing; a cap, p <= H, perfectly plastic; or linear hardening, where
// a node whose pressure passes its yield pressure Y gives way by w = (p − Y)/K_h beyond its elastic
// displacement, the energy term Σ max(0, p − Y)²/(2 K_h). K_h -> 0 is the cap again, K_h -> ∞ no yield.
// Once in SI, as a problem has it, and once in the cell units of a solve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <variant>

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

// The two laws that limit a pressure, in the cell units of a solve and small enough to vanish in a loop:
// a cap (infinite for the elastic contact), or linear hardening past a yield pressure of each node, which
// adds an opening of its own to the gap and leaves the pressure without an upper bound. `settle` is what
// a descent does to a pressure that left its bounds: clipped to the cap, or, where it went past the
// yield pressure as if elastic, brought to where the node by itself would be in balance.
struct PressureCap {
  double cap = std::numeric_limits<double>::infinity();

  static constexpr bool hardens = false;
  double upper() const { return cap; }
  // w at node k under pressure p, and dw/dp of a node that yields.
  double opening(std::size_t, double) const { return 0; }
  double yielding_slope() const { return 0; }
  // p without overshoot; g is the gap without w, `balance` the gap of the nodes in contact (NaN: unknown).
  double settle(std::size_t, double p, double, double) const {
    const double positive = p > 0 ? p : 0.0;
    return p < cap ? positive : cap;
  }
};

struct LinearHardening {
  const double* yield = nullptr;  // per node, or null for `uniform`
  double uniform = 0;
  double factor = 1;      // from the units of `yield` to cell units
  double compliance = 0;  // dw/dp

  static constexpr bool hardens = true;
  // Of one cell by itself, about.
  static constexpr double own_compliance = 1.27;
  double upper() const { return std::numeric_limits<double>::infinity(); }
  double yields_at(std::size_t k) const { return yield ? yield[k] * factor : uniform; }
  double opening(std::size_t k, double p) const { return compliance * std::max(0.0, p - yields_at(k)); }
  double yielding_slope() const { return compliance; }
  double settle(std::size_t k, double p, double g, double balance) const {
    if (p <= 0) return 0;
    const double past = p - yields_at(k);
    if (past <= 0 || std::isnan(balance)) return p;
    const double settled = (balance - g + own_compliance * past) / (compliance + own_compliance);
    return settled < 0.5 * past ? yields_at(k) + std::max(0.0, settled) : p;
  }
};

using PressureLimit = std::variant<PressureCap, LinearHardening>;

// The bound that no pressure passes.
inline double greatest_pressure(const PressureLimit& limit) {
  return std::visit([](const auto& law) { return law.upper(); }, limit);
}

}  // namespace asperity
