// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_light_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/contact/elasticity/slabs/slab_quality.hpp"
#include "engine/contact/yield_law.hpp"

namespace asperity {

namespace {
constexpr double light = 0.01;  // an approach, of what gaps are measured by
constexpr double soft = 1e-3;   // what one node at the cap sinks, of the same

// Once more from the pressures there are; false, and they stay, where that does not converge.
bool again(SlabLevel& level, SlabFields& fields, double tolerance, double length, DescentEnd& end) {
  level.length = length;
  Array<double> before;
  level.team.work([&] { before = fields.pressure; });
  level.team.agree();
  const DescentEnd finer = descend_in_slabs(level, fields, tolerance, ChainEffort::brief);
  if (finer.converged)
    end = finer;
  else
    fields.pressure = std::move(before);
  return finer.converged;
}

}  // namespace

bool refine_light_contact_in_slabs(SlabLevel& level, SlabFields& fields, const SlabCellProblem& problem,
                                   DescentEnd& end) {
  const double length = level.length, cap = level.cap, tolerance = problem.tolerance;
  const auto offset = [&] { return slab_quality(level, fields.pressure, fields.gap).offset; };
  const auto sunk = [&](double p) {
    return LinearHardening::own_compliance * std::sqrt(level.shape.aspect) * p;
  };
  double approach = (problem.highest - problem.origin) * problem.factor + offset();
  const bool from_peak = approach < light * length;
  if (from_peak) {
    level.count_from(problem.highest);
    const double alone = sunk(level.total_load());
    if (!(approach > 0) || !std::isfinite(cap)) approach = std::min(approach > 0 ? approach : alone, alone);
    for (int round = 0; round < 60; ++round) {
      if (!again(level, fields, tolerance, approach, end)) break;
      approach = offset();
      if (!(approach > 0) || approach > 0.5 * level.length) break;
    }
  }
  const bool is_soft = std::isfinite(cap) && sunk(cap) < soft * length;
  if (is_soft) {
    // All is at the cap above some height and open below it; nodes there share the rest: the first of them.
    std::array<double, 1> own{std::numeric_limits<double>::quiet_NaN()};
    const Array<double>& p = fields.pressure;
    for (std::size_t k = 0; k < p.size() && std::isnan(own[0]); ++k)
      if (p[k] > 0 && p[k] < cap) own[0] = problem.heights[k];
    const Array<double> all = level.team.gather(own);
    const auto there = std::find_if(all.begin(), all.end(), [](double h) { return !std::isnan(h); });
    if (there != all.end()) {
      level.count_from(*there);
      again(level, fields, tolerance, sunk(cap), end);
    }
    level.count_from(from_peak ? problem.highest : problem.origin);
  }
  if (from_peak || is_soft) level.gap(fields.pressure, fields.gap);
  level.length = length;
  return from_peak;
}

}  // namespace asperity
