// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/contact_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
// Complementarity averages over the load: a single node in contact may be far off. But where ground that
// yields carries nearly all of the load, the few other nodes fix the offset and with it all that yields: so
// each node's opening counts for itself too, by this much.
constexpr double open_weight = 0.125;

// What one node adds to the sums and minima of measure().
template <class Limit>
void weigh(const Limit& limit, std::size_t k, double p, double g, double balance, double upper, double* v) {
  const double q = limit.settle(k, p, g, balance);
  const double opening = limit.opening(k, q), gap = g + opening;
  bool yields = opening > 0, open = q <= 0, full = q >= upper, settles = q != p;
  if constexpr (!Limit::hardens) {  // the same, in comparisons that do not wait for q
    yields = false;
    open = p <= 0;
    full = p >= upper;
    settles = (p < 0) | (p > upper);
  }
  const bool interior = !open & !full & !yields;
  v[0] = interior ? 1.0 : 0.0;
  v[1] = interior ? gap : 0.0;
  v[2] = yields ? 1.0 : 0.0;
  v[3] = yields ? gap : 0.0;
  v[4] = q;
  v[5] = q * gap;
  v[6] = settles ? 1.0 : 0.0;
  v[7] = gap;
  v[8] = open ? gap : infinity;
  v[9] = full ? -gap : infinity;
  if constexpr (Limit::hardens) v[10] = open ? infinity : -gap;
}

// The same where no pressure is too large, of what tells anything there.
inline void weigh_uncapped(double p, double g, double* v) {
  const bool open = p <= 0;
  const double q = open ? 0.0 : p;
  v[0] = open ? 0.0 : 1.0;
  v[1] = open ? 0.0 : g;
  v[2] = q;
  v[3] = q * g;
  v[4] = p < 0 ? 1.0 : 0.0;
  v[5] = g;
}

template <class Take>
ContactQuality measure_uncapped(const ContactLevel& level, std::size_t nodes, Take take) {
  const auto found = over_nodes<5, 1>(nodes, [=](std::size_t k, double* v) {
    double pressure, gap;
    take(k, pressure, gap);
    weigh_uncapped(pressure, gap, v);
  });
  ContactQuality quality;
  quality.interior = found[0];
  quality.load = found[2];
  quality.settled = found[4];
  quality.within = found[4] == 0;
  quality.interior_gap = found[0] > 0 ? found[1] / found[0] : found[5];
  const double weighted = found[3] / found[2];
  quality.offset = weighted;
  quality.penetration = std::max(0.0, weighted - found[5]) / level.length;
  quality.complementarity = quality.residual = quality.penetration;
  if (!(weighted - found[5] == weighted - found[5])) quality.residual = infinity;
  return quality;
}

// take(k, p, g) gives the pressure and gap of a node.
template <class Limit, class Take>
ContactQuality measure(const ContactLevel& level, const Limit& limit, std::span<const double> p,
                       std::span<const double> g, double balance, Take take) {
  const double upper = limit.upper();
  if constexpr (!Limit::hardens)
    if (!std::isfinite(upper)) return measure_uncapped(level, p.size(), take);
  constexpr std::size_t minima = Limit::hardens ? 4 : 3;
  const auto found = over_nodes<7, minima>(p.size(), [=, limit = limit](std::size_t k, double* v) {
    double pressure, gap;
    take(k, pressure, gap);
    weigh(limit, k, pressure, gap, balance, upper, v);
  });
  ContactQuality quality;
  quality.interior = found[0];
  quality.yielded = found[2];
  quality.load = found[4];
  quality.settled = found[6];
  quality.within = found[6] == 0;
  const double least = found[7], least_open = found[8], greatest_saturated = -found[9];
  if (found[0] > 0)
    quality.interior_gap = found[1] / found[0];
  else if (found[2] > 0)
    quality.interior_gap = found[3] / found[2];
  else if (std::isfinite(least_open) && std::isfinite(greatest_saturated))
    quality.interior_gap = 0.5 * (least_open + greatest_saturated);
  else
    quality.interior_gap = std::isfinite(least_open) ? least_open : greatest_saturated;

  if (!std::isfinite(upper)) {
    const double weighted = found[5] / found[4];
    quality.offset = weighted;
    quality.penetration = std::max(0.0, weighted - least) / level.length;
    quality.complementarity = quality.penetration;
    quality.residual = quality.penetration;
    if constexpr (Limit::hardens)
      quality.residual = std::max(quality.residual, open_weight * (-found[10] - weighted) / level.length);
    if (!(weighted - least == weighted - least)) quality.residual = infinity;
    return quality;
  }
  const double offset = quality.offset = quality.interior_gap;
  const auto apart = over_nodes<1, 2>(p.size(), [=, p = p.data(), g = g.data()](std::size_t k, double* v) {
    const double q = std::min(std::max(p[k], 0.0), upper), gap = g[k] - offset;
    v[0] = (gap > 0 ? q : q - upper) * gap;
    v[1] = q < upper ? gap : infinity;
    v[2] = q > 0 ? -gap : infinity;
  });
  quality.complementarity = apart[0] / (quality.load * level.length);
  quality.penetration = std::isfinite(apart[1]) ? std::max(0.0, -apart[1]) / level.length : 0.0;
  const double open = std::isfinite(apart[2]) ? std::max(0.0, -apart[2]) / level.length : 0.0;
  quality.residual = std::max({quality.complementarity, quality.penetration, open_weight * open});
  if (!(quality.residual == quality.residual)) quality.residual = infinity;
  return quality;
}
}  // namespace

ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g, double balance) {
  const auto take = [p = p.data(), g = g.data()](std::size_t k, double& pressure, double& gap) {
    pressure = p[k];
    gap = g[k];
  };
  return std::visit([&](const auto& limit) { return measure(level, limit, p, g, balance, take); },
                    level.limit);
}

ContactQuality contact_quality(const ContactLevel& level, std::span<double> p, std::span<double> g,
                               const PressureStep& step, double balance) {
  if (step.length == 0) return contact_quality(level, p, g, balance);
  const auto take = [p = p.data(), g = g.data(), d = step.direction.data(), image = step.image.data(),
                     length = step.length](std::size_t k, double& pressure, double& gap) {
    pressure = p[k] = p[k] + length * d[k];
    gap = g[k] = g[k] + length * image[k];
  };
  return std::visit([&](const auto& limit) { return measure(level, limit, p, g, balance, take); },
                    level.limit);
}

}  // namespace asperity
