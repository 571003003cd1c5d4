// SPDX-License-Identifier: GPL-3.0-or-later
// Presses until a share of the peak-to-valley is flattened. The share never falls as approach or load grow.
// The search is in the approach or, where the approach is insensitive, in the load (load_search.hpp).
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/contact/elasticity/half_space/solver/load_search.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// w of node k, m.
double hardened(const YieldLaw& law, const HalfSpaceAnswer& answer, std::size_t k) {
  return law.hardens() ? std::max(0.0, answer.pressure[k] - law.yields_at(k)) / law.hardening : 0.0;
}

// Flattened height, m, from u itself: all terms are small. One application.
double sunk_lightly(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, double approach,
                    Range span) {
  const Field& h = *problem.heights;
  const Grid& grid = problem.grid;
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, problem.weight,
                                 false, multiplier_of(problem));
  Array<double> u(h.size());
  compliance.apply(answer.pressure.values(), u);
  const double length = grid.hx() / problem.modulus;  // per pressure in cell units
  const auto ends = over_nodes<0, 2>(h.size(), [&](std::size_t k, double* v) {
    const double down = length * u[k] + hardened(problem.yield, answer, k);
    const bool capped = problem.yield.caps() && answer.pressure[k] >= problem.yield.cap;
    const double high = capped ? approach : (span.max - h[k]) + down;
    const double low = capped ? span.span() - approach : (h[k] - span.min) - down;
    v[0] = problem.faces(k) ? high : infinity;
    v[1] = problem.faces(k) ? low : infinity;
  });
  return ends[0] + ends[1];
}

// Depth below the contacting surface, m: −(h − u − w) − δ.
double depth(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, std::size_t k) {
  const bool capped = problem.yield.caps() && answer.pressure[k] >= problem.yield.cap;
  return capped ? std::max(0.0, answer.gap[k]) : answer.gap[k] + hardened(problem.yield, answer, k);
}

// At small approaches gaps have too few digits.
bool presses_lightly(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, Range span) {
  constexpr double few_digits = 1e-4;
  // A layer's uniform compression flattens nothing.
  const double approach = answer.approach - uniform_compliance(problem) * answer.mean_pressure;
  return approach < few_digits * span.span();
}

using namespace search_rules;

constexpr double rough_tolerance = 1e-2;  // of first solves and on coarser grids
constexpr double error_share = 0.05;      // next tolerance per present error

std::optional<double> pressure_that_flattens(const HalfSpaceProblem& problem) {
  if (problem.boundary != Boundary::periodic) return {};
  return problem.yield.hardens() ? load_of_all(problem) : pressure_of_full_contact(problem);
}

constexpr std::size_t coarse_side = 2 * least_side, coarse_nodes = coarse_side * coarse_side;

std::optional<HalfSpaceProblem> coarser_problem(const HalfSpaceProblem& problem) {
  const Grid& grid = problem.grid;
  if (grid.nodes() <= coarse_nodes) return {};
  const LevelShape fine{grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, 1};
  const auto next = coarser(fine);
  if (!next) return {};
  HalfSpaceProblem result = problem;
  const int nx = next->shape.nx, ny = next->shape.ny;
  result.grid = {nx, ny, nx * next->pitch_x * grid.hx(), ny * next->pitch_y * grid.hy()};
  auto on_coarse = [&](const Field& field) {
    Field values(nx, ny);
    const Array<double> restricted = restrict_to(fine, *next, field.values());
    std::copy(restricted.begin(), restricted.end(), values.values().begin());
    return std::make_shared<const Field>(std::move(values));
  };
  result.heights = on_coarse(*problem.heights);
  if (!(known_range(result.heights->values()).span() > 0)) return {};
  if (problem.yield.yield) result.yield.yield = on_coarse(*problem.yield.yield);
  const auto work = [](const Grid& of) {
    const auto n = static_cast<double>(of.nodes());
    return n * elementary::log(n);
  };
  result.weight = problem.weight * work(result.grid) / work(grid);
  return result;
}

// Extrapolates pressures and gaps beyond the first answer by `steps` differences, in the memory of the
// second. Too far: the first.
HalfSpaceAnswer further_along(const HalfSpaceAnswer& last, HalfSpaceAnswer before, double steps) {
  constexpr double furthest_guess = 2;
  if (before.pressure.size() != last.pressure.size() || !(std::abs(steps) <= furthest_guess)) {
    before.pressure = last.pressure;
    before.gap = last.gap;
  } else {
    for_nodes(last.pressure.size(), [=, apart = last.approach - before.approach, p = last.pressure.data(),
                                     g = last.gap.data(), to_p = before.pressure.data(),
                                     to_g = before.gap.data()](std::size_t k) {
      to_p[k] = p[k] == to_p[k] ? p[k] : p[k] + steps * (p[k] - to_p[k]);
      to_g[k] = g[k] + steps * ((g[k] - to_g[k]) + apart);  // of K p − h, from the approach of `last`
    });
  }
  before.approach = last.approach;
  return before;
}

