// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_solve.hpp"

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"
#include "engine/contact/elasticity/slabs/slab_descent.hpp"
#include "engine/contact/elasticity/slabs/slab_level.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

std::string pascals(double p) { return format_quantity(p, dimension::pressure); }

void check(const SlabContactProblem& problem, double mean_pressure) {
  if (!(mean_pressure >= 0) || !std::isfinite(mean_pressure))
    refuse("`pressure` is " + pascals(mean_pressure),
           "give a finite pressure from zero up: nothing here attracts the bodies");
  if (mean_pressure > 0 && mean_pressure < 1e-60 * problem.modulus)
    refuse("`pressure` is " + format_short(mean_pressure) +
               " Pa, less than 1e-60 of the contact modulus: too small over ranks",
           "give a larger pressure, or 0");
  if (mean_pressure >= problem.cap)
    refuse_infeasible("a mean pressure of " + pascals(mean_pressure) + " cannot be carried: `hardness` is " +
                          pascals(problem.cap) + ", the most that any node carries",
                      "press with less than the hardness");
}

double punch_length(const SlabContactProblem& problem, double mean_pressure) {
  return mean_pressure / problem.modulus * std::sqrt(problem.surface.grid.area());
}

bool rough(const SlabContactProblem& problem, double mean_pressure) {
  const SlabSurface& surface = problem.surface;
  return surface.rms > 0 && surface.peak > surface.valley &&
         surface.rms > 1e-9 * punch_length(problem, mean_pressure);
}

// Differences within each slab only.
double rough_slope(Team& team, const SlabSurface& surface) {
  const Slab& slab = surface.slab;
  const std::size_t nx = slab.width(), nodes = slab.nodes();
  const double* const h = surface.heights->data();
  const auto term = [=](std::size_t k, double* v) {
    const double x = h[k % nx + 1 < nx ? k + 1 : k + 1 - nx] - h[k];
    const bool has_next = k + nx < nodes;
    const double y = has_next ? h[k + nx] - h[k] : 0.0;
    v[0] = x * x;
    v[1] = y * y;
    v[2] = has_next ? 1.0 : 0.0;
  };
  const auto sums = over_slabs<3, 0>(team, [&] { return over_nodes<3>(nodes, term); });
  const double hx = surface.grid.hx(), hy = surface.grid.hy();
  const double along_x = sums[0] / slab.all_nodes() / (hx * hx);
  const double along_y = sums[2] > 0 ? sums[1] / sums[2] / (hy * hy) : along_x;
  return std::sqrt(along_x + along_y);
}

void certify(Team& team, const SlabContactProblem& problem, SlabContactAnswer& answer) {
  const double cap = problem.cap, peak = problem.surface.peak, mean_pressure = answer.mean_pressure;
  const double *const p = answer.pressure.data(), *const g = answer.gap.data();
  const double* const h = problem.surface.heights->data();
  const bool capped = std::isfinite(cap);
  const auto term = [=, approach = answer.approach](std::size_t k, double* v) {
    const double displacement = g[k] + (approach - (peak - h[k]));
    v[0] = p[k];
    v[1] = p[k] > 0 ? 1.0 : 0.0;
    v[2] = p[k] >= cap ? 1.0 : 0.0;
    v[3] = p[k] * g[k];
    v[4] = !capped ? 0.0 : g[k] > 0 ? p[k] * g[k] : (p[k] - cap) * g[k];
    v[5] = std::max(0.0, g[k]);
    v[6] = (p[k] - mean_pressure) * displacement;  // a uniform pressure displaces nothing
    v[7] = p[k] >= cap ? std::max(0.0, -g[k]) : 0.0;
    v[8] = g[k];
    v[9] = p[k] < cap ? g[k] : infinity;
    v[10] = p[k];
    v[11] = -p[k];
  };
  const auto found = over_slabs<8, 4>(team, [&] { return over_nodes<8, 4>(answer.pressure.size(), term); });
  const double n = problem.surface.slab.all_nodes(), cell = problem.surface.grid.cell_area(),
               total = found[0];
  answer.contacts = static_cast<std::int64_t>(found[1]);
  answer.yielded = static_cast<std::int64_t>(found[2]);
  answer.peak_pressure = -found[11];
  answer.mean_gap = found[5] / n;
  answer.energy = std::max(0.0, 0.5 * found[6] * cell);
  answer.plastic_volume = found[7] * cell;
  const double length =
      rough(problem, mean_pressure) ? problem.surface.rms : punch_length(problem, mean_pressure);
  const double complementarity = capped ? found[4] : found[3] - found[8] * total;
  answer.certificate = certificate_of({n, total, found[10], answer.peak_pressure, complementarity, found[9]},
                                      mean_pressure, cap, length);
  answer.converged = answer.certificate.worst() <= problem.tolerance;
}

