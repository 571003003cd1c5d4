// SPDX-License-Identifier: GPL-3.0-or-later
// One node of a set descent, as the loops over the nodes see it: its fields by plain pointers and the law of
// its pressure by value, small enough to be taken along into every loop.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/contact/elasticity/half_space/free_set.hpp"

namespace asperity {

template <class Limit>
struct DescentNodes {
  double *pressure, *gap, *step, *direction;
  float* correction;  // M r, the load not yet kept
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

}  // namespace asperity