// Near periodic elastic full contact the approach hardly affects gaps.
bool load_tells_more(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  return problem.boundary == Boundary::periodic && 2 * answer.yielded < answer.contacts &&
         2 * answer.contacts > static_cast<std::int64_t>(problem.grid.nodes());
}

bool is_complete(double fraction, double accuracy) { return fraction >= 1 - near_enough_share * accuracy; }

// Complete flattening continues beyond full contact: aim just below, within the accuracy.
double wanted_share(double fraction, double accuracy) {
  return is_complete(fraction, accuracy) ? fraction - (1 - near_enough_share) * accuracy : fraction;
}

// Searches the approach that flattens a share, to `accuracy`; unconverged if the load is the better variable.
// `met`: the nearest loads on both sides.
HalfSpaceAnswer flatten_by_approach(const HalfSpaceProblem& problem, double fraction,
                                    std::optional<double> guess, double accuracy, LoadsMet& met,
                                    Monitor& monitor) {
  constexpr double decades = 1e2, steep = 3;
  const auto heights = problem.heights->values();
  const Range ends = known_range(heights);
  const double span = ends.span();
  const double wanted = wanted_share(fraction, accuracy) * span;
  double approach = guess.value_or(wanted), most = infinity;
  BracketedSecant bracket(wanted);
  if (problem.boundary == Boundary::periodic) {
    const double full = approach_of_full_contact(problem);
    if (!guess) approach = wanted * (1 - wanted / span * (1 - full / span));
    if (!problem.yield.hardens()) {
      most = problem.yield.caps() ? span : full;
      bracket = BracketedSecant(wanted, {0, 0}, {most, span});
      approach = std::min(approach, most * (1 - 1e-6));
    }
  }
  BracketedSecant root = bracket;
  HalfSpaceProblem now = problem;
  now.tolerance = std::max(accuracy, rough_tolerance);
  HalfSpaceAnswer answer, before;
  double pressed = 0, gain = 1;  // flattened height, m, and its change per approach, >= 1
  bool afresh = false, stalled = false, by_load = false;
  int applications = 0, nearly_all_met = 0;
  for (int solve = 0; solve < most_solves; ++solve) {
    HalfSpaceAnswer start;
    if (solve > 0 && std::abs(approach / answer.approach - 1) < near_start) {
      const double steps = (approach - answer.approach) / (answer.approach - before.approach);
      start = further_along(answer, std::move(before), steps);
    }
    before = std::move(answer);
    const ChainEffort effort = afresh ? ChainEffort::full : ChainEffort::brief;
    const bool warm = !start.pressure.empty();
    answer = solve_at_offset(now, approach, 0.5 * wanted, warm ? &start : nullptr, effort, monitor);
    applications += answer.iterations;
    const double pressed_before = std::exchange(pressed, flattened(problem, answer) * span);
    if (solve > 0 && approach != before.approach)
      gain = std::max(1.0, std::abs((pressed - pressed_before) / (approach - before.approach)));
    const double error = std::abs(pressed - wanted) / wanted;
    const bool sure = error > std::min(now.tolerance, gap_per_residual * answer.certificate.worst()) * gain;
    if (sure && answer.converged) met.take({answer.mean_pressure, pressed / span}, wanted / span);
    if (load_tells_more(problem, answer)) break;
    const double tightest = std::max(least_tolerance, accuracy / gain);
    const bool loose = now.tolerance > tightest;
    // Below the requested tolerance a failure may be rounding.
    stalled = !answer.converged && (now.tolerance > accuracy || answer.certificate.worst() > accuracy);
    if (stalled) break;
    const bool near_enough = error <= near_enough_share * accuracy;
    const bool too_far = near_enough && most_at_the_cap(problem, answer);
    if (too_far && now.tolerance > least_tolerance) {
      now.tolerance = std::max(least_tolerance, much_tighter * now.tolerance);
      continue;
    }
    if (near_enough && !loose && !too_far) {
      if (afresh) break;
      afresh = true;
      continue;
    }
    const bool nothing_more = too_far || nearly_all(pressed, wanted, span);
    root.take({approach, nothing_more ? infinity : pressed}, sure || nothing_more);
    now.tolerance = std::max(tightest, std::min(now.tolerance, (sure ? error_share : 0.02) * error / gain));
    if (near_enough && !too_far) continue;
    // Little approach for decades of load or, without a cap, for nearly all of the flattening.
    nearly_all_met += nothing_more && !problem.yield.caps();
    by_load = met.above && (nearly_all_met > (gain > steep ? 0 : 1) ||
                            (met.below && met.above->at > decades * met.below->at &&
                             std::abs(approach / before.approach - 1) < near_start));
    if (by_load) break;
    const std::optional<double> next = root.next();
    if (!next && !loose) break;
    if (!next) {  // a loose solve chose the wrong side
      now.tolerance = std::max(tightest, much_tighter * now.tolerance);
      root = bracket;
    }
    approach = next.value_or(approach);
  }
  if (stalled || by_load || load_tells_more(problem, answer)) {
    answer.converged = false;
    answer.iterations = applications;
    return answer;
  }
  if (!afresh) {
    answer.gap = {};
    HalfSpaceAnswer start = std::move(answer);
    answer = solve_at_offset(now, approach, 0.5 * wanted, &start, ChainEffort::full, monitor);
    applications += answer.iterations;
  }
  answer.iterations = applications;
  answer.certificate.load =
      std::max(answer.certificate.load, std::abs(flattened(problem, answer) / fraction - 1));
  answer.converged = answer.converged && answer.certificate.worst() <= problem.tolerance;
  return answer;
}

