// SPDX-License-Identifier: GPL-3.0-or-later
// Sorted elements that may yield, under a plane at a mean pressure. With drops g_i below the highest and
// yield pressures Y_i, the mean pressure at depth d sums touched elements (g_i < d) and yielding elements
// (g_i + Y_i/k < d): leading parts of sorted sequences with double-double prefix sums. Bisection finds the
// two neighbouring depths around the requested pressure; mixing their pressures gives it exactly, also for
// rigid elements, whose pressure jumps. No bit depends on the order of the nodes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// p = k δ up to the yield pressure Y, then Y (perfectly plastic) or Y + (δ − Y/k)/(1/k + 1/K_h), two springs
// in series. Rigid: Y at first touch, then Y + K_h δ. Never falls with the depth.
struct ElementLaw {
  double stiffness = 0;  // k, Pa/m; infinite: rigid
  double hardening = 0;  // K_h, Pa/m; 0: perfectly plastic

  bool rigid() const { return !std::isfinite(stiffness); }
  double depth_at_yield(double yield) const { return yield / stiffness; }  // 0 if rigid
  // Pa/m, past the yield pressure.
  double slope_past_yield() const { return hardening == 0 ? 0 : 1 / (1 / stiffness + 1 / hardening); }

  bool touched(double depth) const { return rigid() ? depth >= 0 : depth > 0; }
  bool yields(double depth, double yield) const { return touched(depth) && depth >= depth_at_yield(yield); }
  double pressure(double depth, double yield) const {
    if (!touched(depth)) return 0;
    if (yields(depth, yield)) return yield + slope_past_yield() * (depth - depth_at_yield(yield));
    return std::min(stiffness * depth, yield);
  }
  // With weak hardening the pressure has too few digits.
  double plastic_part(double depth, double yield) const {
    if (!yields(depth, yield)) return 0;
    const double past = depth - depth_at_yield(yield);
    return hardening == 0 || rigid() ? past : past * (stiffness / (stiffness + hardening));
  }
};

// Pressures at `low` plus `share` of the increase up to `high`.
struct RestingPlane {
  double low = 0, high = 0;  // m; the same, or neighbouring doubles
  double share = 1;

  double pressure(const ElementLaw& law, double drop, double yield) const {
    return mixed([&](double plane) { return law.pressure(plane - drop, yield); });
  }
  double plastic_part(const ElementLaw& law, double drop, double yield) const {
    return mixed([&](double plane) { return law.plastic_part(plane - drop, yield); });
  }

 private:
  template <class Function>
  double mixed(Function at) const {
    const double above = at(high);
    if (share == 1) return above;
    const double below = at(low);
    return below + share * (above - below);
  }
};

class YieldingElements {
 public:
  // `sorted` drops must outlive this object.
  YieldingElements(const ElementLaw& law, std::span<const double> sorted, double yield);
  // Copies drops and yields. O(n log n).
  YieldingElements(const ElementLaw& law, std::span<const double> drops, std::span<const double> yields);
  YieldingElements(const YieldingElements&) = delete;
  YieldingElements& operator=(const YieldingElements&) = delete;
  // Other common yield pressure. O(n/256).
  YieldingElements(const YieldingElements& others, double yield);

  const ElementLaw& law() const { return law_; }
  std::size_t size() const { return drops_.size(); }
  double drop(std::size_t k) const { return drops_[k]; }
  double yield(std::size_t k) const { return yields_.empty() ? one_yield_ : yields_[k]; }

  // Pa. O(log n).
  double mean_pressure(double depth) const;
  // Pa, never reached; infinite with hardening.
  double greatest_mean_pressure() const;
  // For mean pressures in (0, greatest). O(log n).
  RestingPlane plane_under(double mean_pressure) const;

  // To about a rounding of the terms.
  template <class Term>
  double sum(Term term) const {
    Accumulator total;
    for (std::size_t k = 0; k < size(); ++k) total.add(term(drop(k), yield(k)));
    return total.value();
  }

  // Besides the sorted drops.
  static std::int64_t bytes(std::size_t elements);

 private:
  class FirstSums {
   public:
    void build(std::span<const double> values);
    Accumulator of(std::span<const double> values, std::size_t count) const;

   private:
    Array<Accumulator> every_block_;
  };
  Accumulator yields_of_first(std::size_t count) const;

  ElementLaw law_;
  double one_yield_ = 0;
  double last_to_yield_ = 0;  // depth at which all yield
  // Sorted by drop; with individual yield pressures, by depth of first yield.
  std::span<const double> drops_;
  std::span<const double> yields_;
  Array<double> own_drops_, own_yields_, by_drop_;
  FirstSums drop_sums_, yield_sums_, by_drop_sums_;
};

}  // namespace asperity
