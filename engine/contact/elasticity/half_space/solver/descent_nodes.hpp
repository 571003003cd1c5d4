// SPDX-License-Identifier: GPL-3.0-or-later
// One node of a set descent, as the loops over the nodes see it: its fields by plain pointers and the law of
// its pressure by value, small enough to be taken along into every loop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/contact/elasticity/half_space/operator/lane_terms.hpp"
#include "engine/contact/elasticity/half_space/solver/free_set.hpp"

namespace asperity {

template <class Limit>
struct DescentNodes {
  double *pressure, *gap;
  std::uint8_t* free;
  Limit limit;
  double balance;

  double settled(std::size_t k) const { return limit.settle(k, pressure[k], gap[k], balance); }
  // The gap of a free node with the opening it would have if it went on yielding, or not, as marked.
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
  // Whether pressure q, settled, belongs to the elastic interior, which is shifted to the load.
  bool shifts(std::size_t k, [[maybe_unused]] double q, [[maybe_unused]] bool any_interior) const {
    if constexpr (Limit::hardens)
      return q > 0 && (q < limit.yields_at(k) || !any_interior);
    else  // the same of the pressure as of q, without waiting for it
      return (pressure[k] > 0) & (pressure[k] < limit.upper());
  }
};

// gap += unit · image, the image of a stretch of nodes from `begin`. The sum of the total gaps of those that
// balance the load.
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

// Of a stretch of nodes from `begin`, `image` being what K makes of `direction` there, kept in `to`: the sum
// of their products, that of the image with the opening of ground that yields over those that balance the
// load, and, of ground that does not harden, that of the direction with what gaps lack of `mean`.
template <class Limit, class Stored>
std::array<double, 3> weigh_image(const DescentNodes<Limit>& nodes, std::size_t begin, std::size_t end,
                                  Freedom balancing, double mean, const Stored* direction,
                                  const double* image, double* to) {
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

}  // namespace asperity
