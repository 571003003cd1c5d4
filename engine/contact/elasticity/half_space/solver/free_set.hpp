// SPDX-License-Identifier: GPL-3.0-or-later
// The free set: nodes strictly between the bounds, and nodes at a bound whose gap pulls them off it, but not
// nodes settled in this pass, whose gap is stale. Free nodes are elastic or yielding (past their yield
// pressure). Also node loops of a descent and the preconditioner on the free set.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

enum Freedom : std::uint8_t {
  fixed,
  elastic,
  yielding,
  settling,  // settle first, then yield
  unmarked   // before the first pass
};

struct FreeSet {
  double elastic_count = 0, yielding_count = 0, settling_count = 0;
  double elastic_gap = 0, yielding_gap = 0;  // Σ total gap
  bool changed = true;
  double yielding_worth = 0;  // load balance per elastic node
  // After a trial shift of the elastic interior; count of nodes within bounds.
  double shifted_load = 0, shifted_count = 0;

  double count() const { return elastic_count + yielding_count; }
  // Else few elastic nodes would take too much load.
  bool elastic_balance() const {
    return elastic_count > 0 && elastic_count >= yielding_worth * yielding_count;
  }
  Freedom balancing() const { return elastic_balance() ? elastic : yielding; }
  double balancing_count() const { return elastic_balance() ? elastic_count : yielding_count; }
  double balancing_gap() const { return elastic_balance() ? elastic_gap : yielding_gap; }
};

namespace free_sums {
enum : std::size_t { count, gaps, changes, shifted_load, shifted_count, elastic_sums };
enum : std::size_t { yielding_count = elastic_sums, settling_count, yielding_gaps, hardening_sums };
}  // namespace free_sums

inline std::array<double, free_sums::elastic_sums> mark_elastic(double upper, double offset, double shift,
                                                                std::span<const double> p,
                                                                std::span<const double> g,
                                                                std::span<const std::uint8_t> before,
                                                                std::span<std::uint8_t> free) {
  using namespace free_sums;
  return over_lanes<elastic_sums>(p.size(), [=, p = p.data(), g = g.data(), before = before.data(),
                                             free = free.data()]<class Value>(std::size_t k, Value* v) {
    Value pressure, gap, old;
    lane_terms::read(p + k, pressure);
    lane_terms::read(g + k, gap);
    lane_terms::read(before + k, old);
    const Value none = {}, one = none + 1.0, at = none + offset;
    const Value below = gap < at ? one : none, opens = pressure >= none ? below : none;
    const Value most = none + upper, above = gap > at ? one : none;
    const Value leaves = pressure <= most ? above : none, not_full = pressure < most ? one : leaves;
    const Value kind = pressure > none ? not_full : opens, within = pressure < most ? one : none;
    const Value inside = pressure > none ? within : none, moved = pressure + inside * shift;
    const Value positive = moved > none ? moved : none, stays = moved > none ? inside : none;
    v[shifted_load] = moved < most ? positive : most;
    v[shifted_count] = moved < most ? stays : none;
    lane_terms::put(kind, free + k);
    v[count] = kind;
    v[gaps] = kind > none ? gap : none;
    v[changes] = kind == old ? none : one;
  });
}

