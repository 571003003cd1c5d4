// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/approach_solve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/contact/elasticity/half_space/bracketed_secant.hpp"
#include "engine/contact/elasticity/half_space/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/level_transfer.hpp"
#include "engine/contact/elasticity/half_space/node_loop.hpp"
#include "engine/contact/elasticity/half_space/unconverged.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string metres(double length) { return format_quantity(length, dimension::length); }

// Where all of a periodic tile touches: nothing but the mean of the heights is left to move.
double full_contact(const HalfSpaceProblem& problem) {
  return known_range(problem.heights->values()).max - known_mean(problem.heights->values());
}

// Past full contact of a periodic tile only ground that hardens gives way, and pressures so large that beside
// them no double holds those of the heights are none.
void check_full_contact(const HalfSpaceProblem& problem, double approach) {
  if (problem.boundary != Boundary::periodic) return;
  const auto heights = problem.heights->values();
  const Range span = range(heights);
  const YieldLaw& law = problem.yield;
  const double full = full_contact(problem);
  if (law.hardens()) {
    constexpr double hidden = 1e12;
    const double needed = law.hardening * (approach - full);
    const double held = hidden * problem.modulus * std::max(problem.rms, approach) / problem.grid.hx();
    if (needed <= held || approach <= full) return;
    throw Error(ErrorCode::infeasible,
                "an approach of " + metres(approach) +
                    " cannot be reached: this periodic tile is in full contact at " + metres(full) +
                    ", and past it `hardening` would take a mean pressure of " +
                    format_quantity(needed, dimension::pressure),
                "ask for a smaller `approach`, or give a smaller `hardening`");
  }
  const double most = law.caps() ? span.span() : full;
  if (approach >= most)
    throw Error(ErrorCode::infeasible,
                "an approach of " + metres(approach) +
                    " cannot be reached: this periodic tile is in full contact at " + metres(most) +
                    ", and more load brings it no nearer",
                "ask for a smaller `approach`, or press by `pressure`");
}

bool faces(const HalfSpaceProblem& problem, std::size_t k) {
  return !problem.overhangs || !std::isnan((*problem.heights)[k]);
}

// All nodes that something faces at the cap: the greatest approach that is theirs, the last of them just
// touching.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  if (!problem.yield.caps() ||
      answer.yielded != static_cast<std::int64_t>(known_count(problem.heights->values())))
    return {};
  const auto least = over_nodes<0, 1>(answer.gap.size(), [&](std::size_t k, double* v) {
    v[0] = faces(problem, k) ? -answer.gap[k] : infinity;
  });
  return answer.approach - least[0];
}

// All of a periodic tile pressed flat, where nothing yields: the least load that does it. One application.
std::optional<double> full_contact_pressure(const HalfSpaceProblem& problem) {
  if (problem.boundary != Boundary::periodic) return {};
  const Grid& grid = problem.grid;
  const Field& h = *problem.heights;
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, problem.weight);
  Array<double> p(h.size());
  const double middle = mean(h.values()), unit = problem.modulus * (problem.rms / grid.hx());
  for_nodes(h.size(), [&](std::size_t k) { p[k] = (h[k] - middle) / problem.rms; });
  compliance.apply_inverse(p, p);
  const Range ends = range(p);
  constexpr double a_little_more = 1 + 1e-12;
  const double pressure = -ends.min * a_little_more * unit;
  const YieldLaw& law = problem.yield;
  const double most = law.yield ? range(law.yield->values()).min : law.cap;
  if (law.limits() && !(pressure + ends.max * unit < most)) return {};
  return pressure > 0 && std::isfinite(pressure) ? std::optional(pressure) : std::nullopt;
}

// `missed`: of what was prescribed, relative to it.
HalfSpaceAnswer at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                Monitor& monitor) {
  HalfSpaceAnswer answer = solve_at_pressure(problem, mean_pressure, nullptr, monitor);
  answer.certificate.load = std::max(answer.certificate.load, missed);
  return answer;
}

