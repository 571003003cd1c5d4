// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "engine/contact/elasticity/half_space/solver/contact_quality.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

void DescentProgress::report(double begin, double end, double residual, double tolerance) {
  double gained = 0;
  if (residual > 0 && tolerance < 1)
    gained = std::clamp(elementary::log(std::min(residual, 1.0)) / elementary::log(tolerance), 0.0, 1.0);
  const auto now = static_cast<std::int64_t>(total * (begin + (end - begin) * gained));
  task_.advance(std::max<std::int64_t>(0, now - done_));
  done_ = std::max(done_, now);
}

std::function<void(double)> DescentProgress::next_grid(double weight, double all, double tolerance) {
  const double begin = work_done_ / all, end = (work_done_ += weight) / all;
  return [=, this](double residual) { report(begin, end, residual, tolerance); };
}

namespace {

constexpr int most_snaps = 3;

double work(const LevelShape& shape) {
  const double n = static_cast<double>(shape.nodes());
  return n * elementary::log(std::max(n, 2.0));
}

PressureLimit limit_on(const PressureLimit& finest, const NestedGrid& step) {
  if (const auto* cap = std::get_if<PressureCap>(&finest)) return PressureCap{cap->cap * step.pitch};
  LinearHardening limit = std::get<LinearHardening>(finest);
  if (!step.yield.empty()) limit.yield = step.yield.data();
  limit.uniform *= step.pitch;
  limit.factor *= step.pitch;
  limit.compliance /= step.pitch;
  return limit;
}

void prolong_start(const CellStart& start, double upper, const ContactLevel& level, std::span<double> p) {
  const LevelShape& shape = level.shape;
  CoarserGrid from{shape, static_cast<double>(shape.nx) / start.nx, static_cast<double>(shape.ny) / start.ny};
  from.shape.nx = start.nx;
  from.shape.ny = start.ny;
  UnsetArray<double> carried(start.pressure.begin(), start.pressure.end());
  to_level_set(AllNodes(carried.size()), upper, level.short_wave_stiffness / from.pitch_x, 0, start.gap,
               carried);
  prolong(from, carried, 1, shape, p);
}

// From the pressures in `fields`, at the offset or under the load. `gap`: of a start, or empty.
DescentEnd descend_on_grid(const CellProblem& problem, std::span<const double> heights,
                           std::span<const double> gap, bool finest, double tolerance, ContactLevel& level,
                           DescentFields& fields, ContactQuality& at, bool& from_peak) {
  const double upper = greatest_pressure(level.limit), lowest = problem.lowest;
  const ChainEffort effort = finest ? problem.effort : ChainEffort::start;
  UnsetArray<double>& p = fields.pressure;
  if (problem.offset) {
    if (!gap.empty())
      std::copy(gap.begin(), gap.end(), fields.gap.begin());
    else
      for_nodes(p.size(), [upper, lowest, h = heights.data(), p = p.data()](std::size_t k) {
        p[k] = h[k] < lowest ? 0.0 : std::clamp(p[k], 0.0, upper);
      });
    const DescentEnd end = run_offset_chain(level, fields, *problem.offset, tolerance, effort, !gap.empty());
    if (!end.converged) level.gap(p, fields.gap);
    at.offset = at.interior_gap = *problem.offset;
    from_peak = true;
    return end;
  }
  if (!gap.empty()) to_level_set(level, upper, level.short_wave_stiffness, 0, gap, p);
  if (std::isfinite(lowest)) {
    // Below any shift to the load.
    for (std::size_t k = 0; k < p.size(); ++k)
      if (heights[k] < lowest) p[k] = std::min(p[k], -2 * level.total_load());
  }
  project_to_load(p, {}, upper, level.total_load(), p);
  DescentEnd end = run_chain(level, fields, tolerance, effort);
  if (!end.converged) level.gap(p, fields.gap);
  from_peak = finest && LightContact(level, fields, problem).refine(end);
  for (int round = 0;; ++round) {
    if (finest && std::isfinite(upper)) snap_to_bounds(level, upper, p);
    at = contact_quality(level, p, fields.gap);
    if (!finest || from_peak || !end.converged || at.residual <= tolerance) return end;
    // Snapped nodes unbalance the load.
    end.converged = round < most_snaps;
    if (!end.converged) return end;
    end = run_chain(level, fields, tolerance, problem.effort);
    if (!end.converged) level.gap(p, fields.gap);
  }
}

CellAnswer descend_nest(const CellProblem& problem, const CellStart& start, Monitor& monitor) {
  const bool begun = !start.pressure.empty();
  const bool elsewhere = begun && (start.nx != problem.shape.nx || start.ny != problem.shape.ny);
  const bool gap_known = !start.gap.empty() && !elsewhere;
  const auto restricted = [](const LevelShape& fine, const CoarserGrid& coarse,
                             std::span<const double> field) { return restrict_to(fine, coarse, field); };
  std::vector<NestedGrid> steps = nested_grids(problem, begun, restricted);
  DescentProgress progress(monitor, "contact");
  CellAnswer answer;
  answer.levels = static_cast<int>(steps.size());
  UnsetArray<double> carried;  // level-set field of the coarser grid
  double all_work = 0;
  for (const NestedGrid& step : steps) all_work += step.shape.weight;

  for (std::size_t l = steps.size(); l-- > 0;) {
    NestedGrid& step = steps[l];
    const bool finest = l == 0;
    const PressureLimit limit = limit_on(problem.limit, step);
    const double upper = greatest_pressure(limit);
    const std::span<const double> raw = finest ? problem.heights : std::span<const double>(step.heights);
    ContactLevel level(step.shape, raw, problem.origin, problem.factor, limit, step.mean_pressure);
    level.length = problem.length;
    const double tolerance = finest ? problem.tolerance : std::max(start_tolerance, problem.tolerance);
    level.report = progress.next_grid(step.shape.weight, all_work, tolerance);

    DescentFields fields(step.shape.nodes());
    UnsetArray<double>& p = fields.pressure;
    if (elsewhere) {
      prolong_start(start, upper, level, p);
    } else if (begun) {
      std::copy(start.pressure.begin(), start.pressure.end(), p.begin());
    } else if (carried.empty()) {
      std::fill(p.begin(), p.end(), problem.offset ? 0.0 : step.mean_pressure);
    } else {
      const CoarserGrid& from = *steps[l + 1].from;
      prolong(from, carried, 1 / from.pitch_x, step.shape, p);
      carried = UnsetArray<double>();
    }
    ContactQuality at;
    const DescentEnd end = descend_on_grid(problem, raw, gap_known ? start.gap : std::span<const double>(),
                                           finest, tolerance, level, fields, at, answer.from_peak);
    if (finest) {
      answer.pressure = std::move(p);
      answer.gap = std::move(fields.gap);
      answer.offset = at.offset;
      answer.converged = end.converged;
      answer.applications = level.applications;
      answer.stage = end.stage;
      answer.single = level.compliance.single();
    } else {
      to_level_set(level, upper, level.short_wave_stiffness, at.interior_gap, fields.gap, p);
      carried = std::move(p);
      step.heights = Array<double>();
    }
  }
  return answer;
}

// Exact power of two against underflow of squares and products.
int power_within_range(const CellProblem& problem) {
  constexpr double least = 1e-100;
  const double load = problem.mean_pressure * static_cast<double>(problem.shape.nodes());
  const double pressure = std::min(load, greatest_pressure(problem.limit));
  return pressure > 0 && pressure < least ? -std::ilogb(pressure) / 2 : 0;
}

CellProblem times_power_of_two(const CellProblem& problem, int power) {
  CellProblem result = problem;
  for (double* value : {&result.factor, &result.mean_pressure, &result.length})
    *value = std::ldexp(*value, power);
  if (auto* cap = std::get_if<PressureCap>(&result.limit)) {
    cap->cap = std::ldexp(cap->cap, power);
  } else {
    auto& hardening = std::get<LinearHardening>(result.limit);
    hardening.uniform = std::ldexp(hardening.uniform, power);
    hardening.factor = std::ldexp(hardening.factor, power);
  }
  return result;
}

UnsetArray<double> times_power_of_two(std::span<const double> values, int power) {
  UnsetArray<double> result(values.begin(), values.end());
  for (double& value : result) value = std::ldexp(value, power);
  return result;
}

}  // namespace

