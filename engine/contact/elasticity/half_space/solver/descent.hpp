// SPDX-License-Identifier: GPL-3.0-or-later
// Descents on one grid: fields, stopping rules, stages and chains of stages, under a load and at an offset.
// Each stage starts from the feasible pressures of the one before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

struct DescentFields {
  explicit DescentFields(std::size_t nodes)
      : pressure(nodes), gap(nodes), image(nodes), free(nodes), old_free(nodes) {}

  UnsetArray<double> pressure;               // feasible between stages
  UnsetArray<double> gap;                    // K p − h
  UnsetArray<double> image;                  // K·direction times a power of two
  UnsetArray<double> old_pressure, old_gap;  // previous pass; allocated on first use
  Array<std::uint8_t> free, old_free;

  void remember_pass() {
    old_pressure = pressure;
    old_gap = gap;
  }
  // Exact: the gap is linear in p.
  void average_passes() {
    for_nodes(pressure.size(), [p = pressure.data(), g = gap.data(), old_p = old_pressure.data(),
                                old_g = old_gap.data()](std::size_t k) {
      p[k] = 0.5 * (p[k] + old_p[k]);
      g[k] = 0.5 * (g[k] + old_g[k]);
    });
  }
};

namespace descent_rules {

inline constexpr double richardson_step = 0.65;  // of the preconditioner
inline constexpr int passes_without_gain = 4;
inline constexpr int most_renewals = 50;
inline constexpr int quick = 300;  // applications of the quick stage

// Detects lack of gain, and few nodes alternating between two passes.
class Watch {
 public:
  void take(double residual) {
    without_gain_ = residual < 0.9 * best_ ? 0 : without_gain_ + 1;
    if (without_gain_ == 0) best_ = residual;
    slow_ones_ = residual > slow * least_ ? slow_ones_ + 1 : 0;
    least_ = std::min(least_, residual);
    if (residual > jump * before_) ++jumps_;
    before_ = residual;
  }
  int without_gain() const { return without_gain_; }

  enum class Advice { go_on, remember_pass, average_passes };
  // If the next pass also reverses, it is averaged with the stored one.
  Advice advice() {
    if (remembers_ && goes_back(0)) {
      slow_ones_ = jumps_ = 0;
      remembers_ = false;
      return Advice::average_passes;
    }
    remembers_ = goes_back(1);
    return remembers_ ? Advice::remember_pass : Advice::go_on;
  }

 private:
  static constexpr double slow = 0.7;  // of the best residual
  static constexpr double jump = 10;   // of the residual before
  static constexpr int slow_passes = 2, jumps_in_a_cycle = 2;
  static constexpr double none = std::numeric_limits<double>::infinity();

  // Now, or after `more` such passes.
  bool goes_back(int more) const {
    return slow_ones_ + more >= slow_passes || jumps_ + more >= jumps_in_a_cycle;
  }
  double best_ = none, least_ = none, before_ = none;
  int without_gain_ = 0, slow_ones_ = 0, jumps_ = 0;
  bool remembers_ = false;
};

}  // namespace descent_rules

struct DescentEnd {
  bool converged = false;
  std::string stage;
};

// Spectral projected gradients (Birgin, Martínez & Raydan 2000, SIAM J. Optim. 10, 1196): alternating
// Barzilai–Borwein steps, exact projection, nonmonotone over a window. Slow, feasible, convergent in theory:
// last resort, and shaker of the free set. Returns whether residual < tolerance, gap fresh. `level`:
// ContactLevel or SlabLevel; `d`, `image`: work.
template <class Level, class Limit>
bool spectral_gradient(Level& level, const Limit& law, std::span<double> p, std::span<double> g,
                       std::span<double> d, std::span<double> image, double tolerance,
                       int most_applications) {
  constexpr std::size_t window = 8;
  constexpr int renewals = 20;  // steps between fresh gaps
  const double load = level.total_load(), upper = law.upper();
  const int last = level.applications + most_applications;
  const auto project = [&](std::span<double> x) {
    project_to_load(level, x.data(), nullptr, upper, load, Level::resolves_shifts, x.data());
  };
  const auto opening_slope = [=, p = p.data()](std::size_t k) {
    return law.opening(k, p[k]) > 0 ? law.yielding_slope() : 0.0;
  };
  const auto total_gap = [=, p = p.data(), g = g.data()](std::size_t k) {
    return g[k] + law.opening(k, p[k]);
  };

  level.gap(p, g);
  bool fresh = true;
  std::array<double, window> energies;
  energies.fill(-std::numeric_limits<double>::infinity());
  double energy = 0, pace = 0.5;
  energies[0] = energy;
  for (int step = 0;; ++step) {
    const ContactQuality at = contact_quality(level, p, g);
    level.report_pass(at.residual);
    if (at.residual < tolerance) {
      if (fresh) return true;
      level.gap(p, g);
      fresh = true;
      continue;
    }
    if (level.applications >= last || !std::isfinite(at.residual)) return false;

    const double middle = at.interior_gap;
    level.each([=](std::size_t k) {
      const double stiff = 1 + pace * opening_slope(k);
      d[k] = p[k] - pace / stiff * (total_gap(k) - middle);
    });
    project(d);
    level.each([=](std::size_t k) { d[k] -= p[k]; });
    level.apply(std::span<const double>(d), image);
    enum { energy_slope, bend, bend_squared, step_squared };
    const auto sums = level.template over<4>([=](std::size_t k, double* v) {
      const double bent = image[k] + opening_slope(k) * d[k];
      v[energy_slope] = (total_gap(k) - middle) * d[k];
      v[bend] = d[k] * bent;
      v[bend_squared] = bent * bent;
      v[step_squared] = d[k] * d[k];
    });
    const double slope = sums[energy_slope], curvature = sums[bend];
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
    pace = step % 2 == 0 ? sums[step_squared] / curvature : curvature / sums[bend_squared];
    if (step % renewals == renewals - 1) {
      project(p);
      level.gap(p, g);
      fresh = true;
    }
  }
}

enum class ChainEffort {
  start,  // for a finer grid: pressures may leave their bounds
  brief,  // without the last resort
  less,   // fewer downhill passes at an offset
  full    // up to thousands of projected gradients
};

// Stages until one converges, the quick one first. `descend()` and `shake(most_applications)` return whether
// they converged.
template <class Descend, class Shake>
DescentEnd run_stages(ChainEffort effort, const Descend& descend, const Shake& shake) {
  constexpr int a_few = 12, last_resort = 3000;
  DescentEnd end;
  const auto ends = [&](const char* stage, bool converged) {
    end = {converged, stage};
    return converged;
  };
  if (ends("preconditioned descent", descend()) || ends("spectral projected gradients", shake(a_few)) ||
      ends("preconditioned descent, restarted", descend()) || effort != ChainEffort::full)
    return end;
  if (!ends("spectral projected gradients", shake(a_few)))
    ends("spectral projected gradients, after the descents stalled", shake(last_resort));
  return end;
}

// active_set_descent.cpp.
DescentEnd run_chain(ContactLevel& level, DescentFields& fields, double tolerance, ChainEffort effort);

// offset_descent.cpp. `gap_known`: fields.gap is K p − h and pressures may be infeasible. Ends with feasible
// pressures and, if converged, a fresh (full), updated (brief) or unsettled (start) gap. Residuals are
// relative to level.length. Periodic elastic full contact does not converge.
DescentEnd run_offset_chain(ContactLevel& level, DescentFields& fields, double offset, double tolerance,
                            ChainEffort effort, bool gap_known);

}  // namespace asperity
