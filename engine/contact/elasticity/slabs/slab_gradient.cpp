// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/contact/elasticity/slabs/slab_quality.hpp"

namespace asperity {

bool slab_gradient(SlabLevel& level, SlabFields& f, double tolerance, int most_applications) {
  constexpr std::size_t window = 8;
  constexpr int renewals = 20;  // steps between applications that remove the drift of the gap
  const double upper = level.cap;
  const int last = level.applications + most_applications;
  double *const p = f.pressure.data(), *const g = f.gap.data();
  double *const d = f.direction.data(), *const image = f.image.data();
  level.gap(f.pressure, f.gap);
  bool fresh = true;
  std::array<double, window> energies;
  energies.fill(-std::numeric_limits<double>::infinity());
  double energy = 0, pace = 0.5;
  energies[0] = energy;
  for (int step = 0;; ++step) {
    const SlabQuality at = slab_quality(level, f.pressure, f.gap);
    level.team.work([&] {
      if (level.report) level.report(at.residual);
    });
    if (at.residual < tolerance) {
      if (fresh) return true;
      level.gap(f.pressure, f.gap);
      fresh = true;
      continue;
    }
    if (level.applications >= last || !std::isfinite(at.residual)) return false;

    level.each([=, middle = at.interior_gap](std::size_t k) { d[k] = p[k] - pace * (g[k] - middle); });
    project_slabs_to_load(level, f.direction, nullptr, f.direction);
    level.apply([=](std::size_t k) { return d[k] -= p[k]; }, [=](std::size_t k, double u) { image[k] = u; });
    const auto sums = level.over<4>([=, middle = at.interior_gap](std::size_t k, double* v) {
      v[0] = (g[k] - middle) * d[k];
      v[1] = d[k] * image[k];
      v[2] = image[k] * image[k];
      v[3] = d[k] * d[k];
    });
    const double slope = sums[0], curvature = sums[1];
    if (!(curvature > 0)) return false;
    const double highest = *std::max_element(energies.begin(), energies.end());
    const double t = energy + slope + 0.5 * curvature > highest ? std::min(1.0, -slope / curvature) : 1.0;
    level.each([=](std::size_t k) {
      p[k] = t == 1 ? p[k] + d[k] : std::min(std::max(p[k] + t * d[k], 0.0), upper);
      g[k] += t * image[k];
    });
    energy += t * slope + 0.5 * t * t * curvature;
    energies[static_cast<std::size_t>(step + 1) % window] = energy;
    fresh = false;
    pace = step % 2 == 0 ? sums[3] / curvature : curvature / sums[2];
    if (step % renewals == renewals - 1) {
      project_slabs_to_load(level, f.pressure, nullptr, f.pressure);
      level.gap(f.pressure, f.gap);
      fresh = true;
    }
  }
}

}  // namespace asperity
