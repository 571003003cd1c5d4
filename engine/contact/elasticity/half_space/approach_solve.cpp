// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/approach_solve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/level_transfer.hpp"
#include "engine/contact/elasticity/half_space/node_loop.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_solves = 80;
// Roots are sought on grids of at least so many nodes.
constexpr std::size_t coarse_nodes = 64 * 64;

// What is prescribed: a measure of an answer that never falls as the load rises, 0 at first touch.
struct Prescribed {
  std::function<double(const HalfSpaceProblem&, const HalfSpaceAnswer&)> measure;
  double target = 0;
  double sharpness = 1;  // of the solves: their tolerance for each of the measure's
  std::string what;      // "`approach` of 3 um"
};

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
  if (problem.yield.yield) result.yield.yield = on_coarse(*problem.yield.yield);
  result.best_effort = true;
  result.tolerance = infinity;
  return result;
}

struct Root {
  double pressure = 0;
  double slope = 1.5;  // d ln p̄ / d ln measure
};

// A pressure that presses about a tenth of the rms roughness flat, to begin with where no grid is coarser.
double first_guess(const HalfSpaceProblem& problem, double target_approach) {
  const double side = std::max(problem.grid.size_x, problem.grid.size_y);
  const double guess = 0.1 * problem.modulus * target_approach / side;
  return problem.yield.caps() ? std::min(guess, 0.5 * problem.yield.cap) : guess;
}

struct Tried {
  double pressure = 0, measure = 0;
};

struct Search {
  HalfSpaceAnswer answer;
  Root root;
  bool reached = false;
};

Search search(const HalfSpaceProblem& problem, const Prescribed& wanted, Root root, double accuracy,
              double loosest, Monitor& monitor) {
  const double highest = problem.yield.caps() ? problem.yield.cap * (1 - 1e-12) : infinity;
  HalfSpaceProblem now = problem;
  now.best_effort = true;
  const double tightest = std::min(problem.tolerance, std::max(accuracy * wanted.sharpness, 1e-13));
  now.tolerance = std::max(tightest, loosest);
  Tried low, high{infinity, infinity};
  Tried last;  // by a solve as tight; no pressure: none
  Search result;
  result.root = root;
  double pressure = std::min(root.pressure, highest);
  for (int solve = 0; solve < most_solves; ++solve) {
    const HalfSpaceAnswer* start = result.answer.pressure.empty() ? nullptr : &result.answer;
    // Only a near state is worth starting from; a far one is found quicker on nested grids.
    if (start && std::abs(std::log(pressure / start->mean_pressure)) > 0.2) start = nullptr;
    result.answer = solve_at_pressure(now, pressure, start, monitor);
    const Tried at{pressure, wanted.measure(problem, result.answer)};
    const double error = std::abs(at.measure - wanted.target) / wanted.target;
    if (error <= accuracy && now.tolerance <= tightest) {
      result.root.pressure = pressure;
      result.reached = true;
      return result;
    }
    if (last.pressure > 0 && at.pressure != last.pressure && at.measure > 0 && last.measure > 0 &&
        at.measure != last.measure) {
      const double slope = std::log(at.pressure / last.pressure) / std::log(at.measure / last.measure);
      if (slope > 0 && std::isfinite(slope)) result.root.slope = slope;
    }
    last = at;
    const double tighter = std::max(tightest, std::min(now.tolerance, 0.01 * error));
    if (error <= accuracy) {  // right by a loose solve: the same load again, to the end
      now.tolerance = tightest;
      continue;
    }
    if (tighter < now.tolerance) {
      // What a looser solve put on one side may belong to the other.
      low = {};
      high = {infinity, infinity};
      last = {};
    } else if (at.measure < wanted.target) {
      low = at.pressure > low.pressure ? at : low;
    } else {
      high = at.pressure < high.pressure ? at : high;
    }
    now.tolerance = tighter;
    double next = at.measure > 0 ? pressure * std::pow(wanted.target / at.measure,
                                                       std::clamp(result.root.slope, 0.05, 50.0))
                                 : 4 * pressure;
    next = std::clamp(next, pressure / 100, pressure * 100);
    const bool bracketed = high.pressure < infinity && low.pressure > 0;
    if (bracketed && !(next > low.pressure && next < high.pressure))
      next = std::sqrt(low.pressure) * std::sqrt(high.pressure);
    else if (next >= high.pressure)
      next = 0.5 * high.pressure;
    else if (next <= low.pressure)
      next = 2 * low.pressure;
    if (next >= highest) next = pressure + 0.5 * (highest - pressure);
    if (next == pressure || !(next > 0) || !std::isfinite(next)) break;
    if (bracketed && high.pressure <= low.pressure * (1 + 4e-16)) break;
    pressure = next;
  }
  result.root.pressure = pressure;
  return result;
}