// Before first touch, or a flat.
SlabContactAnswer even(Team& team, const SlabContactProblem& problem, double pressure) {
  SlabContactAnswer answer;
  const double peak = problem.surface.peak;
  team.work([&] {
    answer.pressure.assign(problem.surface.slab.nodes(), pressure);
    answer.gap.resize(problem.surface.slab.nodes());
    std::transform(problem.surface.heights->begin(), problem.surface.heights->end(), answer.gap.begin(),
                   [&](double h) { return peak - h; });
  });
  team.agree();
  answer.offset = -peak;
  answer.mean_pressure = pressure;
  answer.solver = pressure > 0 ? "even pressure of a flat" : "first touch";
  certify(team, problem, answer);
  return answer;
}

constexpr double coarse_slab_tolerance = 1e-3;

// `start_pressure` and `start_gap`: cell units, without the offset; empty: nested grids.
CellAnswer nested_descent(Team& team, const CellProblem& problem, std::span<const double> start_pressure,
                          std::span<const double> start_gap, Monitor& monitor) {
  // A process without rows has an empty start.
  const bool warm = team.reduce<1>({static_cast<double>(start_pressure.size())})[0] > 0;
  const double cap = greatest_pressure(problem.limit);
  std::vector<NestedGrid> steps = nested_grids(
      problem, warm, [&](const LevelShape& fine, const CoarserGrid& coarse, std::span<const double> field) {
        return restrict_slabs(team, team.slab(fine.nx, fine.ny), coarse, field);
      });
  DescentProgress progress(monitor, "contact in slabs");
  CellAnswer answer;
  answer.levels = static_cast<int>(steps.size());
  UnsetArray<double> carried;  // level-set field
  double all_work = 0;
  for (const NestedGrid& step : steps) all_work += step.shape.weight;
  for (std::size_t l = steps.size(); l-- > 0;) {
    NestedGrid& step = steps[l];
    const bool finest = l == 0;
    SlabLevel level(team, step.shape, finest ? problem.heights : std::span<const double>(step.heights),
                    problem.origin, problem.factor, cap * step.pitch, step.mean_pressure);
    level.length = problem.length;
    const double tolerance = finest ? problem.tolerance : std::max(coarse_slab_tolerance, problem.tolerance);
    level.report = progress.next_grid(step.shape.weight, all_work, tolerance);

    SlabFields fields(team, level.nodes());
    UnsetArray<double>& p = fields.pressure;
    if (warm) {
      std::copy(start_pressure.begin(), start_pressure.end(), p.begin());
      to_level_set(level, level.cap, level.short_wave_stiffness, 0, start_gap, p);
    } else if (l + 1 == steps.size()) {
      std::fill(p.begin(), p.end(), step.mean_pressure);
    } else {
      const CoarserGrid& from = *steps[l + 1].from;
      prolong_slabs(team, from, carried, 1 / from.pitch_x, level.slab, p);
      carried = UnsetArray<double>();
    }
    project_to_load(level, p.data(), nullptr, level.cap, level.total_load(), SlabLevel::resolves_shifts,
                    p.data());
    DescentEnd end = run_chain(level, fields, tolerance, finest ? ChainEffort::full : ChainEffort::start);
    if (!end.converged) level.gap(p, fields.gap);
    if (finest) {
      answer.from_peak = LightContact(level, fields, problem).refine(end);
      if (std::isfinite(level.cap)) snap_to_bounds(level, level.cap, p);
    }
    const ContactQuality at = contact_quality(level, p, fields.gap);
    if (finest) {
      answer.pressure = std::move(p);
      answer.gap = std::move(fields.gap);
      answer.offset = at.offset;
      answer.converged = end.converged;
      answer.applications = level.applications;
      answer.stage = end.stage;
    } else {
      to_level_set(level, level.cap, level.short_wave_stiffness, at.interior_gap, fields.gap, p);
      carried = std::move(p);
      step.heights = Array<double>();
    }
  }
  return answer;
}

constexpr int most_solves = 60;
constexpr double least_nodes = 64 * 64;

// Heights keep their origin.
std::optional<SlabContactProblem> coarser_problem(Team& team, const SlabContactProblem& problem) {
  const SlabSurface& fine = problem.surface;
  if (fine.slab.all_nodes() <= least_nodes) return {};
  const auto next = coarser({fine.grid.nx, fine.grid.ny, fine.grid.hy() / fine.grid.hx()});
  if (!next) return {};
  SlabContactProblem result = problem;
  SlabSurface& surface = result.surface;
  surface.grid.nx = next->shape.nx;
  surface.grid.ny = next->shape.ny;
  surface.slab = team.slab(next->shape.nx, next->shape.ny);
  Array<double> heights = restrict_slabs(team, fine.slab, *next, *fine.heights);
  std::array<double, 2> own{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const double h : heights) own = {std::min(own[0], h), std::min(own[1], -h)};
  team.work([&] { surface.heights = std::make_shared<const Array<double>>(std::move(heights)); });
  const auto ends = team.reduce<0, 2>(own);
  surface.valley = ends[0];
  surface.peak = -ends[1];
  result.best_effort = true;
  return result;
}

