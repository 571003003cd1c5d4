// SPDX-License-Identifier: GPL-3.0-or-later
// Error of pressures on one grid: the best offset δ and the greater of penetration and complementarity for
// it. With a cap penetration is pointwise; without one both agree if δ is the pressure-weighted mean gap.
// Pressures outside their bounds count as settled; the load is not judged.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/core/constants.hpp"

namespace asperity {

struct ContactQuality {
  double residual = 0;      // greatest entry
  double offset = 0;        // δ of the residual
  double interior_gap = 0;  // mean over the elastic interior, or a substitute
  double interior = 0;      // elastic nodes
  double load = 0;          // Σ p, settled
  bool within = true;       // nothing settled
};

// Pending steps: p += Σ length · direction, g += gap_length · image.
template <class Stored>
struct PressureStep {
  struct Along {
    double length = 0;
    const Stored* direction = nullptr;
  };
  Along along[2];  // null only if both are
  double gap_length = 0;
  const double* image = nullptr;

  bool none() const { return along[0].length == 0 && along[1].length == 0 && gap_length == 0; }
  template <class Value>
  void take(std::size_t k, double* p, double* g, Value& pressure, Value& gap) const {
    Value last, before, change;
    lane_terms::read(p + k, pressure);
    lane_terms::read(along[0].direction + k, last);
    lane_terms::read(along[1].direction + k, before);
    pressure += along[0].length * last + along[1].length * before;
    lane_terms::put(pressure, p + k);
    lane_terms::read(g + k, gap);
    lane_terms::read(image + k, change);
    gap += gap_length * change;
    lane_terms::put(gap, g + k);
  }
};

// Without hardening. `level`: ContactLevel or SlabLevel.
namespace contact_measures {

// Complementarity averages over the load. If yielding nodes carry nearly all load, the few others fix offset
// and plastic volume.
constexpr double open_weight = 0.125;

// At a node or a vector of nodes.
struct AsStored {
  const double *p, *g;
  template <class Value>
  void operator()(std::size_t k, Value& pressure, Value& gap) const {
    lane_terms::read(p + k, pressure);
    lane_terms::read(g + k, gap);
  }
};

template <class Level, class Take>
ContactQuality measure_uncapped(Level& level, Take take) {
  enum { interior, interior_gap, load, energy, settled, least_gap };
  const auto found = level.template in_lanes<5, 1>([=]<class Value>(std::size_t k, Value* v) {
    Value p, g;
    take(k, p, g);
    const Value none = {}, one = none + 1.0, q = p <= none ? none : p;
    v[interior] = p <= none ? none : one;
    v[interior_gap] = p <= none ? none : g;
    v[load] = q;
    v[energy] = q * g;
    v[settled] = p < none ? one : none;
    v[least_gap] = g;
  });
  ContactQuality quality;
  quality.interior = found[interior];
  quality.load = found[load];
  quality.within = found[settled] == 0;
  quality.interior_gap = found[interior] > 0 ? found[interior_gap] / found[interior] : found[least_gap];
  const double weighted = found[energy] / found[load], below = weighted - found[least_gap];
  quality.offset = weighted;
  quality.residual = std::max(0.0, below) / level.length;
  if (std::isnan(below)) quality.residual = infinity;
  return quality;
}

// Without an elastic interior.
inline double middle(double least_open, double greatest_saturated) {
  if (std::isfinite(least_open) && std::isfinite(greatest_saturated))
    return 0.5 * (least_open + greatest_saturated);
  return std::isfinite(least_open) ? least_open : greatest_saturated;
}

template <class Level, class Take>
ContactQuality measure_capped(Level& level, double upper, AsStored stored, Take take) {
  enum { interior, interior_gap, load, settled, least_open, saturated };
  const auto found = level.template in_lanes<4, 2>([=]<class Value>(std::size_t k, Value* v) {
    Value p, g;
    take(k, p, g);
    const Value none = {}, one = none + 1.0, never = none + infinity, most = none + upper;
    const Value positive = p > none ? p : none;
    const Value below = p < most ? one : none, inside = p > none ? below : none;
    v[interior] = inside;
    v[interior_gap] = inside > none ? g : none;
    v[load] = p < most ? positive : most;
    const Value too_large = p > most ? one : none;
    v[settled] = p < none ? one : too_large;
    v[least_open] = p <= none ? g : never;
    v[saturated] = p >= most ? -g : never;
  });
  ContactQuality quality;
  quality.interior = found[interior];
  quality.load = found[load];
  quality.within = found[settled] == 0;
  quality.interior_gap = found[interior] > 0 ? found[interior_gap] / found[interior]
                                             : middle(found[least_open], -found[saturated]);
  const double offset = quality.offset = quality.interior_gap;
  const auto apart = level.template in_lanes<1, 2>([=]<class Value>(std::size_t k, Value* v) {
    Value pressure, gap;
    stored(k, pressure, gap);
    gap -= offset;
    const Value none = {}, most = none + upper, never = none + infinity;
    const Value positive = pressure > none ? pressure : none, q = positive < most ? positive : most;
    const Value lacking = q - most;
    v[0] = (gap > none ? q : lacking) * gap;
    v[1] = q < most ? gap : never;
    v[2] = q > none ? -gap : never;
  });
  const double complementarity = apart[0] / (quality.load * level.length);
  const double penetration = std::isfinite(apart[1]) ? std::max(0.0, -apart[1]) / level.length : 0.0;
  const double open = std::isfinite(apart[2]) ? std::max(0.0, -apart[2]) / level.length : 0.0;
  quality.residual = std::max({complementarity, penetration, open_weight * open});
  if (std::isnan(quality.residual)) quality.residual = infinity;
  return quality;
}

// `take`: as AsStored, after pending steps.
template <class Level, class Take>
ContactQuality measure_bounded(Level& level, double upper, AsStored stored, Take take) {
  return std::isfinite(upper) ? measure_capped(level, upper, stored, take) : measure_uncapped(level, take);
}

}  // namespace contact_measures

// One pass, two with a cap. `balance` as in PressureLimit::settle.
ContactQuality contact_quality(const ContactLevel& level, std::span<const double> p,
                               std::span<const double> g,
                               double balance = std::numeric_limits<double>::quiet_NaN());

// After `step`, in the same pass.
template <class Stored>
ContactQuality contact_quality(const ContactLevel& level, std::span<double> p, std::span<double> g,
                               const PressureStep<Stored>& step, double balance);

}  // namespace asperity