// Where no descent finds the contact at a given approach, as on some cells much longer than wide: the load
// that brings it, or what else an answer measures that never falls as the load grows. What was found so far,
// `begun`, where no load does. `length`: about the approach.
template <class Measure>
HalfSpaceAnswer sought_by_load(const HalfSpaceProblem& problem, const Measure& measure, double wanted,
                               double length, HalfSpaceAnswer begun, Monitor& monitor) {
  constexpr int most_solves = 30, most_applications = 3000;
  constexpr double near = 0.2;
  const double facing = static_cast<double>(known_count(problem.heights->values()));
  const double highest = problem.yield.caps() ? problem.yield.cap * (1 - 1e-12) *
                                                    (facing / static_cast<double>(problem.grid.nodes()))
                                              : infinity;
  HalfSpaceProblem now = problem;
  now.best_effort = true;
  BracketedSecant root(wanted, {0, 0}, {highest, infinity});
  const double side = std::max(problem.grid.size_x, problem.grid.size_y);
  const bool near_there = begun.certificate.worst() < 0.1;
  double pressure = near_there ? begun.mean_pressure : 0.1 * problem.modulus * length / side;
  pressure = std::min(pressure, 0.5 * highest);
  int applications = begun.iterations;
  HalfSpaceAnswer answer;
  for (int solve = 0; solve < most_solves && pressure > 0 && std::isfinite(pressure); ++solve) {
    const bool warm = solve > 0 && std::abs(pressure / answer.mean_pressure - 1) < near;
    const HalfSpaceAnswer start = warm ? std::move(answer) : HalfSpaceAnswer{};
    answer = solve_at_pressure(now, pressure, warm ? &start : nullptr, monitor);
    applications += answer.iterations;
    if (applications > most_applications) break;
    const double found = measure(answer), error = std::abs(found / wanted - 1);
    if (error <= 0.5 * problem.tolerance && answer.converged) {
      answer.iterations = applications;
      answer.certificate.load = std::max(answer.certificate.load, error);
      answer.solver += ", load sought";
      return answer;
    }
    root.take({pressure, found}, answer.converged || answer.certificate.worst() < 0.1 * error);
    const std::optional<double> next = root.next();
    if (!next) break;
    pressure = *next;
  }
  begun.iterations = applications;
  return begun;
}

HalfSpaceAnswer met(const HalfSpaceProblem& problem, HalfSpaceAnswer answer, const std::string& what) {
  if (const auto most = most_at_the_cap(problem, answer))
    throw Error(ErrorCode::infeasible,
                what + " is not reached: all of the " + (problem.overhangs ? "overlap" : "tile") +
                    " is at its hardness at " + metres(*most) + ", and no more can be had",
                "ask for less, or press by `pressure`");
  if (answer.converged || problem.best_effort) return answer;
  throw Error(ErrorCode::not_converged,
              what + " was sought to a residual of " + format_short(answer.certificate.worst(), 3) +
                  " where `tolerance` asks for " + format_short(problem.tolerance, 3) + ", in " +
                  std::to_string(answer.iterations) + " applications of the half-space",
              unconverged_hint(problem.grid));
}

}  // namespace

HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor) {
  if (!(approach >= 0) || !std::isfinite(approach))
    throw Error(ErrorCode::bad_value, "`approach` is " + metres(approach),
                "an approach is finite and not negative, measured from first touch");
  if (approach == 0) return solve_at_pressure(problem, 0, nullptr, monitor);
  if (approach < 1e-280 * std::max(problem.grid.size_x, problem.grid.size_y))
    throw Error(ErrorCode::bad_value,
                "`approach` is " + format_short(approach) +
                    " m, less than 1e-280 of the tile: no double holds the pressures it takes",
                "give a larger approach, or none");
  check_full_contact(problem, approach);
  // Within rounding of full contact: any load from the least on has this approach.
  const double full = full_contact(problem);
  const double apart = std::abs(approach - full) / std::min(full, problem.rms);
  const bool rough = known_range(problem.heights->values()).span() > 0;
  if (problem.boundary == Boundary::periodic && rough && apart <= 0.5 * problem.tolerance)
    if (const auto pressure = full_contact_pressure(problem))
      return at_full_contact(problem, *pressure, std::abs(full / approach - 1), monitor);
  HalfSpaceAnswer answer = solve_at_offset(problem, approach, infinity, nullptr, true, monitor);
  if (!answer.converged)
    answer = sought_by_load(
        problem, [](const HalfSpaceAnswer& found) { return found.approach; }, approach, approach,
        std::move(answer), monitor);
  return met(problem, std::move(answer), "an approach of " + metres(approach));
}

