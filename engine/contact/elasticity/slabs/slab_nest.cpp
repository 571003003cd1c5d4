// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_nest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"
#include "engine/contact/elasticity/slabs/slab_descent.hpp"
#include "engine/contact/elasticity/slabs/slab_quality.hpp"
#include "engine/contact/yield_law.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {
constexpr double light = 0.01;  // greatest approach of a light contact, in units of length
constexpr double soft = 1e-3;   // greatest sinking of a node at the cap, in units of length

// A failed descent restores the pressures.
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

// Repeats the descent for contacts so light or so soft that displacements are far below the rms height, as
// half_space/nested_descent.cpp. Returns whether gaps and offset now count from the highest node.
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
    // Nodes above some height are at the cap, nodes below are open. Nodes at this height share the rest.
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

constexpr double coarse_tolerance = 1e-3;

struct Step {
  std::optional<CoarserGrid> from;  // transfer from the finer grid
  SlabShape shape;
  Array<double> heights;  // empty on the finest
  double pitch = 1;       // hx in cells of the finest grid
  double mean_pressure = 0;
};

double work_of(const Slab& slab) {
  return slab.all_nodes() * elementary::log(std::max(slab.all_nodes(), 2.0));
}

std::vector<Step> nest(Team& team, const SlabCellProblem& problem, bool alone) {
  std::vector<Step> steps(1);
  steps[0].shape = problem.shape;
  steps[0].mean_pressure = problem.mean_pressure;
  while (!alone) {
    const Step& fine = steps.back();
    const Slab& slab = fine.shape.slab;
    const auto next = coarser({slab.nx, slab.ny, fine.shape.aspect});
    if (!next) break;
    Step step;
    step.from = next;
    step.shape = {team.slab(next->shape.nx, next->shape.ny), next->shape.aspect};
    step.shape.weight = work_of(step.shape.slab) / work_of(problem.shape.slab);
    step.pitch = fine.pitch * next->pitch_x;
    const double cells = step.shape.slab.all_nodes() * next->pitch_x * next->pitch_y;
    step.mean_pressure = fine.mean_pressure * next->pitch_x * (slab.all_nodes() / cells);
    step.heights = restrict_slabs(
        team, slab, *next,
        fine.heights.empty() && steps.size() == 1 ? problem.heights : std::span<const double>(fine.heights));
    steps.push_back(std::move(step));
  }
  return steps;
}

// Level-set field: at a bound, the distance of the gap from leaving the bound replaces the pressure.
void to_level_set(SlabLevel& level, double offset, std::span<const double> gap, std::span<double> p) {
  level.each([=, g = gap.data(), to = p.data(), upper = level.cap, stiffness = level.short_wave_stiffness](
                 std::size_t k) { to[k] = level_set(to[k], upper, stiffness * (g[k] - offset)); });
}

// Rounding of a bound counts as the bound.
void snap_to_bounds(SlabLevel& level, std::span<double> p) {
  const double rounding =
      std::max(1e-14, level.shape.slab.all_nodes() * std::numeric_limits<double>::epsilon());
  const double greatest = -level.over<0, 1>([p = p.data()](std::size_t k, double* v) { v[0] = -p[k]; })[0];
  const double upper = level.cap, least = rounding * std::min(upper, greatest);
  level.each([=, p = p.data()](std::size_t k) {
    if (p[k] < least)
      p[k] = 0;
    else if (p[k] > upper * (1 - rounding))
      p[k] = upper;
  });
}

}  // namespace

