// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/load_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/constants.hpp"

namespace asperity {

namespace {
constexpr int most_solves = 60, most_applications = 6000;
constexpr int most_doubts = 4;       // of a bracket
constexpr double good_start = 0.1;   // a certificate whose load and pressures are worth beginning from
constexpr double near_start = 0.3;   // of the load, that pressures are taken along
constexpr double loosest = 5e-3;     // tolerance of a solve
constexpr double next_error = 2e-3;  // of the error there is, that the next solve may leave
// A residual r may leave the deepest gap off by so many times r: complementarity averages over the load, and
// penetration says nothing of nodes that are open. Seen: 20.
constexpr double gap_per_residual = 20;
// A step so much smaller than the error closes a bracket that does not hold what is wanted.
constexpr double least_step = 0.01;

BracketedSecant::Point upper_end(const HalfSpaceProblem& problem, const SoughtByLoad& sought) {
  BracketedSecant::Point end = sought.above;
  if (problem.yield.caps()) {
    const double facing = static_cast<double>(known_count(problem.heights->values()));
    const double cap = problem.yield.cap * (1 - 1e-12) * (facing / static_cast<double>(problem.grid.nodes()));
    if (!(end.at < cap)) end = {cap, BracketedSecant::unknown};
  }
  return end;
}

// What `length` takes on a tile that is one punch, or less.
double small_load(const HalfSpaceProblem& problem, double length) {
  return 0.1 * problem.modulus * length / std::max(problem.grid.size_x, problem.grid.size_y);
}
}  // namespace

HalfSpaceAnswer solve_by_load(const HalfSpaceProblem& problem, const SoughtByLoad& sought,
                              HalfSpaceAnswer begun, Monitor& monitor) {
  const BracketedSecant::Point end = upper_end(problem, sought);
  // A residual of 1, in what is wanted.
  const double unit = problem.rms > 0 ? std::min(problem.rms / sought.length, 1.0) : 1.0;
  HalfSpaceProblem now = problem;
  now.best_effort = true;
  now.tolerance = std::max(problem.tolerance, loosest);
  const BracketedSecant bracket(sought.wanted, {0, 0}, end);
  BracketedSecant root = bracket;
  HalfSpaceAnswer answer = std::move(begun);
  int applications = answer.iterations, doubts = 0;
  double pressure = answer.certificate.worst() < good_start && answer.mean_pressure > 0
                        ? answer.mean_pressure
                        : small_load(problem, sought.length);
  if (!(pressure < end.at)) pressure = 0.5 * end.at;
  double error = infinity;
  for (int solve = 0; solve < most_solves && pressure > 0 && std::isfinite(pressure); ++solve) {
    const bool warm =
        answer.certificate.worst() < good_start && std::abs(pressure / answer.mean_pressure - 1) < near_start;
    const HalfSpaceAnswer start = warm ? std::move(answer) : HalfSpaceAnswer{};
    answer = solve_at_pressure(now, pressure, warm ? &start : nullptr, monitor);
    applications += answer.iterations;
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
    root.take({pressure, found}, sure);
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

}  // namespace asperity