struct Root {
  double logarithm = 0;  // of the load
  double slope = 0;      // d approach / d ln load; 0 if unknown
};

struct Found {
  SlabContactAnswer answer;
  Root root;
  bool reached = false;
};

// `target`: approach [m] from first touch at `peak`.
Found search(Team& team, const SlabContactProblem& problem, double target, double peak, Root root,
             double accuracy, Monitor& monitor) {
  SlabContactProblem now = problem;
  now.best_effort = true;
  const double share = std::min(1.0, target / problem.surface.rms);
  now.tolerance = std::max(1e-13, 0.2 * std::min(problem.tolerance, accuracy) * share);
  const double highest = elementary::log(problem.cap) - 1e-12;  // infinite without cap
  double low = -infinity, high = infinity, low_excess = 0, high_excess = 0;
  Found found;
  double x = std::min(root.logarithm, highest), last_x = x, last_excess = 0;
  for (int solve = 0; solve < most_solves; ++solve) {
    found.answer =
        solve_slabs_at_pressure(team, now, elementary::exp(x), solve > 0 ? &found.answer : nullptr, monitor);
    const double excess = found.answer.offset + peak - target;
    if (solve > 0 && x != last_x) {
      const double slope = (excess - last_excess) / (x - last_x);
      if (slope > 0) root.slope = slope;
    }
    root.logarithm = x;
    if (std::abs(excess) <= accuracy * target) {
      found.reached = true;
      break;
    }
    (excess < 0 ? low : high) = x;
    (excess < 0 ? low_excess : high_excess) = excess;
    last_x = x;
    last_excess = excess;
    if (excess < 0 && x >= highest) break;
    constexpr double furthest = 3;
    double next =
        root.slope > 0 ? x - std::clamp(excess / root.slope, -furthest, furthest) : x + (excess < 0 ? 1 : -1);
    if (std::isfinite(low) && std::isfinite(high)) {
      const double margin = 1e-3 * (high - low);
      if (!(next > low && next < high)) next = low - low_excess * (high - low) / (high_excess - low_excess);
      next = solve % 4 == 3 ? 0.5 * (low + high) : std::clamp(next, low + margin, high - margin);
      if (high - low < 1e-14 * std::abs(high)) break;
    }
    x = std::min(next, highest);
    if (std::abs(x) > 600) break;
  }
  found.root = root;
  return found;
}

}  // namespace

SlabContactAnswer solve_slabs_at_pressure(Team& team, const SlabContactProblem& problem, double mean_pressure,
                                          const SlabContactAnswer* start, Monitor& monitor) {
  check(problem, mean_pressure);
  const SlabSurface& surface = problem.surface;
  const Grid& grid = surface.grid;
  if (mean_pressure == 0 || surface.peak == surface.valley) return even(team, problem, mean_pressure);
  const bool flat = !rough(problem, mean_pressure);
  const double height = flat ? mean_pressure / problem.modulus * grid.hx() : surface.rms;
  const double unit = problem.modulus * (height / grid.hx());  // of pressures, Pa

  CellProblem cell;
  cell.shape = {grid.nx, grid.ny, grid.hy() / grid.hx()};
  cell.heights = *surface.heights;
  cell.origin = surface.mean;
  cell.factor = 1 / height;
  const double cap = problem.cap / unit;
  cell.limit = PressureCap{cap};
  cell.mean_pressure = mean_pressure / unit;
  if (flat) cell.length = std::sqrt(surface.slab.all_nodes() * cell.shape.aspect);
  // Conversion to pascals adds rounding.
  cell.tolerance = 0.99 * problem.tolerance;
  CellAnswer found;
  if (flat || mean_pressure >= 0.5 * problem.modulus * rough_slope(team, surface)) {
    SlabLevel level(team, cell.shape, cell.heights, cell.origin, cell.factor, cap, cell.mean_pressure);
    DescentProgress progress(monitor, "contact in slabs");
    found = full_contact_on(level, cell, progress);
  }
  if (!found.converged) {
    const int before = found.applications;
    found = {};
    UnsetArray<double> pressure, gap;
    if (start != nullptr && start->mean_pressure > 0) {
      team.work([&] {
        pressure = start->pressure;
        gap = start->gap;
        for (double& p : pressure) p /= unit;
        for (double& g : gap) g /= height;
      });
      team.agree();
    }
    found = nested_descent(team, cell, pressure, gap, monitor);
    found.applications += before;
  }
  SlabContactAnswer answer;
  answer.mean_pressure = mean_pressure;
  for (double& p : found.pressure) p = p >= cap ? problem.cap : std::min(p * unit, problem.cap);
  for (double& g : found.gap) g = (g - found.offset) * height;
  answer.pressure = std::move(found.pressure);
  answer.gap = std::move(found.gap);
  const double offset = found.offset * height;
  answer.approach = found.from_peak ? offset : (surface.peak - surface.mean) + offset;
  answer.offset = found.from_peak ? offset - surface.peak : offset - surface.mean;
  answer.iterations = found.applications;
  answer.solver = found.stage;
  if (found.levels > 1) answer.solver += " on " + std::to_string(found.levels) + " nested grids";
  certify(team, problem, answer);
  if (!answer.converged && !problem.best_effort) {
    const double weight = std::isfinite(problem.cap) ? problem.cap / mean_pressure : 1.0;
    throw_unconverged("the contact at " + format_quantity(mean_pressure, dimension::pressure),
                      answer.certificate, problem.tolerance, answer.iterations, problem.surface.grid,
                      rounding_residual(std::abs(answer.approach), flat ? 0.0 : height, weight));
  }
  return answer;
}