// Sets `free`. Gaps below `offset` leave zero pressure.
template <class Limit>
FreeSet mark_nodes(const Limit& limit, double offset, double balance, double shift, std::span<const double> p,
                   std::span<const double> g, std::span<const std::uint8_t> before,
                   std::span<std::uint8_t> free) {
  using namespace free_sums;
  std::array<double, Limit::hardens ? +hardening_sums : +elastic_sums> sums;
  if constexpr (!Limit::hardens)
    sums = mark_elastic(limit.upper(), offset, shift, p, g, before, free);
  else
    // By value: byte stores may alias references.
    sums =
        over_nodes<hardening_sums>(p.size(), [=, p = p.data(), g = g.data(), before = before.data(),
                                              free = free.data(), limit = limit](std::size_t k, double* v) {
          const double q = limit.settle(k, p[k], g[k], balance);
          const double pressure = p[k], gap = g[k];
          const bool enters = (q <= 0) & (gap < offset) & (pressure >= 0);
          std::uint8_t kind = ((q > 0) | enters) ? elastic : fixed;
          const std::uint8_t past = q != pressure ? settling : yielding;
          kind = pressure > limit.yields_at(k) ? past : kind;
          free[k] = kind;
          v[count] = kind == elastic ? 1.0 : 0.0;
          v[gaps] = kind == elastic ? gap : 0.0;
          v[changes] = kind == before[k] ? 0.0 : 1.0;
          const bool here = (q > 0) & (q < limit.yields_at(k));
          const double moved = q + (here ? shift : 0.0), positive = moved > 0 ? moved : 0.0;
          v[shifted_load] = positive;
          v[shifted_count] = (here & (moved > 0)) ? 1.0 : 0.0;
          const double total_gap = gap + limit.opening(k, q);
          v[yielding_count] = kind == yielding ? 1.0 : 0.0;
          v[settling_count] = kind == settling ? 1.0 : 0.0;
          v[yielding_gaps] = kind == yielding ? total_gap : 0.0;
        });
  FreeSet set;
  set.elastic_count = sums[count];
  set.elastic_gap = sums[gaps];
  set.changed = sums[changes] != 0;
  set.shifted_load = sums[shifted_load];
  set.shifted_count = sums[shifted_count];
  if constexpr (Limit::hardens) {
    set.yielding_count = sums[yielding_count];
    set.settling_count = sums[settling_count];
    set.yielding_gap = sums[yielding_gaps];
    set.yielding_worth = Limit::own_compliance / (limit.yielding_slope() + Limit::own_compliance);
  }
  return set;
}