HalfSpaceAnswer flatten_by_load(const HalfSpaceProblem& problem, double fraction, HalfSpaceAnswer begun,
                                const LoadsMet& met, Monitor& monitor) {
  SoughtByLoad sought;
  sought.met = met;
  sought.measure = [&](const HalfSpaceAnswer& found) { return flattened(problem, found); };
  sought.wanted = wanted_share(fraction, problem.tolerance);
  sought.of_gaps = true;
  sought.most = 1;
  sought.length = fraction * known_range(problem.heights->values()).span();
  if (const auto full = pressure_that_flattens(problem)) sought.above = {*full, 1};
  return solve_by_load(problem, sought, std::move(begun), monitor);
}

// First load near periodic elastic full contact; empty if the approach serves as well.
std::optional<double> load_near_full_contact(const HalfSpaceProblem& problem, double fraction) {
  constexpr double mostly = 0.6, on_long_cells = 0.3;
  const bool long_cells = keeps_line_loads(problem.grid.hy() / problem.grid.hx());
  if (problem.boundary != Boundary::periodic || fraction < (long_cells ? on_long_cells : mostly)) return {};
  const auto full = pressure_of_full_contact(problem);
  // The remaining height varies about as the square of the missing load.
  return full ? std::optional(*full * (1 - std::sqrt(1 - fraction))) : std::nullopt;
}

// Complete flattening by any sufficient load, with hardening or on a free tile; more load solves more easily.
// Empty if no try converges.
std::optional<HalfSpaceAnswer> press_all_away(const HalfSpaceProblem& problem, double fraction,
                                              Monitor& monitor) {
  constexpr int tries = 3;
  constexpr double more = 4;      // factor of the next load
  constexpr double to_a_rim = 2;  // a punch has half the mean pressure at its centre
  if (problem.yield.caps()) return {};
  auto pressure = load_of_all(problem);
  if (!pressure) return {};
  HalfSpaceProblem now = problem;
  now.brief = now.best_effort = true;
  double load = (problem.boundary == Boundary::periodic ? 1 : to_a_rim) * *pressure;
  int applications = 0;
  for (int n = 0; n < tries; ++n, load *= more) {
    HalfSpaceAnswer answer = solve_at_pressure(now, load, nullptr, monitor);
    applications += answer.iterations;
    const double missed = std::abs(flattened(problem, answer) / fraction - 1);
    if (!answer.converged || missed > problem.tolerance) continue;
    answer.iterations = applications;
    answer.certificate.load = std::max(answer.certificate.load, missed);
    return answer;
  }
  return {};
}

struct FlatteningGuess {
  std::optional<double> approach;  // m
  std::optional<double> pressure;  // Pa, if the better variable
};

FlatteningGuess guess_on_coarser_grid(const HalfSpaceProblem& problem, double fraction) {
  std::optional<HalfSpaceProblem> coarse;
  for (auto next = coarser_problem(problem); next; next = coarser_problem(*coarse)) coarse = std::move(next);
  if (!coarse) return {};
  coarse->tolerance = rough_tolerance;
  LoadsMet met;
  HalfSpaceAnswer there;
  if (const auto load = load_near_full_contact(*coarse, fraction)) {
    there.mean_pressure = *load;
    there = flatten_by_load(*coarse, fraction, std::move(there), met, Monitor::silent());
    if (there.converged) return {{}, there.mean_pressure};
  }
  there = flatten_by_approach(*coarse, fraction, {}, rough_tolerance, met, Monitor::silent());
  const bool by_load = load_tells_more(*coarse, there) || (!there.converged && (met.below || met.above));
  if (by_load) there = flatten_by_load(*coarse, fraction, std::move(there), met, Monitor::silent());
  if (by_load && there.converged) return {{}, there.mean_pressure};
  // Coarser grids miss the top.
  const double higher =
      known_range(problem.heights->values()).max - known_range(coarse->heights->values()).max;
  if (!(there.approach > 2 * higher)) return {};
  return {there.approach + higher, {}};
}

}  // namespace

