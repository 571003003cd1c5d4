// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/nested_descent.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

double rounding_residual(double lengths, double rms, double weight) {
  constexpr double most_roundings = 100, rounding = std::numeric_limits<double>::epsilon() / 2;
  return rms > 0 ? most_roundings * rounding * std::max(1.0, weight) * lengths / rms : 0.0;
}

namespace {

constexpr int message_digits = 3;

std::string unconverged_hint(const Grid& grid, double reached, double rounding) {
  if (reached < rounding)
    return "rounding of the gaps may leave a residual of " + format_short(rounding, 2) +
           " here: give a larger `tolerance`, or accept the best result with on_failure=\"best\"";
  constexpr double much_longer = 4;
  const double aspect = std::max(grid.hx(), grid.hy()) / std::min(grid.hx(), grid.hy());
  if (aspect >= much_longer)
    return "the cells are " + format_short(aspect, message_digits) +
           " times longer than wide: give cells nearer to square or a larger `tolerance`, or accept the best "
           "result with on_failure=\"best\"";
  return "give a larger `tolerance` or more `cells` for the same surface, or accept the best result with "
         "on_failure=\"best\"";
}

std::string pascals(double p) { return format_quantity(p, dimension::pressure); }

void check(const HalfSpaceProblem& problem, double mean_pressure) {
  if (!(mean_pressure >= 0) || !std::isfinite(mean_pressure))
    refuse("`pressure` is " + pascals(mean_pressure),
           "give a finite pressure from zero up: nothing here attracts the bodies");
  if (mean_pressure > 0 && mean_pressure < least_relative * problem.modulus)
    refuse("`pressure` is " + format_short(mean_pressure) +
               " Pa, less than 1e-280 of the contact modulus: too small for doubles",
           "give a larger pressure, or 0");
  const YieldLaw& law = problem.yield;
  const double facing =
      static_cast<double>(known_count(problem.heights->values())) / static_cast<double>(problem.grid.nodes());
  if (law.caps() && mean_pressure >= law.cap * facing) {
    // All digits for equal short forms.
    const bool alike = mean_pressure != law.cap && pascals(mean_pressure) == pascals(law.cap);
    const auto shown = [&](double p) { return alike ? format_exact(p) + " Pa" : pascals(p); };
    if (facing < 1)
      refuse_infeasible("a mean pressure of " + shown(mean_pressure) + " cannot be carried: `hardness` is " +
                            shown(law.cap) + ", and the bodies face each other on " +
                            format_short(100 * facing, message_digits) + " % of the tile",
                        "press with less than " + pascals(law.cap * facing) + ", or give `hardening`");
    refuse_infeasible("a mean pressure of " + shown(mean_pressure) + " cannot be carried: `hardness` is " +
                          shown(law.cap) + ", the most that any node carries",
                      "press with less than the hardness, or give `hardening`");
  }
}

// Length of gaps for flat heights: displacement of the tile as a punch.
double punch_length(const HalfSpaceProblem& problem, double mean_pressure) {
  const double length = mean_pressure / problem.modulus * std::sqrt(problem.grid.area());
  if (!problem.share) return length;
  const double longest = 2 * std::numbers::pi / std::sqrt(problem.grid.area()) * problem.grid.hx();
  return 0.5 * longest * multiplier_of(problem).greatest_from(longest) * length;
}

// Least rms height per approach beyond rounding; on a free tile of the pressures.
double least_roughness(Boundary boundary) { return boundary == Boundary::periodic ? 1e-9 : 1e-6; }

bool rough(const HalfSpaceProblem& problem, double mean_pressure) {
  const auto heights = problem.heights->values();
  const Range ends = known_range(heights);
  if (!(problem.rms > 0) || ends.min == ends.max) return false;
  // An incompressible layer is stiff for long waves: heights may matter at any pressure.
  if (problem.share) return problem.rms > 1e-14 * std::max(std::abs(ends.min), std::abs(ends.max));
  return problem.rms > least_roughness(problem.boundary) * punch_length(problem, mean_pressure);
}

struct CellUnits {
  double height = 1;    // m
  double pressure = 1;  // Pa
  double origin = 0;    // m, the mean height
};

CellUnits cell_units(const HalfSpaceProblem& problem, double mean_pressure, bool flat) {
  CellUnits units;
  units.origin = known_mean(problem.heights->values());
  units.height = flat ? mean_pressure / problem.modulus * problem.grid.hx() : problem.rms;
  units.pressure = problem.modulus * (units.height / problem.grid.hx());
  return units;
}

PressureLimit cell_limit(const YieldLaw& law, const CellUnits& units) {
  if (!law.hardens()) return PressureCap{law.caps() ? law.cap / units.pressure : infinity};
  LinearHardening limit;
  limit.yield = law.yield ? law.yield->data() : nullptr;
  limit.uniform = law.cap / units.pressure;
  limit.factor = 1 / units.pressure;
  limit.compliance = units.pressure / law.hardening / units.height;
  return limit;
}

// √mean(slope²), slightly below the spectral slope.
double rough_slope(const HalfSpaceProblem& problem) {
  const Field& h = *problem.heights;
  const auto nx = static_cast<std::size_t>(h.nx()), ny = static_cast<std::size_t>(h.ny());
  const double per_x = 1 / problem.grid.hx(), per_y = 1 / problem.grid.hy();
  Array<std::array<double, 1>> rows(ny);
  parallel_for(h.ny(), [&](std::int64_t j) {
    const auto number = static_cast<std::size_t>(j);
    const double* const here = h.values().data() + number * nx;
    const double* const above = h.values().data() + (number + 1) % ny * nx;
    const auto term = [=](std::size_t i, std::size_t right) {
      const double x = (here[right] - here[i]) * per_x, y = (above[i] - here[i]) * per_y;
      return x * x + y * y;
    };
    rows[number] = over_stretch<1>(0, nx - 1, [=](std::size_t i, double* v) { v[0] = term(i, i + 1); });
    rows[number][0] += term(nx - 1, 0);
  });
  return std::sqrt(added_up(rows)[0] / static_cast<double>(h.size()));
}

// Missing nodes are set to `there`; `asked` names the input in the error.
Field with_missing_ground_at(const HalfSpaceProblem& problem, double there, const std::string& asked) {
  Field heights = *problem.heights;
  if (!std::isfinite(there))
    refuse(asked + ", too large: the results leave the range of a double", "check its unit");
  for (double& h : heights.values())
    if (std::isnan(h)) h = there;
  return heights;
}

Field with_ground_out_of_reach(const HalfSpaceProblem& problem, double lowest, double mean_pressure) {
  return with_missing_ground_at(problem, lowest - out_of_reach(problem, mean_pressure),
                                "`pressure` is " + pascals(mean_pressure));
}

LevelShape level_shape(const HalfSpaceProblem& problem, bool with_mean) {
  const Grid& grid = problem.grid;
  return {grid.nx,
          grid.ny,
          grid.hy() / grid.hx(),
          problem.boundary,
          problem.weight,
          problem.single,
          multiplier_of(problem, with_mean)};
}

HalfSpaceAnswer first_touch(const HalfSpaceProblem& problem) {
  HalfSpaceAnswer answer;
  answer.pressure = Field(problem.grid.nx, problem.grid.ny);
  const Range ends = known_range(problem.heights->values());
  const double peak = ends.max;
  answer.gap = problem.overhangs ? with_ground_out_of_reach(problem, ends.min, 0) : *problem.heights;
  for (double& g : answer.gap.values()) g = peak - g;
  answer.offset = -peak;
  answer.solver = "first touch";
  certify(problem, answer);
  return answer;
}

// A periodic flat without yield.
bool evenly_loaded(const HalfSpaceProblem& problem, double mean_pressure) {
  return problem.boundary == Boundary::periodic && range(problem.heights->values()).span() == 0 &&
         (!problem.yield.limits() || (!problem.yield.yield && mean_pressure < problem.yield.cap));
}

void add_uniform_compression(const HalfSpaceProblem& problem, HalfSpaceAnswer& answer) {
  const double compression = uniform_compliance(problem) * answer.mean_pressure;
  if (!(compression > 0)) return;
  answer.approach += compression;
  answer.offset += compression;
}

HalfSpaceAnswer even_load(const HalfSpaceProblem& problem, double mean_pressure) {
  HalfSpaceAnswer answer;
  answer.pressure = Field(problem.grid.nx, problem.grid.ny, mean_pressure);
  answer.gap = Field(problem.grid.nx, problem.grid.ny);
  answer.offset = -(*problem.heights)[0];
  answer.mean_pressure = mean_pressure;
  answer.solver = "even pressure of a flat";
  add_uniform_compression(problem, answer);
  certify(problem, answer);
  return answer;
}

HalfSpaceAnswer in_si(const HalfSpaceProblem& problem, const CellUnits& units, double mean_pressure,
                      CellAnswer cell) {
  HalfSpaceAnswer answer;
  const int nx = problem.grid.nx, ny = problem.grid.ny;
  answer.pressure = Field(nx, ny, std::move(cell.pressure));
  answer.gap = Field(nx, ny, std::move(cell.gap));
  const double cap = problem.yield.caps() ? problem.yield.cap : infinity;
  const double cell_cap = problem.yield.caps() ? cap / units.pressure : infinity;
  for_nodes(answer.pressure.size(), [=, offset = cell.offset, pressure = answer.pressure.data(),
                                     gap = answer.gap.data()](std::size_t k) {
    const double p = pressure[k], scaled = p * units.pressure, within = scaled < cap ? scaled : cap;
    pressure[k] = p >= cell_cap ? cap : within;
    gap[k] = (gap[k] - offset) * units.height;
  });
  // Rounding at nodes without a counterpart.
  if (problem.overhangs)
    for (std::size_t k = 0; k < answer.pressure.size(); ++k)
      if (!problem.faces(k)) answer.pressure[k] = 0;
  answer.mean_pressure = mean_pressure;
  const double offset = cell.offset * units.height;
  const double peak = known_range(problem.heights->values()).max;
  answer.approach = cell.from_peak ? offset : (peak - units.origin) + offset;
  answer.offset = cell.from_peak ? offset - peak : offset - units.origin;
  add_uniform_compression(problem, answer);
  answer.iterations = cell.applications;
  answer.solver = cell.stage;
  if (cell.single) answer.solver += " in single precision";
  if (cell.levels > 1) answer.solver += " on " + std::to_string(cell.levels) + " nested grids";
  certify(problem, answer);
  return answer;
}

// The caller replaces NaN heights.
CellProblem cells_under_load(const HalfSpaceProblem& problem, const CellUnits& units, double mean_pressure,
                             bool flat) {
  CellProblem cell;
  cell.shape = level_shape(problem, false);
  cell.heights = problem.heights->values();
  cell.origin = units.origin;
  cell.factor = 1 / units.height;
  cell.limit = cell_limit(problem.yield, units);
  cell.mean_pressure = mean_pressure / units.pressure;
  if (flat) cell.length = std::sqrt(static_cast<double>(cell.shape.nodes()) * cell.shape.aspect);
  // Conversion to pascals adds rounding.
  cell.tolerance = 0.99 * problem.tolerance;
  cell.effort = problem.brief ? ChainEffort::brief : ChainEffort::full;
  return cell;
}

Array<double> in_units(const Field& values, double unit) {
  Array<double> result(values.size());
  for_nodes(result.size(), [&](std::size_t k) { result[k] = values[k] / unit; });
  return result;
}

// Retries in double precision, without a start.
CellAnswer descend(CellProblem& cell, const CellStart& start, Monitor& monitor) {
  CellAnswer found = nested_descent(cell, start, monitor);
  if (!found.single || found.converged) return found;
  const int before = found.applications;
  cell.shape.single = false;
  found = nested_descent(cell, {}, monitor);
  found.applications += before;
  return found;
}

// Each failure multiplies `approach` by 0.3. Only the first solve uses `start`.
HalfSpaceAnswer solve_about_offset(const HalfSpaceProblem& problem, double& approach, HalfSpaceAnswer start,
                                   Monitor& monitor) {
  constexpr double less = 0.3;
  constexpr int tries = 5;
  const int before = start.iterations;
  HalfSpaceAnswer answer = solve_at_offset(problem, approach, infinity, &start, ChainEffort::full, monitor);
  answer.iterations += before;
  for (int n = 0; n < tries && !answer.converged; ++n) {
    if (n > 0) approach *= less;
    const int so_far = answer.iterations;
    answer = solve_at_offset(problem, approach, infinity, nullptr, ChainEffort::full, monitor);
    answer.iterations += so_far;
  }
  return answer;
}

// For soft hardening, where no descent balances the load: searches its approach. Empty if a solve fails.
// `begun`: the unconverged answer.
std::optional<HalfSpaceAnswer> sought_by_approach(const HalfSpaceProblem& problem, double mean_pressure,
                                                  const HalfSpaceAnswer& begun, Monitor& monitor) {
  constexpr int most_solves = 80, most_applications = 2000;
  BracketedSecant root(mean_pressure);
  HalfSpaceAnswer answer = begun;
  double approach = begun.approach;
  for (int solve = 0; solve < most_solves && approach > 0; ++solve) {
    if (answer.iterations - begun.iterations > most_applications) break;
    answer = solve_about_offset(problem, approach, std::move(answer), monitor);
    if (!answer.converged) break;
    const double found = answer.mean_pressure;
    if (std::abs(found - mean_pressure) <= 0.5 * problem.tolerance * mean_pressure) {
      answer.mean_pressure = mean_pressure;
      answer.solver += ", for the load";
      certify(problem, answer);
      if (answer.converged) return answer;
    }
    root.take({approach, found}, true);
    const std::optional<double> next = root.next();
    if (!next) break;
    approach = *next;
  }
  return {};
}

}  // namespace

