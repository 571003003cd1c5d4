// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/constants.hpp"

namespace asperity {

namespace {
template <class Take>
ContactQuality measure_hardening(const ContactLevel& level, const LinearHardening& limit, std::size_t nodes,
                                 double balance, Take take) {
  enum { interior, interior_gap, plastic, plastic_gap, load, energy, settled, least_gap, least_open, loaded };
  const auto found = over_nodes<7, 3>(nodes, [=, limit = limit](std::size_t k, double* v) {
    double pressure, elastic_gap;
    take(k, pressure, elastic_gap);
    const double q = limit.settle(k, pressure, elastic_gap, balance);
    const double opening = limit.opening(k, q), gap = elastic_gap + opening;
    const bool yields = opening > 0, open = q <= 0, inside = !open & !yields;
    v[interior] = inside ? 1.0 : 0.0;
    v[interior_gap] = inside ? gap : 0.0;
    v[plastic] = yields ? 1.0 : 0.0;
    v[plastic_gap] = yields ? gap : 0.0;
    v[load] = q;
    v[energy] = q * gap;
    v[settled] = q != pressure ? 1.0 : 0.0;
    v[least_gap] = gap;
    v[least_open] = open ? gap : infinity;
    v[loaded] = open ? infinity : -gap;
  });
  ContactQuality quality;
  quality.interior = found[interior];
  quality.load = found[load];
  quality.within = found[settled] == 0;
  if (found[interior] > 0)
    quality.interior_gap = found[interior_gap] / found[interior];
  else
    quality.interior_gap = found[plastic] > 0 ? found[plastic_gap] / found[plastic]
                                              : contact_measures::middle(found[least_open], -infinity);
  const double weighted = found[energy] / found[load];
  quality.offset = weighted;
  const double below = weighted - found[least_gap];
  const double penetration = std::max(0.0, below) / level.length;
  quality.residual =
      std::max(penetration, contact_measures::open_weight * (-found[loaded] - weighted) / level.length);
  if (std::isnan(below)) quality.residual = infinity;
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