// About the interior gap. Frees at least the two nodes nearest to leaving their bounds.
template <class Limit>
FreeSet mark_free_set(const Limit& limit, const ContactQuality& at, double balance, double shift,
                      std::span<const double> p, std::span<const double> g,
                      std::span<const std::uint8_t> before, std::span<std::uint8_t> free) {
  const double offset = at.interior_gap;
  FreeSet set = mark_nodes(limit, offset, balance, shift, p, g, before, free);
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

// Plain pointers and the law, copied into each loop.
template <class Limit>
struct DescentNodes {
  double *pressure, *gap;
  std::uint8_t* free;
  Limit limit;
  double balance;

  double settled(std::size_t k) const { return limit.settle(k, pressure[k], gap[k], balance); }
  // With the opening of yielding nodes.
  double total_gap(std::size_t k) const {
    const double elastic_gap = gap[k];
    if constexpr (Limit::hardens) {
      const double opening = limit.compliance * (pressure[k] - limit.yields_at(k));
      return elastic_gap + (free[k] == yielding ? opening : 0.0);
    } else {
      return elastic_gap;
    }
  }
  bool moves(std::size_t k) const {
    if constexpr (Limit::hardens)
      return free[k] == elastic || free[k] == yielding;
    else
      return free[k] != fixed;
  }
  // Whether settled q is in the elastic interior.
  bool shifts(std::size_t k, [[maybe_unused]] double q, [[maybe_unused]] bool any_interior) const {
    if constexpr (Limit::hardens)
      return q > 0 && (q < limit.yields_at(k) || !any_interior);
    else  // as from q, but available earlier
      return (pressure[k] > 0) & (pressure[k] < limit.upper());
  }
};

// gap += unit · image from `begin` on. Returns total gaps of the balancing nodes.
template <class Limit>
std::array<double, 1> take_image(const DescentNodes<Limit>& nodes, std::size_t begin, std::size_t end,
                                 const double* image, double unit, Freedom balancing) {
  const double* const from = image - begin;
  if constexpr (Limit::hardens)
    return over_stretch<1>(begin, end, [=, n = nodes](std::size_t k, double* v) {
      n.gap[k] += from[k] * unit;
      const double gap = n.total_gap(k);
      v[0] = n.free[k] == balancing ? gap : 0.0;
    });
  else
    return over_lanes_of_stretch<1>(begin, end, [=, n = nodes]<class Value>(std::size_t k, Value* v) {
      Value gap, change, mark;
      lane_terms::read(n.gap + k, gap);
      lane_terms::read(from + k, change);
      lane_terms::read(n.free + k, mark);
      const Value none = {};
      gap += change * unit;
      lane_terms::put(gap, n.gap + k);
      v[0] = mark > none ? gap : none;
    });
}

// Σ direction · image (with the opening of yielding nodes), Σ image over balancing nodes and, without
// hardening, Σ direction · (mean − gap).
using ImageSums = std::array<double, 3>;

// Copies `image` = K·direction from `begin` on to `to`.
template <class Limit, class Stored>
ImageSums weigh_image(const DescentNodes<Limit>& nodes, std::size_t begin, std::size_t end, Freedom balancing,
                      double mean, const Stored* direction, const double* image, double* to) {
  const double* const from = image - begin;
  return over_lanes_of_stretch<3>(begin, end, [=, n = nodes]<class Value>(std::size_t k, Value* v) {
    Value d, value, mark;
    lane_terms::read(direction + k, d);
    lane_terms::read(from + k, value);
    lane_terms::put(value, to + k);
    lane_terms::read(n.free + k, mark);
    const Value none = {}, at = none + static_cast<double>(balancing);
    if constexpr (Limit::hardens) {
      const Value yields = none + static_cast<double>(yielding), opening = n.limit.yielding_slope() * d;
      value += mark == yields ? opening : none;
      v[2] = none;
    } else {
      Value gap;
      lane_terms::read(n.gap + k, gap);
      v[2] = d * (mean - gap);
    }
    v[0] = d * value;
    v[1] = mark == at ? value : none;
  });
}

// Restricted |q|/2 on elastic nodes. Soft yielding nodes are independent; stiff ones join, scaled.
template <class Limit>
class SetPreconditioner {
 public:
  SetPreconditioner(ContactLevel& level, const Limit& limit) : level_(level) {
    if constexpr (Limit::hardens) {
      slope_ = limit.yielding_slope();
      // Lines along the short side move as one.
      own_ = Limit::own_compliance * std::max(1.0, level.shape.aspect);
      apart_ = slope_ > stiff_slope * std::sqrt(level.shape.aspect);
      scale_ = std::sqrt(1 / (1 + slope_ / own_));
    }
  }

  void set_free(std::span<const std::uint8_t> free) {
    if constexpr (Limit::hardens) {
      mask_.resize(free.size());
      for_nodes(free.size(), [&](std::size_t k) {
        mask_[k] = free[k] == elastic || (free[k] == yielding && !apart_) ? 1 : 0;
      });
      level_.preconditioner.set_free(mask_);
    } else {
      level_.preconditioner.set_free(free);
    }
  }

  bool apart() const { return apart_; }

  // z = M r in place, load not balanced.
  void apply(std::span<const std::uint8_t> free, std::span<double> z) {
    if constexpr (Limit::hardens) {
      if (apart_) {
        yielding_.resize(z.size());
        const double factor = 1 / (slope_ + own_);
        for_nodes(z.size(), [&](std::size_t k) { yielding_[k] = free[k] == yielding ? z[k] * factor : 0.0; });
        level_.preconditioner.apply(z, z);
        for_nodes(z.size(), [&](std::size_t k) {
          if (free[k] == yielding) z[k] = yielding_[k];
        });
      } else {
        const auto scale = [&](std::size_t k) {
          if (free[k] == yielding) z[k] *= scale_;
        };
        for_nodes(z.size(), scale);
        level_.preconditioner.apply(z, z);
        for_nodes(z.size(), scale);
      }
    } else {
      level_.preconditioner.apply(z, z);
    }
  }

 private:
  // dw/dp in cell units; chosen by steps.
  static constexpr double stiff_slope = 3;

  ContactLevel& level_;
  double slope_ = 0, scale_ = 1, own_ = 1;
  bool apart_ = true;
  Array<std::uint8_t> mask_;
  Array<double> yielding_;
};

}  // namespace asperity