void throw_unconverged(const std::string& what, const Certificate& reached, double tolerance,
                       int applications, const Grid& grid, double rounding) {
  throw Error(ErrorCode::not_converged,
              what + " reached a residual of " + format_short(reached.worst(), message_digits) +
                  ", above the `tolerance` of " + format_short(tolerance, message_digits) + ", after " +
                  std::to_string(applications) + " applications of the half-space",
              unconverged_hint(grid, reached.worst(), rounding));
}

double rounding_residual(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  double lengths = std::abs(answer.approach) + known_range(problem.heights->values()).span();
  if (problem.yield.hardens() && std::isfinite(problem.yield.cap))  // w is a difference of pressures
    lengths += problem.yield.cap / problem.yield.hardening;
  const double weight =
      problem.yield.caps() && answer.mean_pressure > 0 ? problem.yield.cap / answer.mean_pressure : 1.0;
  return rough(problem, answer.mean_pressure) ? rounding_residual(lengths, problem.rms, weight) : 0.0;
}

double uniform_compliance(const HalfSpaceProblem& problem) {
  return problem.share ? problem.share->length * problem.share->uniform / problem.modulus : 0;
}

ComplianceMultiplier multiplier_of(const HalfSpaceProblem& problem, bool with_mean) {
  if (!problem.share) return {};
  return in_cells(*problem.share, problem.grid.hx(), with_mean);
}

