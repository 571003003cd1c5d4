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
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string metres(double length) { return format_quantity(length, dimension::length); }

// Past full contact of a periodic tile only ground that hardens gives way, and pressures so large that beside
// them no double holds those of the heights are none.
void check_full_contact(const HalfSpaceProblem& problem, double approach) {
  if (problem.boundary != Boundary::periodic) return;
  const auto heights = problem.heights->values();
  const Range span = range(heights);
  const YieldLaw& law = problem.yield;
  const double full = span.max - mean(heights);
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
              "ask for a larger `tolerance`, or press by `pressure`");
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
  return met(problem, solve_at_offset(problem, approach, infinity, nullptr, monitor),
             "an approach of " + metres(approach));
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
    return n * std::log(n);
  };
  result.weight = problem.weight * work(result.grid) / work(grid);
  return result;
}

// The answer that flattens by a share, to `accuracy` of it, the search begun at an approach: what is pressed
// away never falls as the approach grows, and nothing but the displacement of the lowest point keeps the two
// apart.
HalfSpaceAnswer flatten_to(const HalfSpaceProblem& problem, double fraction, std::optional<double> guess,
                           double accuracy, Monitor& monitor) {
  constexpr int most_solves = 60;
  constexpr double loosest = 1e-3, near = 0.3;
  const auto heights = problem.heights->values();
  const Range ends = known_range(heights);
  const double span = ends.span();
  // All of the height is pressed away from full contact on: just before it.
  const double wanted = std::min(fraction, 1 - 0.5 * accuracy) * span;
  double approach = guess.value_or(wanted), most = infinity;
  BracketedSecant bracket(wanted);
  if (problem.boundary == Boundary::periodic && !problem.yield.hardens()) {
    most = problem.yield.caps() ? span : ends.max - mean(heights);
    bracket = BracketedSecant(wanted, {0, 0}, {most, span});
    if (!guess) approach = wanted * (1 - wanted / span * (1 - most / span));
    approach = std::min(approach, most * (1 - 1e-6));
  }
  BracketedSecant root = bracket;
  HalfSpaceProblem now = problem;
  now.tolerance = std::max(accuracy, loosest);
  HalfSpaceAnswer answer;
  int applications = 0;
  for (int solve = 0; solve < most_solves; ++solve) {
    const bool warm = answer.approach > 0 && std::abs(approach / answer.approach - 1) < near;
    HalfSpaceAnswer start = warm ? std::move(answer) : HalfSpaceAnswer{};
    start.gap = {};
    answer = solve_at_offset(now, approach, 0.5 * wanted, warm ? &start : nullptr, monitor);
    applications += answer.iterations;
    const double pressed = flattened(problem, answer) * span;
    const double error = std::abs(pressed - wanted) / wanted;
    const bool loose = now.tolerance > accuracy;
    if (error <= 0.5 * accuracy && !loose) break;
    const bool sure = !loose || error > 2 * now.tolerance;
    root.take({approach, pressed}, sure);
    now.tolerance = std::max(accuracy, std::min(now.tolerance, 0.02 * (sure ? error : now.tolerance)));
    if (error <= 0.5 * accuracy) continue;  // the same again, by a tighter solve
    const std::optional<double> next = root.next();
    if (!next && !loose) break;
    if (!next) {  // a loose solve was put on the wrong side
      now.tolerance = std::max(accuracy, 0.01 * now.tolerance);
      root = bracket;
    }
    approach = next.value_or(approach);
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
  return met(problem, flatten_to(problem, fraction, guess, problem.tolerance, monitor),
             "a flattening of " + format_short(fraction));
}

}  // namespace asperity
