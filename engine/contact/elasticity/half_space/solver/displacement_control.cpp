// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/displacement_control.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/operator/node_loop.hpp"
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"
#include "engine/contact/elasticity/half_space/solver/load_projection.hpp"
#include "engine/core/arithmetic/bracketed_secant.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

double approach_of_full_contact(const HalfSpaceProblem& problem) {
  return known_range(problem.heights->values()).max - known_mean(problem.heights->values());
}

std::optional<double> pressure_of_full_contact(const HalfSpaceProblem& problem) {
  if (problem.boundary != Boundary::periodic) return {};
  const Grid& grid = problem.grid;
  const Field& h = *problem.heights;
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, problem.weight,
                                 false, multiplier_of(problem));
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

namespace {

// Throws Error{infeasible} where no load gives the approach. Past full contact only ground that hardens gives
// way, and pressures so large that beside them no double holds those of the heights are none.
void check_approach_within_full_contact(const HalfSpaceProblem& problem, double approach) {
  if (problem.boundary != Boundary::periodic) return;
  const auto heights = problem.heights->values();
  const Range span = range(heights);
  const YieldLaw& law = problem.yield;
  const double full = approach_of_full_contact(problem), uniform = uniform_compliance(problem);
  if (uniform > 0) {
    // More load goes on compressing a layer, as far as it is borne.
    const double most = span.span() + uniform * law.cap;
    if (!law.caps() || approach < most) return;
    throw Error(ErrorCode::infeasible,
                "an approach of " + metres(approach) +
                    " cannot be reached: all of this tile is at its hardness at " + metres(most) +
                    ", and carries no more",
                "ask for a smaller `approach`, or press by `pressure`");
  }
  if (law.hardens()) {
    constexpr double greatest_ratio = 1e12;
    const double needed = law.hardening * (approach - full);
    const double held =
        greatest_ratio * problem.modulus * std::max(problem.rms, approach) / problem.grid.hx();
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

// Where all nodes that something faces are at the cap: the greatest approach that is theirs, m, the last of
// them just touching.
std::optional<double> most_at_the_cap(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  if (!problem.yield.caps() ||
      answer.yielded != static_cast<std::int64_t>(known_count(problem.heights->values())))
    return {};
  const auto least = over_nodes<0, 1>(answer.gap.size(), [&](std::size_t k, double* v) {
    v[0] = problem.faces(k) ? -answer.gap[k] : infinity;
  });
  return answer.approach - least[0];
}

// The contact under the least load of full contact. `missed`: of what was prescribed, relative to it.
HalfSpaceAnswer solve_at_full_contact(const HalfSpaceProblem& problem, double mean_pressure, double missed,
                                      Monitor& monitor) {
  HalfSpaceAnswer answer = solve_at_pressure(problem, mean_pressure, nullptr, monitor);
  answer.certificate.load = std::max(answer.certificate.load, missed);
  return answer;
}

// The answer if it converged or the best will do. Throws Error{infeasible} where all nodes are at the cap and
// {not_converged} otherwise; `what` was prescribed.
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
              unconverged_hint(problem.grid, answer.certificate.worst(), rounding_residual(problem, answer)));
}

// Loads on either side of the one that is sought, and what was measured under them, as a search in the
// approach has met them.
struct LoadsMet {
  std::optional<BracketedSecant::Point> below, above;

