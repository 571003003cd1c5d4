// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/friction/interlocking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Least normal stress of a capped junction; the same test as on level junctions.
double stress_at_cap(const JunctionLaw& law) {
  if (!law.tau_max()) return infinite;
  const double room = *law.tau_max() - law.tau0();
  if (room <= 0) return 0;
  return law.alpha() > 0 ? room / law.alpha() : infinite;
}

struct Neighbours {
  int before, after, steps;
};
Neighbours neighbours(int k, int n, bool wraps) {
  if (wraps) return {k > 0 ? k - 1 : n - 1, k < n - 1 ? k + 1 : 0, 2};
  const int before = std::max(0, k - 1), after = std::min(n - 1, k + 1);
  return {before, after, std::max(1, after - before)};
}

// Neighbours with heights; overhanging bodies are on a free boundary, which does not wrap.
template <class There>
Neighbours inside(Neighbours all, int k, There there) {
  if (!there(all.before)) all.before = k;
  if (!there(all.after)) all.after = k;
  return {all.before, all.after, std::max(1, all.after - all.before)};
}

}  // namespace

InclinedJunction inclined_junction(const JunctionLaw& law, double pressure, double along, double across) {
  const double rise = 1 + along * along;
  const double widening = std::sqrt(1 + across * across / rise);
  const double wedge = along * widening;  // normal stress per shear
  InclinedJunction result;
  const auto with = [&](double shear) { return along * pressure + rise * widening * shear; };
  if (along == 0 && across == 0) {
    // The number of the law itself: level bodies give the result without the effect.
    result.force = law.strength(pressure);
    result.capped = pressure >= stress_at_cap(law);
    return result;
  }
  if (law.tau_max() && pressure + wedge * *law.tau_max() >= stress_at_cap(law)) {
    result.capped = true;
    result.force = with(*law.tau_max());
    return result;
  }
  const double room = 1 - wedge * law.alpha();
  if (!(room > 0)) {
    result.locks = true;
    result.force = infinite;
    return result;
  }
  double shear = (law.tau0() + law.alpha() * pressure) / room;
  if (wedge < 0) shear = std::min(shear, pressure / -wedge);
  result.force = with(shear);
  return result;
}

Slopes junction_slopes(const State& state) {
  const Grid& grid = state.geometry().grid();
  const bool wraps = state.geometry().boundary() == Boundary::periodic;
  const Surface lower = state.deformed("lower");
  const std::shared_ptr<const Field> gap = state.field("gap");
  Field middle(grid.nx, grid.ny);
  for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = lower.heights()[k] + 0.5 * (*gap)[k];
  Slopes slopes{Field(grid.nx, grid.ny), Field(grid.nx, grid.ny)};
  const bool overhangs = state.geometry().overhangs();
  for (int j = 0; j < grid.ny; ++j) {
    const Neighbours rows = neighbours(j, grid.ny, wraps);
    for (int i = 0; i < grid.nx; ++i) {
      const Neighbours columns = neighbours(i, grid.nx, wraps);
      Neighbours across = columns, along = rows;
      if (overhangs) {  // a missing counterpart is a rim
        if (std::isnan(middle(i, j))) continue;
        across = inside(columns, i, [&](int k) { return !std::isnan(middle(k, j)); });
        along = inside(rows, j, [&](int k) { return !std::isnan(middle(i, k)); });
      }
      slopes.x(i, j) = (middle(across.after, j) - middle(across.before, j)) / (across.steps * grid.hx());
      slopes.y(i, j) = (middle(i, along.after) - middle(i, along.before)) / (along.steps * grid.hy());
    }
  }
  return slopes;
}

InterlockedJunctions interlock(const JunctionLaw& law, const State& state,
                               const InterlockingOptions& options) {
  InterlockedJunctions result;
  if (state.contacts() == 0) return result;
  const Slopes slopes = junction_slopes(state);
  const std::shared_ptr<const Field> pressure = state.field("pressure");
  const double c = elementary::cos(options.direction), s = elementary::sin(options.direction);
  Field extra(pressure->nx(), pressure->ny());
  std::int64_t capped = 0, locked = 0;
  for (std::size_t k = 0; k < extra.size(); ++k) {
    const double p = (*pressure)[k];
    if (!(p > 0)) continue;
    const double along = c * slopes.x[k] + s * slopes.y[k], across = c * slopes.y[k] - s * slopes.x[k];
    const InclinedJunction junction = inclined_junction(law, p, along, across);
    capped += junction.capped ? 1 : 0;
    locked += junction.locks ? 1 : 0;
    extra[k] = junction.force - law.strength(p);
  }
  if (locked > 0)
    throw Error(ErrorCode::bad_state,
                std::to_string(locked) + " of " + std::to_string(state.contacts()) +
                    " junctions are so steep that they lock: slope times `alpha` is one or more, and no "
                    "force moves them along their slope",
                "give the law a `tau_max`, at which they shear off");
  result.extra_force = block_sum(extra.values()) * state.geometry().grid().cell_area();
  result.capped_fraction = static_cast<double>(capped) / static_cast<double>(state.contacts());
  return result;
}

}  // namespace asperity
