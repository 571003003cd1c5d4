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

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

namespace asperity {

// `target` may be `y`. `shift_where`: 1 for nodes that λ moves, empty for all. Values at 0 and H are exact,
// Σ p = load to a few ulps. Returns false, `target` untouched, if the marked nodes cannot carry the load.
// Requires 0 <= load <= upper·nodes.
bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> shift_where, double upper,
                     double load, std::span<double> target);

struct LoadAtShift {
  double load;      // Σ clip(y + λ)
  double interior;  // moved nodes strictly between the bounds
  double values;    // Σ y over them
  double bound;     // load of moved nodes at the upper bound
};

struct LoadShift {
  double low, high;  // last bracket of λ
  double at;         // the λ whose load is nearest
  bool found;        // its load is right to rounding
};

// Safeguarded Newton steps for λ within `low` … `high`. `fixed`: load of unmoved nodes. `carried(λ)`: a
// LoadAtShift. `by_excess`: also steps that resolve finer shifts than the sums.
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

// Cells much longer than wide, or the other way.
bool keeps_line_loads(double aspect);

// Shifts and clips nodes with `where` != 0 until each line carries its load in `before`, if possible.
// `settled` is within 0 … upper. O(n).
void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled);

}  // namespace asperity
