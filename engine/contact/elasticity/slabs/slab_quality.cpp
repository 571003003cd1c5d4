// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_quality.hpp"

#include <algorithm>
#include <cmath>

#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/core/constants.hpp"

namespace asperity {

namespace {
// Weight of open nodes, as in half_space/contact_quality.cpp.
constexpr double open_weight = 0.125;

double clipped(double x, double upper) { return std::min(std::max(x, 0.0), upper); }

}  // namespace

SlabQuality slab_quality(SlabLevel& level, std::span<const double> p, std::span<const double> g) {
  const double upper = level.cap;
  const auto found = level.over<5, 3>([=, p = p.data(), g = g.data()](std::size_t k, double* v) {
    const double q = clipped(p[k], upper), gap = g[k];
    const bool open = p[k] <= 0, full = p[k] >= upper, inside = !open & !full;
    v[0] = inside ? 1.0 : 0.0;
    v[1] = inside ? gap : 0.0;
    v[2] = q;
    v[3] = q * gap;
    v[4] = q != p[k] ? 1.0 : 0.0;
    v[5] = gap;
    v[6] = open ? gap : infinity;
    v[7] = full ? -gap : infinity;
  });
  SlabQuality quality;
  quality.interior = found[0];
  quality.load = found[2];
  quality.within = found[4] == 0;
  const double least = found[5], least_open = found[6], greatest_full = -found[7];
  if (!std::isfinite(upper)) {
    const double weighted = found[3] / found[2];
    quality.interior_gap = found[0] > 0 ? found[1] / found[0] : least;
    quality.offset = weighted;
    quality.residual = std::max(0.0, weighted - least) / level.length;
    if (!std::isfinite(weighted - least)) quality.residual = infinity;
    return quality;
  }
  if (found[0] > 0)
    quality.interior_gap = found[1] / found[0];
  else if (std::isfinite(least_open) && std::isfinite(greatest_full))
    quality.interior_gap = 0.5 * (least_open + greatest_full);
  else
    quality.interior_gap = std::isfinite(least_open) ? least_open : greatest_full;
  const double offset = quality.offset = quality.interior_gap;
  const auto apart = level.over<1, 2>([=, p = p.data(), g = g.data()](std::size_t k, double* v) {
    const double q = clipped(p[k], upper), gap = g[k] - offset;
    v[0] = (gap > 0 ? q : q - upper) * gap;
    v[1] = q < upper ? gap : infinity;
    v[2] = q > 0 ? -gap : infinity;
  });
  const double complementarity = apart[0] / (quality.load * level.length);
  const double penetration = std::isfinite(apart[1]) ? std::max(0.0, -apart[1]) / level.length : 0.0;
  const double open = std::isfinite(apart[2]) ? std::max(0.0, -apart[2]) / level.length : 0.0;
  quality.residual = std::max({complementarity, penetration, open_weight * open});
  if (!std::isfinite(quality.residual)) quality.residual = infinity;
  return quality;
}

bool project_slabs_to_load(SlabLevel& level, std::span<const double> y_values, const std::uint8_t* marks,
                           std::span<double> target_values) {
  const double upper = level.cap, load = level.total_load();
  const double* const y = y_values.data();
  double* const target = target_values.data();
  const auto here = [marks](std::size_t k) { return marks == nullptr || marks[k] != 0; };
  const auto moved = level.over<2, 2>([=](std::size_t k, double* v) {
    v[0] = here(k) ? 1.0 : 0.0;
    v[1] = here(k) ? 0.0 : clipped(y[k], upper);
    v[2] = here(k) ? y[k] : infinity;
    v[3] = here(k) ? -y[k] : infinity;
  });
  const double movable = moved[0], fixed = moved[1];
  const bool all = marks == nullptr;
  if (movable == 0 || load < fixed || load > fixed + upper * movable) return false;
  if (load == fixed + upper * movable) {
    if (!all) return false;
    level.each([=](std::size_t k) { target[k] = upper; });
    return true;
  }
  if (!all && load == fixed) return false;

  const double greatest = -moved[3], origin = load - fixed < 1e-6 * std::abs(greatest) ? greatest : 0.0;
  const auto shifted = [=](std::size_t k, double by) {
    return clipped(here(k) ? (y[k] - origin) + by : y[k], upper);
  };
  const auto carried = [&](double by) {
    const auto sums = level.over<4>([=](std::size_t k, double* v) {
      const double value = y[k] - origin, x = here(k) ? value + by : y[k];
      const bool inside = here(k) & (x > 0) & (x < upper);
      v[0] = clipped(x, upper);
      v[1] = inside ? 1.0 : 0.0;
      v[2] = inside ? value : 0.0;
      v[3] = (here(k) & (x >= upper)) ? upper : 0.0;
    });
    return LoadAtShift{sums[0], sums[1], sums[2], sums[3]};
  };
  const auto [low, high, at, found] = find_load_shift(
      origin - greatest, std::min(upper, load) - (moved[2] - origin), origin, load, fixed, false, carried);
  if (found) {
    level.each([=, by = at](std::size_t k) { target[k] = shifted(k, by); });
    return true;
  }
  // The load jumps between neighbouring shifts: interpolate.
  const double least = carried(low).load, most = carried(high).load;
  const double share = most > least ? std::clamp((load - least) / (most - least), 0.0, 1.0) : 0.0;
  level.each([=, low = low, high = high](std::size_t k) {
    const double from = shifted(k, low);
    target[k] = from + share * (shifted(k, high) - from);
  });
  return true;
}

}  // namespace asperity
