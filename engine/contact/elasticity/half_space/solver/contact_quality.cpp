// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/constants.hpp"

namespace asperity {

namespace {
void weigh(const LinearHardening& limit, std::size_t k, double p, double g, double balance, double* v) {
  const double q = limit.settle(k, p, g, balance);
  const double opening = limit.opening(k, q), gap = g + opening;
  const bool yields = opening > 0, open = q <= 0, interior = !open & !yields;
  v[0] = interior ? 1.0 : 0.0;
  v[1] = interior ? gap : 0.0;
  v[2] = yields ? 1.0 : 0.0;
  v[3] = yields ? gap : 0.0;
  v[4] = q;
  v[5] = q * gap;
  v[6] = q != p ? 1.0 : 0.0;
  v[7] = gap;
  v[8] = open ? gap : infinity;
  v[9] = open ? infinity : -gap;
}

template <class Take>
ContactQuality measure_hardening(const ContactLevel& level, const LinearHardening& limit, std::size_t nodes,
                                 double balance, Take take) {
  const auto found = over_nodes<7, 3>(nodes, [=, limit = limit](std::size_t k, double* v) {
    double pressure, gap;
    take(k, pressure, gap);
    weigh(limit, k, pressure, gap, balance, v);
  });
  ContactQuality quality;
  quality.interior = found[0];
  quality.load = found[4];
  quality.within = found[6] == 0;
  if (found[0] > 0)
    quality.interior_gap = found[1] / found[0];
  else
    quality.interior_gap = found[2] > 0 ? found[3] / found[2] : contact_measures::middle(found[8], -infinity);
  const double weighted = found[5] / found[4];
  quality.offset = weighted;
  const double penetration = std::max(0.0, weighted - found[7]) / level.length;
  quality.residual =
      std::max(penetration, contact_measures::open_weight * (-found[9] - weighted) / level.length);
  if (!(weighted - found[7] == weighted - found[7])) quality.residual = infinity;
  return quality;
}

// take(k, p, g): pressure and gap of a node or vector of nodes.
template <class Limit, class Take>
ContactQuality measure(const ContactLevel& level, const Limit& limit, std::span<const double> p,
                       std::span<const double> g, double balance, Take take) {
  if constexpr (Limit::hardens)
    return measure_hardening(level, limit, p.size(), balance, take);
  else
    return contact_measures::measure_bounded(level, limit.upper(), {p.data(), g.data()}, take);
}
}  // namespace

ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g, double balance) {
  return std::visit(
      [&](const auto& limit) {
        return measure(level, limit, p, g, balance, contact_measures::AsStored{p.data(), g.data()});
      },
      level.limit);
}

template <class Stored>
ContactQuality contact_quality(const ContactLevel& level, std::span<double> p, std::span<double> g,
                               const PressureStep<Stored>& step, double balance) {
  if (step.none()) return contact_quality(level, p, g, balance);
  const auto take = [p = p.data(), g = g.data(), step]<class Value>(
                        std::size_t k, Value& pressure, Value& gap) { step.take(k, p, g, pressure, gap); };
  return std::visit([&](const auto& limit) { return measure(level, limit, p, g, balance, take); },
                    level.limit);
}

template ContactQuality contact_quality(const ContactLevel&, std::span<double>, std::span<double>,
                                        const PressureStep<float>&, double);
template ContactQuality contact_quality(const ContactLevel&, std::span<double>, std::span<double>,
                                        const PressureStep<double>&, double);

}  // namespace asperity