double out_of_reach(const HalfSpaceProblem& problem, double mean_pressure) {
  const Grid& grid = problem.grid;
  // Love's kernel in its own cell, 2/(πE*) (hx asinh(hy/hx) + hy asinh(hx/hy)); asinh x < x.
  const double own = 2 * (grid.hx() + grid.hy()) / (std::numbers::pi * problem.modulus);
  const double give = problem.yield.hardens() ? 1 / problem.yield.hardening : 0.0;
  const double most = mean_pressure * static_cast<double>(grid.nodes());
  const double height = known_range(problem.heights->values()).span();
  return 2 * (height + most * (own + give)) + problem.rms;
}

Certificate certificate_of(const PressureSums& sums, double mean_pressure, double cap, double length) {
  Certificate c;
  if (!(sums.load > 0)) {
    c.load = mean_pressure > 0 ? 1 : 0;
  } else {
    c.complementarity = sums.complementarity / sums.load;
    c.load = std::abs(sums.load / sums.nodes - mean_pressure) / mean_pressure;
    c.tension = std::max(0.0, -sums.least) / mean_pressure;
    c.cap = std::isfinite(cap) ? std::max(0.0, sums.greatest - cap) / cap : 0;
  }
  c.penetration = std::max(0.0, std::isfinite(sums.least_gap) ? -sums.least_gap : 0.0);
  if (length > 0) {
    c.complementarity = std::max(0.0, c.complementarity) / length;
    c.penetration /= length;
  }
  return c;
}