HalfSpaceAnswer solve_for(const HalfSpaceProblem& problem, const Prescribed& wanted, double length,
                          Monitor& monitor) {
  if (wanted.target == 0) return solve_at_pressure(problem, 0, nullptr, monitor);
  std::vector<HalfSpaceProblem> grids;
  for (auto next = coarser_problem(problem); next; next = coarser_problem(grids.back()))
    grids.push_back(std::move(*next));
  Root root{first_guess(problem, length), 1.5};
  for (std::size_t g = grids.size(); g-- > 0;) {
    const Search found = search(grids[g], wanted, root, 1e-2, 1e-2, Monitor::silent());
    if (found.reached) root = found.root;
    grids.pop_back();
  }
  Search found = search(problem, wanted, root, problem.tolerance, 1e-4, monitor);
  HalfSpaceAnswer& answer = found.answer;
  const double measure = wanted.measure(problem, answer);
  answer.certificate.load =
      std::max(answer.certificate.load, std::abs(measure - wanted.target) / wanted.target);
  answer.converged = answer.certificate.worst() <= problem.tolerance;
  answer.solver += ", load sought";
  if (answer.converged || problem.best_effort) return std::move(answer);
  if (measure < wanted.target && answer.certificate.load > problem.tolerance)
    throw Error(ErrorCode::infeasible,
                wanted.what + " is not reached: a mean pressure of " +
                    format_quantity(answer.mean_pressure, dimension::pressure) + " brings " +
                    format_short(100 * measure / wanted.target, 6) + " % of it, and no more can be had",
                "ask for less, or press by `pressure`");
  throw Error(ErrorCode::not_converged,
              wanted.what + " was met to " + format_short(answer.certificate.load, 3) +
                  " with a contact residual of " + format_short(answer.certificate.worst(), 3) +
                  " where `tolerance` asks for " + format_short(problem.tolerance, 3),
              "ask for a larger `tolerance`");
}
}  // namespace

HalfSpaceAnswer solve_at_approach(const HalfSpaceProblem& problem, double approach, Monitor& monitor) {
  if (!(approach >= 0) || !std::isfinite(approach))
    throw Error(ErrorCode::bad_value, "`approach` is " + format_quantity(approach, dimension::length),
                "an approach is finite and not negative, measured from first touch");
  const auto heights = problem.heights->values();
  const Range span = range(heights);
  if (problem.boundary == Boundary::periodic && !problem.yield.hardens()) {
    const double most = problem.yield.caps() ? span.span() : span.max - mean(heights);
    if (approach > most || (approach == most && !(approach == 0)))
      throw Error(ErrorCode::infeasible,
                  "an approach of " + format_quantity(approach, dimension::length) +
                      " cannot be reached: this periodic tile is in full contact at " +
                      format_quantity(most, dimension::length) + ", and more load brings it no nearer",
                  "ask for a smaller `approach`, or press by `pressure`");
  }
  Prescribed wanted;
  // Coarser grids miss the highest node: their approach is counted from it all the same.
  wanted.measure = [peak = span.max](const HalfSpaceProblem& on, const HalfSpaceAnswer& answer) {
    return answer.approach + (peak - range(on.heights->values()).max);
  };
  wanted.target = approach;
  if (problem.rms > 0) wanted.sharpness = 0.5 * std::min(1.0, approach / problem.rms);
  wanted.what = "an approach of " + format_quantity(approach, dimension::length);
  return solve_for(problem, wanted, approach, monitor);
}

double flattened(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer) {
  const Field& h = *problem.heights;
  const Field& g = answer.gap;
  const YieldLaw& law = problem.yield;
  // h − u − w = −(g + w + δ), w what yielded.
  const auto closed = [&](std::size_t k) {
    const double p = answer.pressure[k];
    if (law.hardens())
      return g[k] + std::max(0.0, p - (law.yield ? (*law.yield)[k] : law.cap)) / law.hardening;
    return p >= law.cap ? std::max(0.0, g[k]) : g[k];
  };
  const auto ends = over_nodes<0, 4>(h.size(), [&](std::size_t k, double* v) {
    v[0] = h[k];
    v[1] = -h[k];
    v[2] = closed(k);
    v[3] = -v[2];
  });
  const double before = -ends[1] - ends[0], after = -ends[3] - ends[2];
  return before > 0 ? 1 - after / before : 0;
}

HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor) {
  if (!(fraction >= 0 && fraction <= 1))
    throw Error(ErrorCode::bad_value, "`flatten` is " + format_short(fraction), "it is a share from 0 to 1");
  Prescribed wanted;
  wanted.measure = [](const HalfSpaceProblem& on, const HalfSpaceAnswer& answer) {
    return flattened(on, answer);
  };
  wanted.target = fraction;
  wanted.sharpness = 0.5 * fraction;
  wanted.what = "a flattening of " + format_short(fraction);
  return solve_for(problem, wanted, fraction * range(problem.heights->values()).span(), monitor);
}

}  // namespace asperity