namespace {

// What a node past its yield pressure has given way.
double hardened(const YieldLaw& law, const HalfSpaceAnswer& answer, std::size_t k) {
  return law.hardens()
             ? std::max(0.0, answer.pressure[k] - (law.yield ? (*law.yield)[k] : law.cap)) / law.hardening
             : 0.0;
}

// How far the highest point and the lowest of h − u − w lie below those of h, from u itself: sums of small
// terms where a light load moves little. One application.
double sunk_lightly(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, Range span) {
  const Field& h = *problem.heights;
  const Grid& grid = problem.grid;
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, problem.weight);
  Array<double> u(h.size());
  compliance.apply(answer.pressure.values(), u);
  const double length = grid.hx() / problem.modulus;  // per unit of pressure in cell units
  const auto ends = over_nodes<0, 2>(h.size(), [&](std::size_t k, double* v) {
    const double down = length * u[k] + hardened(problem.yield, answer, k);
    const bool capped = problem.yield.caps() && answer.pressure[k] >= problem.yield.cap;
    const double high = capped ? answer.approach : (span.max - h[k]) + down;
    const double low = capped ? span.span() - answer.approach : (h[k] - span.min) - down;
    v[0] = faces(problem, k) ? high : infinity;
    v[1] = faces(problem, k) ? low : infinity;
  });
  return ends[0] + ends[1];
}

}  // namespace

double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  const Field& h = *problem.heights;
  const Field& g = answer.gap;
  const Range span = known_range(h.values());
  if (!(span.span() > 0) || answer.contacts == 0) return 0;
  constexpr double few_digits = 1e-4;
  if (answer.approach < few_digits * span.span()) return sunk_lightly(problem, answer, span) / span.span();
  // h − u − w = −(g + w + δ), w what yielded; neither of them where nothing faces the ground.
  const auto ends = over_nodes<0, 2>(h.size(), [&](std::size_t k, double* v) {
    const bool capped = problem.yield.caps() && answer.pressure[k] >= problem.yield.cap;
    const double low = capped ? std::max(0.0, g[k]) : g[k] + hardened(problem.yield, answer, k);
    v[0] = faces(problem, k) ? low : infinity;
    v[1] = faces(problem, k) ? -low : infinity;
  });
  return 1 - (-ends[1] - ends[0]) / span.span();
}

namespace {

// Coarser grids find about where to begin; those of fewer nodes than this are not worth it.
constexpr std::size_t coarse_nodes = 64 * 64;

// The same contact on the next coarser grid.
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
  if (!(known_range(result.heights->values()).span() > 0)) return {};  // all that differs lies between
  if (problem.yield.yield) result.yield.yield = on_coarse(*problem.yield.yield);
  const auto work = [](const Grid& of) {
    const auto n = static_cast<double>(of.nodes());
    return n * elementary::log(n);
  };
  result.weight = problem.weight * work(result.grid) / work(grid);
  return result;
}

// Pressures and gaps on the line through two answers, further along it by `steps` from the second to the
// first; in place of the second. None where that is too far to mean anything.
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

