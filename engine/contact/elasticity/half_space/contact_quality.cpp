// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/contact_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Limit>
ContactQuality measure(const ContactLevel& level, const Limit& limit, std::span<const double> p,
                       std::span<const double> g, double balance) {
  const double upper = limit.upper();
  const auto found = over_nodes<7, 3>(p.size(), [&](std::size_t k, double* v) {
    const double q = limit.settle(k, p[k], g[k], balance);
    const double opening = limit.opening(k, q), gap = g[k] + opening;
    const bool inside = q > 0 && q<upper, yields = opening> 0;
    v[0] = inside && !yields ? 1.0 : 0.0;
    v[1] = inside && !yields ? gap : 0.0;
    v[2] = yields ? 1.0 : 0.0;
    v[3] = yields ? gap : 0.0;
    v[4] = q;
    v[5] = q * gap;
    v[6] = q == p[k] ? 0.0 : 1.0;
    v[7] = gap;
    v[8] = q <= 0 ? gap : infinity;
    v[9] = q >= upper ? -gap : infinity;
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
    quality.residual = weighted - least == weighted - least ? quality.penetration : infinity;
    return quality;
  }
  const double offset = quality.offset = quality.interior_gap;
  const auto apart = over_nodes<1, 1>(p.size(), [&](std::size_t k, double* v) {
    const double q = std::min(std::max(p[k], 0.0), upper), gap = g[k] - offset;
    v[0] = gap > 0 ? q * gap : (q - upper) * gap;
    v[1] = q < upper ? gap : infinity;
  });
  quality.complementarity = apart[0] / (quality.load * level.length);
  quality.penetration = std::isfinite(apart[1]) ? std::max(0.0, -apart[1]) / level.length : 0.0;
  quality.residual = std::max(quality.complementarity, quality.penetration);
  if (!(quality.residual == quality.residual)) quality.residual = infinity;
  return quality;
}
}  // namespace

ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g, double balance) {
  return std::visit([&](const auto& limit) { return measure(level, limit, p, g, balance); }, level.limit);
}

}  // namespace asperity