  void take(BracketedSecant::Point found, double wanted) {
    if (found.value < wanted && (!below || found.at > below->at)) below = found;
    if (found.value > wanted && (!above || found.at < above->at)) above = found;
  }
};

struct SoughtByLoad {
  // Never falls as the load grows.
  std::function<double(const HalfSpaceAnswer&)> measure;
  double wanted = 0;  // > 0, of the measure
  double most =
      infinity;       // of the measure, however much the load; under the cap on all nodes it comes to that
  double length = 0;  // m: an error of so much in a gap is about all that is wanted
  // A load, Pa, under which more is known to be measured, and how much.
  BracketedSecant::Point above = {BracketedSecant::unknown, BracketedSecant::unknown};
  LoadsMet met{};
};

BracketedSecant::Point upper_end(const HalfSpaceProblem& problem, const SoughtByLoad& sought) {
  BracketedSecant::Point end = sought.above;
  if (problem.yield.caps()) {
    const double facing = static_cast<double>(known_count(problem.heights->values()));
    const double cap = problem.yield.cap * (1 - 1e-12) * (facing / static_cast<double>(problem.grid.nodes()));
    if (!(end.at < cap)) end = {cap, sought.most};
  }
  return end;
}

// What `length` takes on a tile that is one punch, or less.
double small_load(const HalfSpaceProblem& problem, double length) {
  return 0.1 * problem.modulus * length / std::max(problem.grid.size_x, problem.grid.size_y);
}

// The load that brings a contact to what is prescribed of it: a bracketed secant in the load, whose solves
// are only as exact as the error that is left asks for and begin from the pressures of the one before (an
// inexact Newton method, Dembo, Eisenstat and Steihaug, SIAM J. Numer. Anal. 19, 1982). Near full contact of
// a periodic tile this is the well-posed way: there the deepest gap goes as a power below one of what the
// approach lacks, and above one of what the load does. `begun`: what was found on the way, from whose
// pressures and mean pressure the search begins if they are any good; or a mean pressure alone. Does not
// throw for lack of convergence.
HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor) {
  constexpr int most_solves = 60, most_applications = 6000;
  constexpr int most_doubts = 4;      // of a bracket
  constexpr double good_start = 0.1;  // a certificate whose load and pressures are worth beginning from
  constexpr double near_start = 0.3;  // of the load, that pressures are taken along
  constexpr double near_if_easy = 2;  // the same, where solves are easy: those take few applications
  constexpr int few_applications = 40;
  constexpr double loosest = 5e-3;     // tolerance of a solve
  constexpr double next_error = 2e-3;  // of the error there is, that the next solve may leave
  // A residual r may leave the deepest gap off by so many times r: complementarity averages over the load,
  // and penetration says nothing of nodes that are open. Seen: 20.
  constexpr double gap_per_residual = 20;
  // A step so much smaller than the error closes a bracket that does not hold what is wanted.
  constexpr double least_step = 0.01;
  const BracketedSecant::Point end = upper_end(problem, sought);
  // A residual of 1, in what is wanted.
  const double unit = problem.rms > 0 ? std::min(problem.rms / sought.length, 1.0) : 1.0;
  HalfSpaceProblem now = problem;
  now.best_effort = true;
  now.tolerance = std::max(problem.tolerance, loosest);
  const BracketedSecant bracket(sought.wanted, {0, 0}, end, BracketedSecant::Scale::logarithmic);
  BracketedSecant root = bracket;
  HalfSpaceAnswer answer = std::move(begun);
  int applications = answer.iterations, doubts = 0;
  bool easy = false;
  // A descent that stalled at the approach has told about how much load that takes.
  double pressure = std::max(answer.mean_pressure, small_load(problem, sought.length));
  for (const auto& met : {sought.met.below, sought.met.above})
    if (met && met->at < end.at) root.take(*met, true);
  if (sought.met.below || sought.met.above) pressure = root.next().value_or(pressure);
  if (!(pressure < end.at)) pressure = 0.5 * end.at;
  double error = infinity;
  for (int solve = 0; solve < most_solves && pressure > 0 && std::isfinite(pressure); ++solve) {
    const double ratio = pressure / answer.mean_pressure;
    const double near = easy ? near_if_easy : near_start;
    const bool warm = answer.certificate.worst() < good_start && ratio > 1 / (1 + near) && ratio < 1 + near;
    const HalfSpaceAnswer start = warm ? std::move(answer) : HalfSpaceAnswer{};
    now.brief = warm && easy;
    answer = solve_at_pressure(now, pressure, warm ? &start : nullptr, monitor);
    applications += answer.iterations;
    if (now.brief && !answer.converged) {  // the pressures it began with may have been in the way
      now.brief = false;
      answer = solve_at_pressure(now, pressure, nullptr, monitor);
      applications += answer.iterations;
    }
    easy = answer.converged && answer.iterations <= few_applications;
    const double found = sought.measure(answer);
    error = std::abs(found / sought.wanted - 1);
    const bool near_enough = error <= 0.5 * problem.tolerance;
    if (near_enough && answer.certificate.worst() <= problem.tolerance) {
      answer.iterations = applications;
      answer.certificate.load = std::max(answer.certificate.load, error);
      answer.converged = true;
      answer.solver += ", load sought";
      return answer;
    }
    const bool tightest = now.tolerance <= problem.tolerance;
    if (applications > most_applications || (near_enough && tightest)) break;
    const double residual = std::max(answer.certificate.worst(), tightest ? 0.0 : now.tolerance);
    const bool sure = error > gap_per_residual * unit * residual || (tightest && answer.converged);
    // Of full contact any more load says the same.
    const bool nothing_more =
        found > sought.wanted && sought.most - found < 0.1 * (sought.most - sought.wanted);
    root.take({pressure, nothing_more ? infinity : found}, sure || nothing_more);
    now.tolerance = std::clamp(next_error * error / unit, problem.tolerance, now.tolerance);
    if (near_enough) continue;  // the same again, by a tighter solve
    const std::optional<double> next = root.next();
    if (!next || std::abs(*next / pressure - 1) < least_step * error) {
      // A loose solve was put on the wrong side.
      if (++doubts > most_doubts || (tightest && !next)) break;
      now.tolerance = std::max(problem.tolerance, least_step * now.tolerance);
      root = bracket;
      root.take({pressure, found}, false);
    }
    pressure = next.value_or(pressure);
  }
  answer.iterations = applications;
  answer.certificate.load = std::max(answer.certificate.load, error);
  answer.converged = false;
  return answer;
}