SlabCellAnswer nested_descent_in_slabs(Team& team, const SlabCellProblem& problem,
                                       std::span<const double> start_pressure,
                                       std::span<const double> start_gap, Monitor& monitor) {
  // A process without rows has an empty start.
  const bool warm = team.reduce<1>({static_cast<double>(start_pressure.size())})[0] > 0;
  std::vector<Step> steps = nest(team, problem, warm);
  DescentProgress progress(monitor, "contact in slabs");
  SlabCellAnswer answer;
  answer.levels = static_cast<int>(steps.size());
  Array<double> carried;  // level-set field
  double all_work = 0;
  for (const Step& step : steps) all_work += step.shape.weight;
  for (std::size_t l = steps.size(); l-- > 0;) {
    Step& step = steps[l];
    const bool finest = l == 0;
    SlabLevel level(team, step.shape, finest ? problem.heights : std::span<const double>(step.heights),
                    problem.origin, problem.factor, problem.cap * step.pitch, step.mean_pressure);
    level.length = problem.length;
    const double tolerance = finest ? problem.tolerance : std::max(coarse_tolerance, problem.tolerance);
    level.report = progress.next_grid(step.shape.weight, all_work, tolerance);

    SlabFields fields(team, level.nodes());
    Array<double>& p = fields.pressure;
    if (warm) {
      std::copy(start_pressure.begin(), start_pressure.end(), p.begin());
      to_level_set(level, 0, start_gap, p);
    } else if (l + 1 == steps.size()) {
      std::fill(p.begin(), p.end(), step.mean_pressure);
    } else {
      const CoarserGrid& from = *steps[l + 1].from;
      prolong_slabs(team, from, carried, 1 / from.pitch_x, step.shape.slab, p);
      carried = Array<double>();
    }
    project_slabs_to_load(level, p, nullptr, p);
    DescentEnd end =
        descend_in_slabs(level, fields, tolerance, finest ? ChainEffort::full : ChainEffort::start);
    if (!end.converged) level.gap(p, fields.gap);
    if (finest) {
      answer.from_peak = refine_light_contact_in_slabs(level, fields, problem, end);
      if (std::isfinite(level.cap)) snap_to_bounds(level, p);
    }
    const SlabQuality at = slab_quality(level, p, fields.gap);
    if (finest) {
      answer.pressure = std::move(p);
      answer.gap = std::move(fields.gap);
      answer.offset = at.offset;
      answer.converged = end.converged;
      answer.applications = level.applications;
      answer.stage = end.stage;
    } else {
      to_level_set(level, at.interior_gap, fields.gap, p);
      carried = std::move(p);
      step.heights = Array<double>();
    }
  }
  return answer;
}

SlabCellAnswer full_contact_in_slabs(Team& team, const SlabCellProblem& problem, Monitor& monitor) {
  DescentProgress progress(monitor, "contact in slabs");
  SlabLevel level(team, problem.shape, problem.heights, problem.origin, problem.factor, problem.cap,
                  problem.mean_pressure);
  level.length = problem.length;
  SlabCellAnswer answer;
  answer.stage = "exact filter (full contact)";
  team.work([&] {
    answer.pressure.resize(level.nodes());
    answer.gap.resize(level.nodes());
  });
  team.agree();
  double *const p = answer.pressure.data(), *const g = answer.gap.data();
  level.apply_inverse([&](std::size_t k) { return level.height(k); },
                      [=, mean = problem.mean_pressure](std::size_t k, double q) {
                        g[k] = q;
                        p[k] = q + mean;
                      });
  const auto found = level.over<1, 1>([=, cap = problem.cap](std::size_t k, double* v) {
    v[0] = p[k] >= cap ? 1.0 : 0.0;
    v[1] = p[k];
  });
  answer.applications = 1;
  team.work([&] { progress.report(0, 1, 1, 0.5); });
  if (!(found[0] == 0 && found[1] > 0)) return answer;
  // From pressure differences: a large mean, which displaces nothing, would hide them in rounding.
  level.gap(answer.gap, answer.gap);
  answer.applications = 2;
  const SlabQuality at = slab_quality(level, answer.pressure, answer.gap);
  answer.offset = at.offset;
  answer.converged = at.residual <= problem.tolerance;
  return answer;
}

}  // namespace asperity
