// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes whose pressure is free in a pass: those strictly between the bounds, and those at a bound whose
// gap says they should leave it. A node settled on a bound in this pass may not come back on its stale
// gap. Free nodes are elastic or past their yield pressure; the load is balanced by the elastic ones
// while there are any, for the others hardly move.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/contact_level.hpp"
#include "engine/contact/elasticity/half_space/contact_quality.hpp"
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

  double count() const { return elastic_count + yielding_count; }
  // Who balances the load: a few elastic nodes among many that yield would have to take too much of it.
  bool elastic_balance() const {
    return elastic_count > 0 && elastic_count >= yielding_worth * yielding_count;
  }
  Freedom balancing() const { return elastic_balance() ? elastic : yielding; }
  double balancing_count() const { return elastic_balance() ? elastic_count : yielding_count; }
  double balancing_gap() const { return elastic_balance() ? elastic_gap : yielding_gap; }
};

// Marks `free` with Freedom values, comparing with `before`. At least two nodes are free, the nearest to
// leaving their bound if need be.
template <class Limit>
FreeSet mark_free_set(const Limit& limit, const ContactQuality& at, double balance, std::span<const double> p,
                      std::span<const double> g, std::span<const std::uint8_t> before,
                      std::span<std::uint8_t> free) {
  const double upper = limit.upper(), offset = at.interior_gap;
  // By value: a store of a byte could change anything that is reached by a reference.
  const auto sums = over_nodes<6>(p.size(), [=, p = p.data(), g = g.data(), before = before.data(),
                                             free = free.data(), limit = limit](std::size_t k, double* v) {
    const double q = limit.settle(k, p[k], g[k], balance);
    const double pressure = p[k], gap = g[k];
    const bool inside = (q > 0) & (q < upper);
    const bool enters =
        ((q <= 0) & (gap < offset) & (pressure >= 0)) | ((q > 0) & (gap > offset) & (pressure <= upper));
    std::uint8_t kind = (inside | enters) ? elastic : fixed;
    if constexpr (Limit::hardens) {
      const std::uint8_t past = q != pressure ? settling : yielding;
      kind = pressure > limit.yields_at(k) ? past : kind;
    }
    free[k] = kind;
    v[0] = kind == elastic ? 1.0 : 0.0;
    v[1] = kind == yielding ? 1.0 : 0.0;
    v[2] = kind == settling ? 1.0 : 0.0;
    v[3] = kind == before[k] ? 0.0 : 1.0;
    const double total_gap = gap + limit.opening(k, q);
    v[4] = kind == elastic ? gap : 0.0;
    v[5] = kind == yielding ? total_gap : 0.0;
  });
  FreeSet set{sums[0], sums[1], sums[2], sums[4], sums[5], sums[3] != 0};
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
