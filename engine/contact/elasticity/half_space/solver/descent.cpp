// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/descent.hpp"

#include <array>
#include <cmath>

#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"

namespace asperity {

namespace {
constexpr std::size_t window = 8;
constexpr int renewals = 20;  // steps between fresh gaps

template <class Limit>
bool descend(ContactLevel& level, const Limit& limit, DescentFields& f, double tolerance, int most) {
  const std::size_t nodes = f.pressure.size();
  const double load = level.total_load(), upper = limit.upper();
  UnsetArray<double>&p = f.pressure, &g = f.gap;
  Array<double> d(nodes), image(nodes);
  const int last = level.applications + most;
  auto opening_slope = [&](std::size_t k) {
    return limit.opening(k, p[k]) > 0 ? limit.yielding_slope() : 0.0;
  };
  auto total_gap = [&](std::size_t k) { return g[k] + limit.opening(k, p[k]); };

  level.gap(p, g);
  bool fresh = true;
  std::array<double, window> energies;
  energies.fill(-std::numeric_limits<double>::infinity());
  double energy = 0, pace = 0.5;
  energies[0] = energy;
  for (int step = 0;; ++step) {
    const ContactQuality at = contact_quality(level, p, g);
    if (level.report) level.report(at.residual);
    if (at.residual < tolerance) {
      if (fresh) return true;
      level.gap(p, g);
      fresh = true;
      continue;
    }
    if (level.applications >= last || !std::isfinite(at.residual)) return false;

    for_nodes(nodes, [&](std::size_t k) {
      const double stiff = 1 + pace * opening_slope(k);
      d[k] = p[k] - pace / stiff * (total_gap(k) - at.interior_gap);
    });
    project_to_load(d, {}, upper, load, d);
    for_nodes(nodes, [&](std::size_t k) { d[k] -= p[k]; });
    level.apply(d, image);
    const auto sums = over_nodes<4>(nodes, [&](std::size_t k, double* v) {
      const double bent = image[k] + opening_slope(k) * d[k];
      v[0] = (total_gap(k) - at.interior_gap) * d[k];
      v[1] = d[k] * bent;
      v[2] = bent * bent;
      v[3] = d[k] * d[k];
    });
    const double slope = sums[0], curvature = sums[1];
    if (!(curvature > 0)) return false;
    const double highest = *std::max_element(energies.begin(), energies.end());
    const double t = energy + slope + 0.5 * curvature > highest ? std::min(1.0, -slope / curvature) : 1.0;
    for_nodes(nodes, [&](std::size_t k) {
      p[k] = t == 1 ? p[k] + d[k] : std::min(std::max(p[k] + t * d[k], 0.0), upper);
      g[k] += t * image[k];
    });
    energy += t * slope + 0.5 * t * t * curvature;
    energies[static_cast<std::size_t>(step + 1) % window] = energy;
    fresh = false;
    pace = step % 2 == 0 ? sums[3] / curvature : curvature / sums[2];
    if (step % renewals == renewals - 1) {
      project_to_load(p, {}, upper, load, p);
      level.gap(p, g);
      fresh = true;
    }
  }
}
}  // namespace

bool spectral_gradient(ContactLevel& level, DescentFields& fields, double tolerance, int most_applications) {
  return std::visit(
      [&](const auto& limit) { return descend(level, limit, fields, tolerance, most_applications); },
      level.limit);
}

DescentEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort) {
  constexpr int quick = 300, shake = 12, last_resort = 3000;
  DescentEnd end;
  for (int stage = 0; stage < (effort == ChainEffort::full ? 5 : 3) && !end.converged; ++stage) {
    if (stage == 4) {
      end.converged = spectral_gradient(level, fields, tolerance, last_resort);
      end.stage = "spectral projected gradients, after the descents stalled";
    } else if (stage % 2 == 1) {
      end.converged = spectral_gradient(level, fields, tolerance, shake);
      end.stage = "spectral projected gradients";
    } else {
      end.converged = active_set_descent(level, fields, tolerance, quick, effort != ChainEffort::start);
      end.stage = stage == 0 ? "preconditioned descent" : "preconditioned descent, restarted";
    }
  }
  return end;
}

}  // namespace asperity
