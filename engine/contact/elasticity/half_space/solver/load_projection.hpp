// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest pressures within their bounds that carry the load: p = clip(y + λ, 0, H), Σ p = load, by
// safeguarded Newton steps for λ; optionally λ moves only some nodes. Also line loads of long cells: at
// aspect 100 an error of the load of a line (along the short side) moves the line 100 times further than an
// error within it. Settling clips single pressures, so each line is shifted back to its former load.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

// `target` may be `y`. `shift_where`: 1 where λ moves a node; empty for all. 0 and H are exact, Σ p = load to
// a few ulps. Returns false, `target` untouched, if marked nodes cannot carry the load. Requires 0 <= load <=
// upper·nodes.
bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> shift_where, double upper,
                     double load, std::span<double> target);

struct LoadAtShift {
  double load;      // Σ clip(y + λ)
  double interior;  // moved nodes between the bounds
  double values;    // Σ y over them
  double bound;     // of moved nodes at the upper bound
};

struct LoadShift {
  double low, high;  // last bracket of λ
  double at;         // λ with the nearest load
  bool found;        // load right to rounding
};

// Safeguarded Newton steps for λ in `low` … `high`. `fixed`: load of unmoved nodes. `carried(λ)`: a
// LoadAtShift. `by_excess`: also steps finer than the sums resolve.
template <class Of>
LoadShift find_load_shift(double low, double high, double origin, double load, double fixed, bool by_excess,
                          const Of& carried) {
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon(), noticed = 1e-13;
  double shift = std::clamp(origin, low, std::max(low, high));
  double best = std::numeric_limits<double>::infinity(), best_shift = shift;
  for (int step = 0; step < 200; ++step) {
    const LoadAtShift at = carried(shift);
    const double excess = at.load - load;
    if (std::abs(excess) < best) {
      best = std::abs(excess);
      best_shift = shift;
    }
    if (std::abs(excess) <= round_off * load) break;
    (excess > 0 ? high : low) = shift;
    // Without cancellation; otherwise by the excess.
    double next = (load - fixed - at.bound - at.values) / at.interior;
    if (by_excess && !(next > low && next < high)) next = shift - excess / at.interior;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == shift || !(next > low && next < high)) break;
    shift = next;
  }
  return {low, high, best_shift, best <= noticed * load};
}

namespace load_projection {

struct Everywhere {
  bool operator()(std::size_t) const { return true; }
};
struct Somewhere {
  const std::uint8_t* marks;
  bool operator()(std::size_t k) const { return marks[k] != 0; }
};

template <class Level, class Where>
LoadAtShift carried(Level& level, const double* y, Where where, double upper, double origin, double shift) {
  enum { load, interior, values, bound };
  const auto sums = level.template over<4>([=](std::size_t k, double* v) {
    const bool here = where(k);
    const double value = y[k] - (here ? origin : 0.0), x = value + (here ? shift : 0.0);
    const bool inside = here & (x > 0) & (x < upper);
    v[load] = std::min(std::max(x, 0.0), upper);
    v[interior] = inside ? 1.0 : 0.0;
    v[values] = inside ? value : 0.0;
    v[bound] = (here & (x >= upper)) ? upper : 0.0;
  });
  return {sums[load], sums[interior], sums[values], sums[bound]};
}

template <class Level, class Where>
bool project(Level& level, const double* y, Where where, double upper, double load, bool by_excess,
             double* target) {
  constexpr bool all = std::is_same_v<Where, Everywhere>;
  enum { count, unmoved_load, lowest, highest };
  const auto moved = level.template over<2, 2>([=](std::size_t k, double* v) {
    const bool here = where(k);
    const double value = y[k], within = std::min(std::max(value, 0.0), upper);
    v[count] = here ? 1.0 : 0.0;
    v[unmoved_load] = here ? 0.0 : within;
    v[lowest] = here ? value : std::numeric_limits<double>::infinity();
    v[highest] = here ? -value : std::numeric_limits<double>::infinity();
  });
  const double movable = moved[count], fixed = moved[unmoved_load];
  if (movable == 0 || load < fixed || load > fixed + upper * movable) return false;
  if (load == fixed + upper * movable) {
    if (!all) return false;
    level.each([=](std::size_t k) { target[k] = upper; });
    return true;
  }
  if (!all && load == fixed) return false;

  // From all moved nodes at 0 to all at the bound, or one with the whole load. Small loads count shifts from
  // the greatest value: rounding must not decide the few contacts.
  const double greatest = -moved[highest], origin = load - fixed < 1e-6 * std::abs(greatest) ? greatest : 0.0;
  const auto carried_at = [&](double shift) { return carried(level, y, where, upper, origin, shift); };
  const auto [low, high, at, found] =
      find_load_shift(origin - greatest, std::min(upper, load) - (moved[lowest] - origin), origin, load,
                      fixed, by_excess, carried_at);
  const auto clipped = [=](std::size_t k, double by) {
    const bool here = where(k);
    const double x = (y[k] - (here ? origin : 0.0)) + (here ? by : 0.0);
    return std::min(std::max(x, 0.0), upper);
  };
  if (found) {
    level.each([=, by = at](std::size_t k) { target[k] = clipped(k, by); });
    return true;
  }
  // Huge values: neighbouring shifts carry too little and too much.
  const double least = carried_at(low).load, most = carried_at(high).load;
  const double share = most > least ? std::clamp((load - least) / (most - least), 0.0, 1.0) : 0.0;
  level.each([=, low = low, high = high](std::size_t k) {
    const double from = clipped(k, low);
    target[k] = from + share * (clipped(k, high) - from);
  });
  return true;
}

}  // namespace load_projection

// Over the nodes of `level` (AllNodes, SlabLevel). `marks`: null for all.
template <class Level>
bool project_to_load(Level& level, const double* y, const std::uint8_t* marks, double upper, double load,
                     bool by_excess, double* target) {
  using namespace load_projection;
  return marks == nullptr ? project(level, y, Everywhere{}, upper, load, by_excess, target)
                          : project(level, y, Somewhere{marks}, upper, load, by_excess, target);
}

// Cells much longer than wide, or vice versa.
bool keeps_line_loads(double aspect);

// Shifts and clips nodes with `where` != 0 until each line carries its load in `before`, if possible.
// `settled` is in 0 … upper. O(n).
void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled);

}  // namespace asperity