void certify(const HalfSpaceProblem& problem, HalfSpaceAnswer& answer) {
  const YieldLaw& law = problem.yield;
  const double cap = law.caps() ? law.cap : infinity;
  const Field &p = answer.pressure, &g = answer.gap;
  const double per_hardening = law.hardens() ? 1 / law.hardening : 0;
  const bool finite = std::isfinite(cap);
  const double most = finite ? cap : 0.0;
  enum { load, contacts, yielded, energy, capped, least_gap, least_below_cap, least, greatest };
  const auto weigh = [=, &law, hardens = law.hardens(), p = p.values().data(), g = g.values().data()](
                         std::size_t k, double* v) {
    const double pressure = p[k], past = hardens ? pressure - law.yields_at(k) : 0.0;
    const double gap = g[k] + std::max(0.0, past) * per_hardening;
    v[load] = v[least] = pressure;
    v[contacts] = pressure > 0 ? 1.0 : 0.0;
    v[yielded] = past > 0 || pressure >= cap ? 1.0 : 0.0;
    v[energy] = pressure * gap;
    v[capped] = (pressure - (gap > 0 ? 0.0 : most)) * gap;
    v[least_gap] = gap;
    v[least_below_cap] = pressure < cap ? gap : infinity;
    v[greatest] = -pressure;
  };
  const auto found = over_nodes<5, 4>(p.size(), weigh);
  answer.contacts = static_cast<std::int64_t>(found[contacts]);
  answer.yielded = static_cast<std::int64_t>(found[yielded]);
  answer.peak_pressure = -found[greatest];
  const double length =
      rough(problem, answer.mean_pressure) ? problem.rms : punch_length(problem, answer.mean_pressure);
  const double complementarity = finite ? found[capped] : found[energy] - found[least_gap] * found[load];
  answer.certificate = certificate_of({static_cast<double>(p.size()), found[load], found[least],
                                       answer.peak_pressure, complementarity, found[least_below_cap]},
                                      answer.mean_pressure, cap, length);
  answer.converged = answer.certificate.worst() <= problem.tolerance;
}