// The mean pressure that brings a layer to an approach past full contact, in which it is linear there; none
// short of that, where anything may yield, and on a half-space.
std::optional<double> pressure_past_full_contact(const HalfSpaceProblem& problem, double approach) {
  const double uniform = uniform_compliance(problem);
  const double compression = approach - approach_of_full_contact(problem);
  if (!(uniform > 0 && compression > 0) || problem.yield.limits()) return {};
  const double pressure = compression / uniform;
  if (!(known_range(problem.heights->values()).span() > 0)) return pressure;
  const auto full = pressure_of_full_contact(problem);
  return full && pressure >= *full ? std::optional(pressure) : std::nullopt;
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
  check_approach_within_full_contact(problem, approach);
  if (const auto pressure = pressure_past_full_contact(problem, approach)) {
    HalfSpaceAnswer answer = solve_at_pressure(problem, *pressure, nullptr, monitor);
    answer.approach = approach;  // but for rounding
    return answer;
  }
  // Within rounding of full contact: any load from the least on has this approach.
  const double full = approach_of_full_contact(problem);
  const double apart = std::abs(approach - full) / std::min(full, problem.rms);
  const bool rough = known_range(problem.heights->values()).span() > 0;
  if (problem.boundary == Boundary::periodic && uniform_compliance(problem) == 0 && rough &&
      apart <= 0.5 * problem.tolerance)
    if (const auto pressure = pressure_of_full_contact(problem))
      return solve_at_full_contact(problem, *pressure, std::abs(full / approach - 1), monitor);
  // Elastic ground on long cells, where a descent that stalls goes downhill for long.
  const bool quick = !problem.yield.limits() && keeps_line_loads(problem.grid.hy() / problem.grid.hx());
  HalfSpaceAnswer answer = solve_at_offset(problem, approach, infinity, nullptr,
                                           quick ? ChainEffort::quick : ChainEffort::full, monitor);
  if (!answer.converged) {
    SoughtByLoad sought;
    sought.measure = [](const HalfSpaceAnswer& found) { return found.approach; };
    sought.wanted = sought.length = approach;
    if (approach < full && uniform_compliance(problem) == 0)
      if (const auto pressure = pressure_of_full_contact(problem)) sought.above = {*pressure, full};
    answer = solve_by_load(problem, sought, std::move(answer), monitor);
    if (!answer.converged && quick) {
      const int before = answer.iterations;
      HalfSpaceAnswer downhill =
          solve_at_offset(problem, approach, infinity, nullptr, ChainEffort::full, monitor);
      downhill.iterations += before;
      if (downhill.converged) answer = std::move(downhill);
    }
  }
  return met(problem, std::move(answer), "an approach of " + metres(approach));
}

