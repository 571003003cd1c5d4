// SPDX-License-Identifier: GPL-3.0-or-later
// Limit of the contact pressure: none; a cap, p <= H (perfectly plastic); or linear hardening: past the
// yield pressure Y a node yields by w = (p − Y)/K_h, with energy Σ max(0, p − Y)²/(2 K_h). K_h -> 0: cap;
// K_h -> ∞: elastic. In SI, and in the cell units of a solve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <variant>

#include "engine/core/grid.hpp"

namespace asperity {

// Pressures and hardening are positive.
struct YieldLaw {
  // Pa; without hardening. Infinite: no cap.
  double cap = std::numeric_limits<double>::infinity();
  // Yield pressure of each node, Pa, with hardening; empty: `cap`.
  std::shared_ptr<const Field> yield;
  // K_h, Pa/m; infinite: no hardening.
  double hardening = std::numeric_limits<double>::infinity();

  bool hardens() const { return std::isfinite(hardening) && (yield || std::isfinite(cap)); }
  bool caps() const { return !std::isfinite(hardening) && std::isfinite(cap); }
  double yields_at(std::size_t k) const { return yield ? (*yield)[k] : cap; }
  bool limits() const { return hardens() || caps(); }
};

// Both laws in cell units, for inner loops. Hardening adds an opening w to the gap, without upper bound.
// `settle` clips to the cap, or sets a pressure far past yield to the node's own balance.
struct PressureCap {
  double cap = std::numeric_limits<double>::infinity();

  static constexpr bool hardens = false;
  double upper() const { return cap; }
  // w at node k under p; dw/dp of a yielding node.
  double opening(std::size_t, double) const { return 0; }
  double yielding_slope() const { return 0; }
  // p without overshoot. g: gap without w; `balance`: gap of nodes in contact (NaN: unknown).
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
  // A cell's, approximately.
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

inline double greatest_pressure(const PressureLimit& limit) {
  return std::visit([](const auto& law) { return law.upper(); }, limit);
}

}  // namespace asperity