HalfSpaceAnswer solve_at_offset(const HalfSpaceProblem& problem, double approach, double length,
                                HalfSpaceAnswer* start, ChainEffort effort, Monitor& monitor) {
  const Grid& grid = problem.grid;
  const Range ends = known_range(problem.heights->values());
  CellUnits units;
  units.origin = ends.max;
  units.height = std::min(approach, length);
  if (problem.rms > least_roughness(problem.boundary) * approach)
    units.height = std::min(units.height, problem.rms);
  units.pressure = problem.modulus * (units.height / grid.hx());

  CellProblem cell;
  cell.shape = level_shape(problem, true);
  Field out_of_the_way;
  if (problem.overhangs) {
    // On a free tile deeper nodes never touch.
    cell.lowest = ends.min;
    out_of_the_way = with_missing_ground_at(problem, ends.min - 2 * (approach + ends.span()),
                                            "the approach is " + metres(approach));
  }
  cell.heights = (problem.overhangs ? out_of_the_way : *problem.heights).values();
  cell.origin = units.origin;
  cell.factor = 1 / units.height;
  cell.limit = cell_limit(problem.yield, units);
  cell.offset = approach / units.height;
  // Penetration and opening add up in the certificate.
  cell.tolerance = 0.49 * problem.tolerance;
  const double longest = std::max(static_cast<double>(grid.nx), grid.ny * cell.shape.aspect);
  cell.mean_pressure = std::min(*cell.offset / longest, greatest_pressure(cell.limit));
  cell.effort = effort;
  CellStart begun{grid.nx, grid.ny, {}, {}};
  if (start && start->pressure.size() == grid.nodes()) {
    const std::span<double> pressures = start->pressure.values(), gaps = start->gap.values();
    for_nodes(pressures.size(), [=, p = pressures.data()](std::size_t k) { p[k] /= units.pressure; });
    for_nodes(gaps.size(), [=, before = start->approach, g = gaps.data()](std::size_t k) {
      g[k] = (g[k] + before) / units.height;
    });
    begun.pressure = pressures;
    begun.gap = gaps;
  }
  CellAnswer found = descend(cell, begun, monitor);
  const bool converged = found.converged;
  HalfSpaceAnswer answer = in_si(problem, units, 0, std::move(found));
  answer.approach = approach;
  answer.mean_pressure = block_sum(answer.pressure.values()) / static_cast<double>(grid.nodes());
  certify(problem, answer);
  answer.converged = answer.converged && converged;
  return answer;
}

