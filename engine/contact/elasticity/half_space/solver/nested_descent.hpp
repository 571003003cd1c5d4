// SPDX-License-Identifier: GPL-3.0-or-later
// Nested grids, in cell units of the finest. Each coarse solution is interpolated as a field whose level
// sets are the edges of contact and of the capped area; a chain of descents finishes on the finest grid.
// Also light contacts and full contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Finds the contact set, which suffices for a start.
inline constexpr double start_tolerance = 5e-3;
// Per unit of gaps; at smaller approaches gaps count from the highest node.
inline constexpr double light_approach = 0.01;

// Logarithmic in the residual. Throws on a stop.
class DescentProgress {
 public:
  DescentProgress(Monitor& monitor, const char* of) : task_(monitor, of, total) {}
  // `begin` to `end`: share of the work.
  void report(double begin, double end, double residual, double tolerance);
  // `weight` of the next grid in `all` the work.
  std::function<void(double)> next_grid(double weight, double all, double tolerance);

 private:
  static constexpr std::int64_t total = 1000;
  Task task_;
  std::int64_t done_ = 0;
  double work_done_ = 0;
};

struct CellProblem {
  LevelShape shape;
  std::span<const double> heights;  // any unit; (height − origin)·factor is in cell units
  double origin = 0, factor = 1;
  // Lower nodes have no counterpart and are out of reach. Unit of `heights`; free tile only.
  double lowest = -std::numeric_limits<double>::infinity();
  PressureLimit limit;
  double mean_pressure = 0;
  // Then `mean_pressure` is a guess, within twenty powers of ten.
  std::optional<double> offset;
  ChainEffort effort = ChainEffort::full;
  double length = 1;  // unit of gaps
  double tolerance = 0;
};

struct CellAnswer {
  UnsetArray<double> pressure;  // feasible, exact at the bounds
  UnsetArray<double> gap;       // K p − h, freshly computed
  double offset = 0;
  // Light contact: gap and offset count from the highest node; the offset is the approach.
  bool from_peak = false;
  bool converged = false;
  int applications = 0;  // on the finest grid
  int levels = 1;
  bool single = false;
  std::string stage;
};

// On nx × ny nodes of the tile, in the problem's cell units, gaps without offset; empty for none. At an
// offset on the same nodes pressures may exceed their bounds.
struct CellStart {
  int nx = 0, ny = 0;
  std::span<const double> pressure, gap;
};

// Without a start: nested grids. Failure does not throw.
CellAnswer nested_descent(const CellProblem& problem, const CellStart& start, Monitor& monitor);

// Periodic full elastic contact, p = p̄ + (|q|/2) h; `converged` false if infeasible. Two applications.
CellAnswer full_contact(const CellProblem& problem, Monitor& monitor);

// Shared with slabs. `level`: ContactLevel or SlabLevel.

struct NestedGrid {
  std::optional<CoarserGrid> from;  // from the finer grid
  LevelShape shape;
  Array<double> heights;  // empty on the finest grid, which uses the caller's
  Array<double> yield;
  double pitch = 1;          // hx in cells of the finest grid
  double mean_pressure = 0;  // cell units
};
using Restrict = std::function<Array<double>(const LevelShape& fine, const CoarserGrid& coarse,
                                             std::span<const double> field)>;
// Finest first; `alone`: no coarser grids.
std::vector<NestedGrid> nested_grids(const CellProblem& problem, bool alone, const Restrict& restricted);

// At a bound, the gap's distance from leaving it, in pressure, replaces the pressure.
template <class Level>
void to_level_set(Level&& level, double upper, double stiffness, double offset, std::span<const double> gap,
                  std::span<double> p) {
  level.each([=](std::size_t k) {
    const double apart = stiffness * (gap[k] - offset);
    p[k] = p[k] <= 0 ? std::min(0.0, -apart) : p[k] >= upper ? upper + std::max(0.0, -apart) : p[k];
  });
}

template <class Level>
double greatest(Level& level, std::span<const double> values) {
  return -level.template over<0, 1>([=](std::size_t k, double* v) { v[0] = -values[k]; })[0];
}

// Rounded off the bound, a pressure would count as free and could alone fix the offset. Under light loads all
// pressures are small against the bound.
template <class Level>
void snap_to_bounds(Level& level, double upper, std::span<double> p) {
  const double rounding = std::max(1e-14, level.all_nodes() * std::numeric_limits<double>::epsilon());
  const double least = rounding * std::min(upper, greatest(level, p));
  level.each([=](std::size_t k) {
    if (p[k] < least)
      p[k] = 0;
    else if (p[k] > upper * (1 - rounding))
      p[k] = upper;
  });
}

