// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/constants.hpp"

namespace asperity {

namespace {
// Complementarity averages over the load. If yielding nodes carry nearly all load, the few others fix the
// offset and thus the plastic volume.
constexpr double open_weight = 0.125;

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

template <class Value>
void weigh_uncapped(const Value& p, const Value& g, Value* v) {
  const Value none = {}, one = none + 1.0, q = p <= none ? none : p;
  v[0] = p <= none ? none : one;
  v[1] = p <= none ? none : g;
  v[2] = q;
  v[3] = q * g;
  v[4] = p < none ? one : none;
  v[5] = g;
}

template <class Take>
ContactQuality measure_uncapped(const ContactLevel& level, std::size_t nodes, Take take) {
  const auto found = over_lanes<5, 1>(nodes, [=]<class Value>(std::size_t k, Value* v) {
    Value pressure, gap;
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

template <class Value>
void weigh_capped(const Value& p, const Value& g, const Value& upper, Value* v) {
  const Value none = {}, one = none + 1.0, never = none + infinity;
  const Value positive = p > none ? p : none;
  const Value inside = p < upper ? one : none, interior = p > none ? inside : none;
  v[0] = interior;
  v[1] = interior > none ? g : none;
  v[2] = p < upper ? positive : upper;
  const Value too_large = p > upper ? one : none;
  v[3] = p < none ? one : too_large;
  v[4] = p <= none ? g : never;
  v[5] = p >= upper ? -g : never;
}

// Without an elastic interior.
double middle(double least_open, double greatest_saturated) {
  if (std::isfinite(least_open) && std::isfinite(greatest_saturated))
    return 0.5 * (least_open + greatest_saturated);
  return std::isfinite(least_open) ? least_open : greatest_saturated;
}

template <class Take>
ContactQuality measure_capped(const ContactLevel& level, double upper, std::span<const double> p,
                              std::span<const double> g, Take take) {
  const auto found = over_lanes<4, 2>(p.size(), [=]<class Value>(std::size_t k, Value* v) {
    Value pressure, gap;
    take(k, pressure, gap);
    weigh_capped(pressure, gap, Value{} + upper, v);
  });
  ContactQuality quality;
  quality.interior = found[0];
  quality.load = found[2];
  quality.settled = found[3];
  quality.within = found[3] == 0;
  quality.interior_gap = found[0] > 0 ? found[1] / found[0] : middle(found[4], -found[5]);
  const double offset = quality.offset = quality.interior_gap;
  const auto apart =
      over_lanes<1, 2>(p.size(), [=, p = p.data(), g = g.data()]<class Value>(std::size_t k, Value* v) {
        Value pressure, gap;
        lane_terms::read(p + k, pressure);
        lane_terms::read(g + k, gap);
        gap -= offset;
        const Value none = {}, most = none + upper, never = none + infinity;
        const Value positive = pressure > none ? pressure : none, q = positive < most ? positive : most;
        const Value lacking = q - most;
        v[0] = (gap > none ? q : lacking) * gap;
        v[1] = q < most ? gap : never;
        v[2] = q > none ? -gap : never;
      });
  quality.complementarity = apart[0] / (quality.load * level.length);
  quality.penetration = std::isfinite(apart[1]) ? std::max(0.0, -apart[1]) / level.length : 0.0;
  const double open = std::isfinite(apart[2]) ? std::max(0.0, -apart[2]) / level.length : 0.0;
  quality.residual = std::max({quality.complementarity, quality.penetration, open_weight * open});
  if (!(quality.residual == quality.residual)) quality.residual = infinity;
  return quality;
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
  quality.yielded = found[2];
  quality.load = found[4];
  quality.settled = found[6];
  quality.within = found[6] == 0;
  if (found[0] > 0)
    quality.interior_gap = found[1] / found[0];
  else
    quality.interior_gap = found[2] > 0 ? found[3] / found[2] : middle(found[8], -infinity);
  const double weighted = found[5] / found[4];
  quality.offset = weighted;
  quality.penetration = std::max(0.0, weighted - found[7]) / level.length;
  quality.complementarity = quality.penetration;
  quality.residual = std::max(quality.penetration, open_weight * (-found[9] - weighted) / level.length);
  if (!(weighted - found[7] == weighted - found[7])) quality.residual = infinity;
  return quality;
}

// take(k, p, g) returns pressure and gap of a node or a vector of nodes.
template <class Limit, class Take>
ContactQuality measure(const ContactLevel& level, const Limit& limit, std::span<const double> p,
                       std::span<const double> g, double balance, Take take) {
  if constexpr (Limit::hardens)
    return measure_hardening(level, limit, p.size(), balance, take);
  else if (std::isfinite(limit.upper()))
    return measure_capped(level, limit.upper(), p, g, take);
  else
    return measure_uncapped(level, p.size(), take);
}
}  // namespace

ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g, double balance) {
  const auto take = [p = p.data(), g = g.data()](std::size_t k, auto& pressure, auto& gap) {
    lane_terms::read(p + k, pressure);
    lane_terms::read(g + k, gap);
  };
  return std::visit([&](const auto& limit) { return measure(level, limit, p, g, balance, take); },
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