// The answer that flattens by a share, to `accuracy` of it, the search begun at an approach: what is pressed
// away never falls as the approach grows, and nothing but the displacement of the lowest point keeps the two
// apart.
HalfSpaceAnswer flatten_to(const HalfSpaceProblem& problem, double fraction, std::optional<double> guess,
                           double accuracy, Monitor& monitor) {
  constexpr int most_solves = 60;
  constexpr double loosest = 1e-2, near = 0.3, least_tolerance = 1e-13;
  const auto heights = problem.heights->values();
  const Range ends = known_range(heights);
  const double span = ends.span();
  // All of the height is pressed away from full contact on: just before it.
  const double wanted = std::min(fraction, 1 - 0.4 * accuracy) * span;
  double approach = guess.value_or(wanted), most = infinity;
  BracketedSecant bracket(wanted);
  if (problem.boundary == Boundary::periodic) {
    const double full = full_contact(problem);
    if (!guess) approach = wanted * (1 - wanted / span * (1 - full / span));
    if (!problem.yield.hardens()) {
      most = problem.yield.caps() ? span : full;
      bracket = BracketedSecant(wanted, {0, 0}, {most, span});
      approach = std::min(approach, most * (1 - 1e-6));
    }
  }
  BracketedSecant root = bracket;
  HalfSpaceProblem now = problem;
  now.tolerance = std::max(accuracy, loosest);
  HalfSpaceAnswer answer, before;
  double pressed = 0;
  double gain = 1;  // of what is pressed away, or of an error in it, per approach; at least 1
  bool afresh = false;
  int applications = 0;
  for (int solve = 0; solve < most_solves; ++solve) {
    HalfSpaceAnswer start;
    if (solve > 0 && std::abs(approach / answer.approach - 1) < near) {
      const double steps = (approach - answer.approach) / (answer.approach - before.approach);
      start = further_along(answer, std::move(before), steps);
    }
    before = std::move(answer);
    const bool warm = !start.pressure.empty();
    answer = solve_at_offset(now, approach, 0.5 * wanted, warm ? &start : nullptr, afresh, monitor);
    applications += answer.iterations;
    if (warm && !answer.converged && now.tolerance > accuracy) {  // it may have been too far off after all
      answer = solve_at_offset(now, approach, 0.5 * wanted, nullptr, afresh, monitor);
      applications += answer.iterations;
    }
    const double pressed_before = std::exchange(pressed, flattened(problem, answer) * span);
    if (solve > 0 && approach != before.approach)
      gain = std::max(1.0, std::abs((pressed - pressed_before) / (approach - before.approach)));
    const double error = std::abs(pressed - wanted) / wanted;
    const double tightest = std::max(least_tolerance, accuracy / gain);
    const bool loose = now.tolerance > tightest;
    // Tighter than asked for, rounding may be in the way.
    if (!answer.converged && (now.tolerance > accuracy || answer.certificate.worst() > accuracy)) break;
    const bool near_enough = error <= 0.5 * accuracy;
    const bool too_far = near_enough && most_at_the_cap(problem, answer);
    if (too_far && now.tolerance > least_tolerance) {  // perhaps by what the tolerance left
      now.tolerance = std::max(least_tolerance, 0.01 * now.tolerance);
      continue;
    }
    if (near_enough && !loose && !too_far) {
      if (afresh) break;
      afresh = true;
      continue;
    }
    const bool sure = error > now.tolerance * gain;
    root.take({approach, too_far ? infinity : pressed}, sure || too_far);
    now.tolerance = std::max(tightest, std::min(now.tolerance, (sure ? 0.05 * error : 0.02 * error) / gain));
    if (near_enough && !too_far) continue;  // the same again, by a tighter solve
    const std::optional<double> next = root.next();
    if (!next && !loose) break;
    if (!next) {  // a loose solve was put on the wrong side
      now.tolerance = std::max(tightest, 0.01 * now.tolerance);
      root = bracket;
    }
    approach = next.value_or(approach);
  }
  if (!afresh) {
    answer.gap = {};
    HalfSpaceAnswer start = std::move(answer);
    answer = solve_at_offset(now, approach, 0.5 * wanted, &start, true, monitor);
    applications += answer.iterations;
  }
  answer.iterations = applications;
  answer.certificate.load =
      std::max(answer.certificate.load, std::abs(flattened(problem, answer) / fraction - 1));
  answer.converged = answer.converged && answer.certificate.worst() <= problem.tolerance;
  return answer;
}

}  // namespace

HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor) {
  if (!(fraction >= 0 && fraction <= 1))
    throw Error(ErrorCode::bad_value, "`flatten` is " + format_short(fraction), "it is a share from 0 to 1");
  if (fraction == 0) return solve_at_pressure(problem, 0, nullptr, monitor);
  if (fraction >= 1 - 0.4 * problem.tolerance)
    if (const auto pressure = full_contact_pressure(problem))
      return at_full_contact(problem, *pressure, 1 - fraction, monitor);
  std::optional<double> guess;
  std::optional<HalfSpaceProblem> coarse;
  for (auto next = coarser_problem(problem); next; next = coarser_problem(*coarse)) coarse = std::move(next);
  if (coarse) {
    constexpr double about = 1e-2;
    const HalfSpaceAnswer there = flatten_to(*coarse, fraction, {}, about, Monitor::silent());
    // Coarser grids miss the highest node.
    const double higher =
        known_range(problem.heights->values()).max - known_range(coarse->heights->values()).max;
    guess = there.approach + higher;
  }
  HalfSpaceAnswer answer = flatten_to(problem, fraction, guess, problem.tolerance, monitor);
  if (!answer.converged)
    answer = sought_by_load(
        problem, [&](const HalfSpaceAnswer& found) { return flattened(problem, found); },
        std::min(fraction, 1 - 0.4 * problem.tolerance),
        fraction * known_range(problem.heights->values()).span(), std::move(answer), monitor);
  return met(problem, std::move(answer), "a flattening of " + format_short(fraction));
}

}  // namespace asperity