SlabTerms slab_terms(const std::optional<Material>& lower, const Material& upper, const Effects& effects) {
  SurfaceTraits traits;
  traits.material = lower;
  // One node for the bodies: only materials matter.
  Scene scene{Surface({1, 1, 1, 1}, Field(1, 1), std::move(traits)), upper, Boundary::periodic,
              HalfSpaceOptions{}};
  scene.effects = effects;
  check(scene);
  const ContactGeometry geometry(scene, LatticeIsometry(1, 1));
  const Plan plan = make_plan(scene, geometry);
  SlabTerms terms{plan.elasticity->modulus, std::numeric_limits<double>::infinity()};
  if (plan.yield) {
    if (plan.yield->hardens())
      refuse("`effects." + effect_names(Effect::Acts::bounds_pressure).front() +
                 ".hardening` is not computed over ranks",
             "leave it out, so that the pressure stays at the hardness, or use lab.contact");
    terms.cap = plan.yield->hardness();
  }
  return terms;
}

// Load of a given approach: bracketed secant over ln(load), on the next coarser grid, then on the finest,
// each solve from the last.
SlabContactAnswer solve_slabs_at_approach(Team& team, const SlabContactProblem& problem, double approach,
                                          Monitor& monitor) {
  if (!(approach >= 0) || !std::isfinite(approach))
    refuse("`approach` is " + metres(approach), "give zero or a length above it");
  if (approach == 0) return solve_slabs_at_pressure(team, problem, 0, nullptr, monitor);
  const SlabSurface& surface = problem.surface;
  const double full = surface.peak - surface.mean;
  if (!std::isfinite(problem.cap) && approach >= full)
    refuse_infeasible("`approach` is " + metres(approach) +
                          ", and this periodic tile is in full contact at " + metres(full),
                      "give a smaller `approach`, or press by `pressure`");
  Root root;
  root.logarithm =
      elementary::log(0.1 * problem.modulus * approach / std::max(surface.grid.size_x, surface.grid.size_y));
  constexpr double light = 0.2, rough_accuracy = 1e-3;
  if (approach > light * surface.rms)
    if (const auto coarse = coarser_problem(team, problem))
      root = search(team, *coarse, approach, surface.peak, root, rough_accuracy, monitor).root;
  Found found = search(team, problem, approach, surface.peak, root, problem.tolerance, monitor);
  SlabContactAnswer& answer = found.answer;
  answer.certificate.load = std::abs(answer.approach - approach) / approach;
  answer.converged = answer.certificate.worst() <= problem.tolerance;
  if (!found.reached && answer.approach < approach && std::isfinite(problem.cap))
    refuse_infeasible("`approach` is " + metres(approach) +
                          ", and the greatest load that `hardness` allows reaches " + metres(answer.approach),
                      "give a smaller `approach`, or press by `pressure`");
  if (!answer.converged && !problem.best_effort)
    throw Error(ErrorCode::not_converged,
                "the approach of " + metres(approach) + " was missed by " +
                    metres(answer.approach - approach) + " with a residual of " +
                    format_short(answer.certificate.worst(), 3) + ", above the `tolerance` of " +
                    format_short(problem.tolerance, 3),
                "give a larger `tolerance`, or accept the best result with on_failure=\"best\"");
  return std::move(found.answer);
}

}  // namespace asperity