std::vector<NestedGrid> nested_grids(const CellProblem& problem, bool alone, const Restrict& restricted) {
  std::vector<NestedGrid> steps(1);
  steps[0].shape = problem.shape;
  steps[0].mean_pressure = problem.mean_pressure;
  const auto* hardening = std::get_if<LinearHardening>(&problem.limit);
  while (!alone) {
    const NestedGrid& fine = steps.back();
    const auto next = coarser(fine.shape);
    if (!next) break;
    const bool finest = steps.size() == 1;
    NestedGrid step;
    step.from = next;
    step.shape = next->shape;
    step.shape.weight = problem.shape.weight * (work(step.shape) / work(problem.shape));
    step.pitch = fine.pitch * next->pitch_x;
    const double cells = static_cast<double>(step.shape.nodes()) * next->pitch_x * next->pitch_y;
    step.mean_pressure =
        fine.mean_pressure * next->pitch_x * (static_cast<double>(fine.shape.nodes()) / cells);
    step.heights =
        restricted(fine.shape, *next, finest ? problem.heights : std::span<const double>(fine.heights));
    if (hardening && hardening->yield)
      step.yield = restricted(fine.shape, *next,
                              finest ? std::span<const double>(hardening->yield, problem.shape.nodes())
                                     : std::span<const double>(fine.yield));
    steps.push_back(std::move(step));
  }
  return steps;
}

CellAnswer nested_descent(const CellProblem& problem, const CellStart& start, Monitor& monitor) {
  // At an offset, heights and pressures are near 1.
  const int power = problem.offset ? 0 : power_within_range(problem);
  if (power == 0) return descend_nest(problem, start, monitor);
  const UnsetArray<double> pressure = times_power_of_two(start.pressure, power),
                           gap = times_power_of_two(start.gap, power);
  CellAnswer answer =
      descend_nest(times_power_of_two(problem, power), {start.nx, start.ny, pressure, gap}, monitor);
  answer.pressure = times_power_of_two(answer.pressure, -power);
  answer.gap = times_power_of_two(answer.gap, -power);
  answer.offset = std::ldexp(answer.offset, -power);
  return answer;
}

CellAnswer full_contact(const CellProblem& problem, Monitor& monitor) {
  ContactLevel level(problem.shape, problem.heights, problem.origin, problem.factor, problem.limit,
                     problem.mean_pressure);
  DescentProgress progress(monitor, "contact");
  return full_contact_on(level, problem, progress);
}

}  // namespace asperity