namespace {

// What a node past its yield pressure has given way.
double hardened(const YieldLaw& law, const HalfSpaceAnswer& answer, std::size_t k) {
  return law.hardens() ? std::max(0.0, answer.pressure[k] - law.yields_at(k)) / law.hardening : 0.0;
}

// How far the highest point and the lowest of h − u − w lie below those of h, from u itself: sums of small
// terms where a light load moves little. One application.
double sunk_lightly(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, double approach,
                    Range span) {
  const Field& h = *problem.heights;
  const Grid& grid = problem.grid;
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary, problem.weight,
                                 false, multiplier_of(problem));
  Array<double> u(h.size());
  compliance.apply(answer.pressure.values(), u);
  const double length = grid.hx() / problem.modulus;  // per unit of pressure in cell units
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

}  // namespace

double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  const Field& h = *problem.heights;
  const Field& g = answer.gap;
  const Range span = known_range(h.values());
  if (!(span.span() > 0) || answer.contacts == 0) return 0;
  constexpr double few_digits = 1e-4;
  // What compresses a layer as a whole presses nothing away.
  const double approach = answer.approach - uniform_compliance(problem) * answer.mean_pressure;
  if (approach < few_digits * span.span()) return sunk_lightly(problem, answer, approach, span) / span.span();
  // h − u − w = −(g + w + δ), w what yielded; neither of them where nothing faces the ground.
  const auto ends = over_nodes<0, 2>(h.size(), [&](std::size_t k, double* v) {
    const bool capped = problem.yield.caps() && answer.pressure[k] >= problem.yield.cap;
    const double low = capped ? std::max(0.0, g[k]) : g[k] + hardened(problem.yield, answer, k);
    v[0] = problem.faces(k) ? low : infinity;
    v[1] = problem.faces(k) ? -low : infinity;
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

// Whether a search had better go by the load: near full contact of a periodic tile, where an approach hardly
// tells gaps apart, unless most of it yields, where a load does not.
bool load_tells_more(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  return problem.boundary == Boundary::periodic && 2 * answer.yielded < answer.contacts &&
         2 * answer.contacts > static_cast<std::int64_t>(problem.grid.nodes());
}

// All of the height is pressed away from full contact on: just before it, where full contact is within the
// accuracy of what is asked for.
double wanted_share(double fraction, double accuracy) {
  return fraction >= 1 - 0.9 * accuracy ? 1 - 0.4 * accuracy : fraction;
}

// The answer that flattens by a share, to `accuracy` of it, the search begun at an approach: what is pressed
// away never falls as the approach grows, and nothing but the displacement of the lowest point keeps the two
// apart. Where the load should be sought instead, an answer that did not converge.
// `met`: the loads on either side that it passed.
HalfSpaceAnswer flatten_by_approach(const HalfSpaceProblem& problem, double fraction,
                                    std::optional<double> guess, double accuracy, LoadsMet& met,
                                    Monitor& monitor) {
  constexpr int most_solves = 60;
  // After so many solves, or fewer where they leave as much as `far`, the load is sought from what they met.
  constexpr int most_by_approach = 8, few_by_approach = 4;
  constexpr double far = 1e-2;
  constexpr double loosest = 1e-2, near = 0.3, least_tolerance = 1e-13;
  constexpr double cautious = 20;  // an error, of the certificate there is
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
  now.tolerance = std::max(accuracy, loosest);
  HalfSpaceAnswer answer, before;
  double pressed = 0;
  double gain = 1;  // of what is pressed away, or of an error in it, per approach; at least 1
  bool afresh = false, stalled = false, by_load = false;
  int applications = 0;
  for (int solve = 0; solve < most_solves; ++solve) {
    HalfSpaceAnswer start;
    if (solve > 0 && std::abs(approach / answer.approach - 1) < near) {
      const double steps = (approach - answer.approach) / (answer.approach - before.approach);
      start = further_along(answer, std::move(before), steps);
    }
    before = std::move(answer);
    const ChainEffort effort = afresh ? ChainEffort::full : ChainEffort::brief;
    const bool warm = !start.pressure.empty();
    answer = solve_at_offset(now, approach, 0.5 * wanted, warm ? &start : nullptr, effort, monitor);
    applications += answer.iterations;
    if (warm && !answer.converged && now.tolerance > accuracy) {  // it may have been too far off after all
      answer = solve_at_offset(now, approach, 0.5 * wanted, nullptr, effort, monitor);
      applications += answer.iterations;
    }
    const double pressed_before = std::exchange(pressed, flattened(problem, answer) * span);
    if (solve > 0 && approach != before.approach)
      gain = std::max(1.0, std::abs((pressed - pressed_before) / (approach - before.approach)));
    const double error = std::abs(pressed - wanted) / wanted;
    const bool sure = error > std::min(now.tolerance, cautious * answer.certificate.worst()) * gain;
    if (sure && answer.converged) met.take({answer.mean_pressure, pressed / span}, wanted / span);
    if (load_tells_more(problem, answer)) break;
    const double tightest = std::max(least_tolerance, accuracy / gain);
    const bool loose = now.tolerance > tightest;
    // Tighter than asked for, rounding may be in the way.
    stalled = !answer.converged && (now.tolerance > accuracy || answer.certificate.worst() > accuracy);
    if (stalled) break;
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
    // Where all is pressed away any more approach says the same.
    const bool nothing_more = too_far || (pressed > wanted && span - pressed < 0.1 * (span - wanted));
    root.take({approach, nothing_more ? infinity : pressed}, sure || nothing_more);
    now.tolerance = std::max(tightest, std::min(now.tolerance, (sure ? 0.05 * error : 0.02 * error) / gain));
    if (near_enough && !too_far) continue;  // the same again, by a tighter solve
    by_load = (met.below || met.above) && solve + 1 >= (error > far ? few_by_approach : most_by_approach);
    if (by_load) break;
    const std::optional<double> next = root.next();
    if (!next && !loose) break;
    if (!next) {  // a loose solve was put on the wrong side
      now.tolerance = std::max(tightest, 0.01 * now.tolerance);
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

// The same by its load, from what was `begun`.
HalfSpaceAnswer flatten_by_load(const HalfSpaceProblem& problem, double fraction, HalfSpaceAnswer begun,
                                const LoadsMet& met, Monitor& monitor) {
  SoughtByLoad sought;
  sought.met = met;
  sought.measure = [&](const HalfSpaceAnswer& found) { return flattened(problem, found); };
  sought.wanted = wanted_share(fraction, problem.tolerance);
  sought.most = 1;
  sought.length = fraction * known_range(problem.heights->values()).span();
  if (const auto full = pressure_of_full_contact(problem)) sought.above = {*full, 1};
  return solve_by_load(problem, sought, std::move(begun), monitor);
}

// About where to begin.
struct FlatteningGuess {
  std::optional<double> approach;  // m
  std::optional<double> pressure;  // Pa, where the load is to be sought
};

FlatteningGuess guess_on_coarser_grid(const HalfSpaceProblem& problem, double fraction) {
  constexpr double about = 1e-2;
  std::optional<HalfSpaceProblem> coarse;
  for (auto next = coarser_problem(problem); next; next = coarser_problem(*coarse)) coarse = std::move(next);
  if (!coarse) return {};
  coarse->tolerance = about;
  LoadsMet met;
  HalfSpaceAnswer there = flatten_by_approach(*coarse, fraction, {}, about, met, Monitor::silent());
  const bool by_load = load_tells_more(*coarse, there) || (!there.converged && (met.below || met.above));
  if (by_load) there = flatten_by_load(*coarse, fraction, std::move(there), met, Monitor::silent());
  if (by_load && there.converged) return {{}, there.mean_pressure};
  // Coarser grids miss the highest node. Where that is much of the approach they say little.
  const double higher =
      known_range(problem.heights->values()).max - known_range(coarse->heights->values()).max;
  if (!(there.approach > 2 * higher)) return {};
  return {there.approach + higher, {}};
}

}  // namespace

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
  if (fraction >= 1 - 0.9 * problem.tolerance)
    if (const auto pressure = pressure_of_full_contact(problem))
      return solve_at_full_contact(problem, *pressure, 1 - fraction, monitor);
  const FlatteningGuess guess = guess_on_coarser_grid(problem, fraction);
  HalfSpaceAnswer answer;
  LoadsMet loads;
  if (guess.pressure)
    answer.mean_pressure = *guess.pressure;
  else
    answer = flatten_by_approach(problem, fraction, guess.approach, problem.tolerance, loads, monitor);
  if (!answer.converged) answer = flatten_by_load(problem, fraction, std::move(answer), loads, monitor);
  return met(problem, std::move(answer), "a flattening of " + format_short(fraction));
}

}  // namespace asperity