// Contacts too light, or surfaces too soft, for residuals relative to the rms height. Gaps count from the
// decisive height (sums of small terms), measured by its displacement.
template <class Level, class Fields>
class LightContact {
 public:
  LightContact(Level& level, Fields& fields, const CellProblem& problem)
      : level_(level), fields_(fields), problem_(problem), cap_(greatest_pressure(problem.limit)) {}

  // Needs feasible pressures and gaps in `fields`; keeps them if no round converges. Recomputes `gap`.
  // Returns whether gaps count from the highest node.
  bool refine(DescentEnd& end) {
    const double highest = greatest(level_, problem_.heights), length = level_.length;
    const double approach = (highest - problem_.origin) * problem_.factor + offset();
    const bool from_peak = approach < light_approach * length;
    if (from_peak) {
      level_.count_from(highest);
      by_approach(approach, end);
    }
    const bool is_soft = std::isfinite(cap_) && sunk(cap_) < soft * length;
    if (is_soft) {
      at_the_cap(end);
      level_.count_from(from_peak ? highest : problem_.origin);
    }
    if (from_peak || is_soft) level_.gap(fields_.pressure, fields_.gap);
    level_.length = length;
    return from_peak;
  }

 private:
  static constexpr double soft = 1e-3;  // displacement at the cap, per unit of gaps

  // Failure restores the pressures.
  bool again(double length, DescentEnd& end) {
    level_.length = length;
    UnsetArray<double> before;
    level_.work([&] { before = fields_.pressure; });
    level_.agree();
    const DescentEnd finer = run_chain(level_, fields_, problem_.tolerance, ChainEffort::brief);
    if (finer.converged)
      end = finer;
    else
      fields_.pressure = std::move(before);
    return finer.converged;
  }
  void by_approach(double approach, DescentEnd& end) {
    constexpr double right = 0.5;  // approach per unit of gaps
    constexpr int most_rounds = 60;
    // Upper bound without pressure limit; the first approach may be a mere residual.
    const double alone = sunk(level_.total_load());
    const bool elastic = !std::isfinite(cap_) && std::holds_alternative<PressureCap>(problem_.limit);
    if (!(approach > 0) || elastic) approach = std::min(approach > 0 ? approach : alone, alone);
    for (int round = 0; round < most_rounds; ++round) {
      if (!again(approach, end)) return;
      approach = offset();
      if (!(approach > 0) || approach > right * level_.length) return;
    }
  }
  // Nodes above some height are at the cap, lower ones open; nodes at this height share the rest.
  void at_the_cap(DescentEnd& end) {
    double own = std::numeric_limits<double>::quiet_NaN();
    const std::span<const double> p = fields_.pressure;
    for (std::size_t k = 0; k < p.size() && std::isnan(own); ++k)
      if (p[k] > 0 && p[k] < cap_) own = problem_.heights[k];
    const double height = level_.first_number(own);
    if (std::isnan(height)) return;
    level_.count_from(height);
    again(sunk(cap_), end);
  }
  double offset() { return contact_quality(level_, fields_.pressure, fields_.gap).offset; }
  double sunk(double p) const { return LinearHardening::own_compliance * std::sqrt(level_.shape.aspect) * p; }

  Level& level_;
  Fields& fields_;
  const CellProblem& problem_;
  const double cap_;
};

template <class Level>
CellAnswer full_contact_on(Level& level, const CellProblem& problem, DescentProgress& progress) {
  level.length = problem.length;
  CellAnswer answer;
  answer.stage = "exact filter (full contact)";
  level.work([&] {
    answer.pressure.resize(level.nodes());
    answer.gap.resize(level.nodes());
  });
  level.agree();
  level.inverse_of_heights(answer.gap);
  answer.applications = 1;
  // The mean moves nothing but can cost precision.
  const auto found = level.template over<1, 1>(
      [&, p = answer.pressure.data(), g = answer.gap.data()](std::size_t k, double* v) {
        p[k] = g[k] + problem.mean_pressure;
        v[0] = std::visit(
            [&](const auto& law) { return p[k] >= law.upper() || law.opening(k, p[k]) > 0 ? 1.0 : 0.0; },
            problem.limit);
        v[1] = p[k];
      });
  level.work([&] { progress.report(0, 1, 1, 0.5); });
  if (!(found[0] == 0 && found[1] > 0)) return answer;
  level.gap_beside_mean(answer.gap, answer.gap);
  answer.applications = 2;
  const ContactQuality at = contact_quality(level, answer.pressure, answer.gap);
  answer.offset = at.offset;
  answer.converged = at.residual <= problem.tolerance;
  return answer;
}

}  // namespace asperity
