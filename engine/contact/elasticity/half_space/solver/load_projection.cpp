// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {
struct Everywhere {
  bool operator()(std::size_t) const { return true; }
};
struct Somewhere {
  const std::uint8_t* marks;
  bool operator()(std::size_t k) const { return marks[k] != 0; }
};

template <class Where>
LoadAtShift carried(std::span<const double> y, Where where, double upper, double origin, double shift) {
  const auto sums = over_nodes<4>(y.size(), [=, y = y.data()](std::size_t k, double* v) {
    const bool here = where(k);
    const double value = y[k] - (here ? origin : 0.0), x = value + (here ? shift : 0.0);
    const bool inside = here & (x > 0) & (x < upper);
    v[0] = std::min(std::max(x, 0.0), upper);
    v[1] = inside ? 1.0 : 0.0;
    v[2] = inside ? value : 0.0;
    v[3] = (here & (x >= upper)) ? upper : 0.0;
  });
  return {sums[0], sums[1], sums[2], sums[3]};
}

template <class Where>
bool project(std::span<const double> y, Where where, double upper, double load, std::span<double> target) {
  constexpr bool all = std::is_same_v<Where, Everywhere>;
  const auto moved = over_nodes<2, 2>(y.size(), [=, y = y.data()](std::size_t k, double* v) {
    const bool here = where(k);
    const double value = y[k], clipped = std::min(std::max(value, 0.0), upper);
    v[0] = here ? 1.0 : 0.0;
    v[1] = here ? 0.0 : clipped;
    v[2] = here ? value : infinity;
    v[3] = here ? -value : infinity;
  });
  const double movable = moved[0], fixed = moved[1];
  if (movable == 0 || load < fixed || load > fixed + upper * movable) return false;
  if (load == fixed + upper * movable) {
    if (!all) return false;
    std::fill(target.begin(), target.end(), upper);
    return true;
  }
  if (!all && load == fixed) return false;

  // From all moved nodes at 0 to all at the bound, or one with the whole load. Shifts for small loads count
  // from the greatest value: rounding must not decide the few nodes in contact.
  const double greatest = -moved[3], origin = load - fixed < 1e-6 * std::abs(greatest) ? greatest : 0.0;
  const auto [low, high, at, found] =
      find_load_shift(origin - greatest, std::min(upper, load) - (moved[2] - origin), origin, load, fixed,
                      true, [&](double shift) { return carried(y, where, upper, origin, shift); });
  const auto clipped = [=, y = y.data()](std::size_t k, double by) {
    const bool here = where(k);
    const double x = (y[k] - (here ? origin : 0.0)) + (here ? by : 0.0);
    return std::min(std::max(x, 0.0), upper);
  };
  if (found) {
    for_nodes(y.size(), [=, target = target.data(), by = at](std::size_t k) { target[k] = clipped(k, by); });
    return true;
  }
  // Huge values: two neighbouring shifts carry too little and too much.
  const double least = carried(y, where, upper, origin, low).load;
  const double most = carried(y, where, upper, origin, high).load;
  const double share = most > least ? std::clamp((load - least) / (most - least), 0.0, 1.0) : 0.0;
  for_nodes(y.size(), [=, target = target.data(), low = low, high = high](std::size_t k) {
    const double from = clipped(k, low);
    target[k] = from + share * (clipped(k, high) - from);
  });
  return true;
}
}  // namespace

bool project_to_load(std::span<const double> y, std::span<const std::uint8_t> where, double upper,
                     double load, std::span<double> target) {
  if (where.empty()) return project(y, Everywhere{}, upper, load, target);
  return project(y, Somewhere{where.data()}, upper, load, target);
}

bool keeps_line_loads(double aspect) {
  constexpr double long_cells = 8;
  return aspect >= long_cells || aspect * long_cells <= 1;
}

void keep_line_loads(const LevelShape& shape, std::span<const double> before,
                     std::span<const std::uint8_t> where, double upper, std::span<double> settled) {
  constexpr int most_steps = 40;
  const bool rows = shape.aspect > 1;
  const auto nx = static_cast<std::size_t>(shape.nx);
  const std::size_t line_step = rows ? nx : 1, node_step = rows ? 1 : nx;
  const auto length = static_cast<std::size_t>(rows ? shape.nx : shape.ny);
  parallel_for(rows ? shape.ny : shape.nx, [&](std::int64_t line) {
    const std::size_t begin = static_cast<std::size_t>(line) * line_step;
    double wanted = 0, bound = 0;
    bool same = true;
    for (std::size_t i = 0, k = begin; i < length; ++i, k += node_step) {
      wanted += before[k];
      if (where[k] == 0) bound += settled[k];
      same = same && before[k] == settled[k];
    }
    if (same) return;
    double shift = 0;
    for (int step = 0; step < most_steps; ++step) {
      double load = bound, inside = 0;
      for (std::size_t i = 0, k = begin; i < length; ++i, k += node_step)
        if (where[k] != 0) {
          const double moved = settled[k] + shift;
          load += std::clamp(moved, 0.0, upper);
          inside += moved > 0 && moved < upper ? 1.0 : 0.0;
        }
      const double next = inside > 0 ? shift + (wanted - load) / inside : shift;
      if (next == shift) break;
      shift = next;
    }
    for (std::size_t i = 0, k = begin; i < length; ++i, k += node_step)
      if (where[k] != 0) settled[k] = std::clamp(settled[k] + shift, 0.0, upper);
  });
}

}  // namespace asperity