HalfSpaceAnswer solve_if_full(const HalfSpaceProblem& problem, double mean_pressure, Monitor& monitor) {
  check(problem, mean_pressure);
  const bool flat = !rough(problem, mean_pressure);
  if (problem.boundary != Boundary::periodic || flat || mean_pressure == 0) return {};
  const CellUnits units = cell_units(problem, mean_pressure, flat);
  CellAnswer found = full_contact(cells_under_load(problem, units, mean_pressure, flat), monitor);
  constexpr int as_far_as_gaps = 2;  // applications that include the gaps
  if (found.applications == as_far_as_gaps) return in_si(problem, units, mean_pressure, std::move(found));
  HalfSpaceAnswer none;
  none.iterations = found.applications;
  return none;
}

HalfSpaceAnswer solve_at_pressure(const HalfSpaceProblem& problem, double mean_pressure,
                                  const HalfSpaceAnswer* start, Monitor& monitor) {
  check(problem, mean_pressure);
  if (mean_pressure == 0) return first_touch(problem);
  if (evenly_loaded(problem, mean_pressure)) return even_load(problem, mean_pressure);
  const bool flat = !rough(problem, mean_pressure);
  const CellUnits units = cell_units(problem, mean_pressure, flat);
  const Grid& grid = problem.grid;

  CellProblem cell = cells_under_load(problem, units, mean_pressure, flat);
  Field out_of_the_way;
  if (problem.overhangs) {
    cell.lowest = known_range(problem.heights->values()).min;
    out_of_the_way = with_ground_out_of_reach(problem, cell.lowest, mean_pressure);
    cell.heights = out_of_the_way.values();
  }

  CellAnswer found;
  const bool may_be_full = problem.boundary == Boundary::periodic &&
                           (flat || mean_pressure >= 0.5 * problem.modulus * rough_slope(problem));
  if (may_be_full) found = full_contact(cell, monitor);
  if (!found.converged) {
    const int before = found.applications;
    CellStart warm;
    Array<double> pressure, gap;
    if (start && !start->pressure.empty() && start->mean_pressure > 0) {
      pressure = in_units(start->pressure, units.pressure);
      gap = in_units(start->gap, units.height);
      warm = {start->pressure.nx(), start->pressure.ny(), pressure, gap};
    }
    found = descend(cell, warm, monitor);
    found.applications += before;
  }
  HalfSpaceAnswer answer = in_si(problem, units, mean_pressure, std::move(found));
  if (!answer.converged && problem.yield.hardens() && !problem.brief)
    if (auto sought = sought_by_approach(problem, mean_pressure, answer, monitor)) return std::move(*sought);
  if (!answer.converged && !problem.best_effort)
    throw_unconverged("the contact at " + pascals(mean_pressure), answer.certificate, problem.tolerance,
                      answer.iterations, grid, rounding_residual(problem, answer));
  return answer;
}

}  // namespace asperity
