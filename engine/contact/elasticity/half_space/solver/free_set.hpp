// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes whose pressure is free in a pass: those strictly between the bounds, and those at a bound whose
// gap says they should leave it. A node settled on a bound in this pass may not come back on its stale
// gap. Free nodes are elastic or past their yield pressure; the load is balanced by the elastic ones
// while there are any, for the others hardly move.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/operator/lane_terms.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

enum Freedom : std::uint8_t {
  fixed = 0,
  elastic = 1,
  yielding = 2,
  settling = 3,  // went past its yield pressure as if elastic: settled first, yielding afterwards
};

struct FreeSet {
  double elastic_count = 0, yielding_count = 0, settling_count = 0;
  double elastic_gap = 0, yielding_gap = 0;  // Σ of the total gap
  bool changed = true;
  double yielding_worth = 0;  // of a yielding node beside an elastic one, in balancing the load
  // With the settled pressures, those of the elastic interior moved by `shift` and kept within the bounds:
  // the load, and how many were not stopped.
  double shifted_load = 0, shifted_count = 0;

  double count() const { return elastic_count + yielding_count; }
  // Who balances the load: a few elastic nodes among many that yield would have to take too much of it.
  bool elastic_balance() const {
    return elastic_count > 0 && elastic_count >= yielding_worth * yielding_count;
  }
  Freedom balancing() const { return elastic_balance() ? elastic : yielding; }
  double balancing_count() const { return elastic_balance() ? elastic_count : yielding_count; }
  double balancing_gap() const { return elastic_balance() ? elastic_gap : yielding_gap; }
};

// Of ground that does not harden: marks it, and sums free nodes, their gaps, new marks, and of the shift.
inline constexpr std::size_t free_sums = 5;

template <bool capped>
std::array<double, free_sums> mark_elastic(double upper, double offset, double shift,
                                           std::span<const double> p, std::span<const double> g,
                                           std::span<const std::uint8_t> before,
                                           std::span<std::uint8_t> free) {
  return over_lanes<free_sums>(p.size(), [=, p = p.data(), g = g.data(), before = before.data(),
                                          free = free.data()]<class Value>(std::size_t k, Value* v) {
    Value pressure, gap, old;
    lane_terms::read(p + k, pressure);
    lane_terms::read(g + k, gap);
    lane_terms::read(before + k, old);
    const Value none = {}, one = none + 1.0, at = none + offset;
    const Value below = gap < at ? one : none, opens = pressure >= none ? below : none;
    Value kind, inside, moved;
    if constexpr (capped) {
      const Value most = none + upper, above = gap > at ? one : none;
      const Value leaves = pressure <= most ? above : none, not_full = pressure < most ? one : leaves;
      kind = pressure > none ? not_full : opens;
      const Value within = pressure < most ? one : none;
      inside = pressure > none ? within : none;
      moved = pressure + inside * shift;
      const Value positive = moved > none ? moved : none, stays = moved > none ? inside : none;
      v[3] = moved < most ? positive : most;
      v[4] = moved < most ? stays : none;
    } else {
      kind = pressure > none ? one : opens;
      inside = pressure > none ? one : none;
      moved = pressure + inside * shift;
      v[3] = moved > none ? moved : none;
      v[4] = moved > none ? inside : none;
    }
    lane_terms::put(kind, free + k);
    v[0] = kind;
    v[1] = kind > none ? gap : none;
    v[2] = kind == old ? none : one;
  });
}

// Marks `free` with Freedom values, comparing with `before`. At least two nodes are free, the nearest to
// leaving their bound if need be. `shift` is what is tried on the elastic interior.
template <class Limit>
FreeSet mark_free_set(const Limit& limit, const ContactQuality& at, double balance, double shift,
                      std::span<const double> p, std::span<const double> g,
                      std::span<const std::uint8_t> before, std::span<std::uint8_t> free) {
  const double offset = at.interior_gap;
  std::array<double, Limit::hardens ? free_sums + 3 : free_sums> sums;
  if constexpr (!Limit::hardens)
    sums = std::isfinite(limit.upper())
               ? mark_elastic<true>(limit.upper(), offset, shift, p, g, before, free)
               : mark_elastic<false>(limit.upper(), offset, shift, p, g, before, free);
  else
    // By value: a store of a byte could change anything that is reached by a reference.
    sums = over_nodes<free_sums + 3>(p.size(), [=, p = p.data(), g = g.data(), before = before.data(),
                                                free = free.data(), limit = limit](std::size_t k, double* v) {
      const double q = limit.settle(k, p[k], g[k], balance);
      const double pressure = p[k], gap = g[k];
      const bool enters = (q <= 0) & (gap < offset) & (pressure >= 0);
      std::uint8_t kind = ((q > 0) | enters) ? elastic : fixed;
      const std::uint8_t past = q != pressure ? settling : yielding;
      kind = pressure > limit.yields_at(k) ? past : kind;
      free[k] = kind;
      v[0] = kind == elastic ? 1.0 : 0.0;
      v[1] = kind == elastic ? gap : 0.0;
      v[2] = kind == before[k] ? 0.0 : 1.0;
      const bool here = (q > 0) & (q < limit.yields_at(k));
      const double moved = q + (here ? shift : 0.0), positive = moved > 0 ? moved : 0.0;
      v[3] = positive;
      v[4] = (here & (moved > 0)) ? 1.0 : 0.0;
      const double total_gap = gap + limit.opening(k, q);
      v[5] = kind == yielding ? 1.0 : 0.0;
      v[6] = kind == settling ? 1.0 : 0.0;
      v[7] = kind == yielding ? total_gap : 0.0;
    });
  FreeSet set;
  set.elastic_count = sums[0];
  set.elastic_gap = sums[1];
  set.changed = sums[2] != 0;
  set.shifted_load = sums[3];
  set.shifted_count = sums[4];
  if constexpr (Limit::hardens) {
    set.yielding_count = sums[free_sums];
    set.settling_count = sums[free_sums + 1];
    set.yielding_gap = sums[free_sums + 2];
  }
  if constexpr (Limit::hardens)
    set.yielding_worth = Limit::own_compliance / (limit.yielding_slope() + Limit::own_compliance);
  constexpr std::size_t few = 9;
  if (set.count() + set.settling_count >= 2 || p.size() < 2) return set;
  Array<double> distance(p.size());
  for (std::size_t k = 0; k < p.size(); ++k) distance[k] = std::abs(g[k] - offset);
  Array<double> order = distance;
  const std::size_t nth = std::min(few, p.size()) - 1;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(nth), order.end());
  set.changed = true;
  for (std::size_t k = 0; k < p.size(); ++k)
    if (free[k] == fixed && distance[k] <= order[nth]) {
      free[k] = elastic;
      set.elastic_count += 1;
      set.elastic_gap += g[k];
    }
  return set;
}

}  // namespace asperity