double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  const Field& h = *problem.heights;
  const Range span = known_range(h.values());
  if (!(span.span() > 0) || answer.contacts == 0) return 0;
  if (presses_lightly(problem, answer, span)) {
    const double approach = answer.approach - uniform_compliance(problem) * answer.mean_pressure;
    return sunk_lightly(problem, answer, approach, span) / span.span();
  }
  const auto ends = over_nodes<0, 2>(h.size(), [&](std::size_t k, double* v) {
    const double low = depth(problem, answer, k);
    v[0] = problem.faces(k) ? low : infinity;
    v[1] = problem.faces(k) ? -low : infinity;
  });
  return 1 - (-ends[1] - ends[0]) / span.span();
}

std::optional<double> load_of_all(const HalfSpaceProblem& problem) {
  const Grid& grid = problem.grid;
  const Field& h = *problem.heights;
  const YieldLaw& law = problem.yield;
  if (problem.overhangs || !(problem.rms > 0)) return {};
  HalfSpaceCompliance compliance(
      grid.nx, grid.ny, grid.hy() / grid.hx(), Boundary::periodic, problem.weight, false,
      problem.boundary == Boundary::periodic ? multiplier_of(problem) : ComplianceMultiplier{});
  const double unit = problem.modulus * (problem.rms / grid.hx());  // Pa, of pressures in cell units
  const double middle = mean(h.values());
  Array<double> p(h.size());
  const auto greatest = [&](auto&& value) {
    return -over_nodes<0, 1>(p.size(), [&](std::size_t k, double* v) { v[0] = -value(k); })[0];
  };
  for_nodes(h.size(), [&](std::size_t k) { p[k] = (h[k] - middle) / problem.rms; });
  compliance.apply_inverse(p, p);
  double least = unit * greatest([&](std::size_t k) { return -p[k]; });
  if (law.hardens()) {
    const double softer = problem.modulus / (law.hardening * grid.hx());  // 1/K_h in cell units
    for_nodes(h.size(), [&](std::size_t k) {
      p[k] = (h[k] - middle) / problem.rms + softer * (law.yields_at(k) / unit);
    });
    compliance.apply_inverse(p, p, softer);
    const double mean_of_it = mean(p);
    const double yielding =
        unit * greatest([&](std::size_t k) { return law.yields_at(k) / unit - (p[k] - mean_of_it); });
    least = std::min(least, yielding);
  }
  return least > 0 && std::isfinite(least) ? std::optional(least * (1 + a_little)) : std::nullopt;
}

HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor) {
  require(fraction >= 0 && fraction <= 1, "flatten", fraction, "", "it is a share from 0 to 1");
  if (fraction == 0) return solve_at_pressure(problem, 0, nullptr, monitor);
  if (const double uniform = uniform_compliance(problem); uniform > 0) {
    HalfSpaceProblem stiff = problem;
    stiff.share->uniform = 0;
    HalfSpaceAnswer answer = solve_at_flattening(stiff, fraction, monitor);
    answer.approach += uniform * answer.mean_pressure;
    answer.offset += uniform * answer.mean_pressure;
    return answer;
  }
  if (is_complete(fraction, problem.tolerance)) {
    if (const auto pressure = pressure_of_full_contact(problem))
      return solve_at_full_contact(problem, *pressure, 1 - fraction, monitor);
    if (auto flat = press_all_away(problem, fraction, monitor)) return std::move(*flat);
  }
  const FlatteningGuess guess = guess_on_coarser_grid(problem, fraction);
  HalfSpaceAnswer answer;
  LoadsMet loads;
  const auto load = guess.pressure ? guess.pressure : load_near_full_contact(problem, fraction);
  if (load) {
    answer.mean_pressure = *load;
    answer = flatten_by_load(problem, fraction, std::move(answer), loads, monitor);
  }
  if (!answer.converged) {
    const int before = answer.iterations;
    answer = flatten_by_approach(problem, fraction, guess.approach, problem.tolerance, loads, monitor);
    answer.iterations += before;
  }
  if (!answer.converged) answer = flatten_by_load(problem, fraction, std::move(answer), loads, monitor);
  return met(problem, std::move(answer), "a flattening of " + format_short(fraction));
}

}  // namespace asperity
