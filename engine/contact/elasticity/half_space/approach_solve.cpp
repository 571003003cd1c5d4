// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/approach_solve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/elasticity/half_space/half_space_compliance.hpp"
#include "engine/contact/elasticity/half_space/level_transfer.hpp"
#include "engine/contact/elasticity/half_space/node_loop.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {
constexpr int most_solves = 80;
// Roots are sought on grids of at least so many nodes.
constexpr std::size_t coarse_nodes = 64 * 64;

// What is prescribed: a measure of an answer that never falls as the load rises, 0 at first touch.
struct WantedLength {
  std::function<double(const HalfSpaceProblem&, const HalfSpaceAnswer&)> measure;
  double target = 0;
  double length = 1;     // how far the bodies must close for each of the measure, where nothing gives way
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

// The mean pressure at which all ground that something faces is at the cap.
double greatest_load(const HalfSpaceProblem& problem) {
  if (!problem.overhangs) return problem.yield.cap;
  return problem.yield.cap * (static_cast<double>(known_count(problem.heights->values())) /
                              static_cast<double>(problem.grid.nodes()));
}

// A pressure that presses about a tenth of the rms roughness flat, to begin with where no grid is coarser.
double first_guess(const HalfSpaceProblem& problem, double target_approach) {
  const double side = std::max(problem.grid.size_x, problem.grid.size_y);
  const double guess = 0.1 * problem.modulus * target_approach / side;
  return problem.yield.caps() ? std::min(guess, 0.5 * greatest_load(problem)) : guess;
}

struct Tried {
  double pressure = 0, measure = 0;
};

struct Search {
  HalfSpaceAnswer answer;
  Root root;
  bool reached = false;
  bool enough = false;  // some load brings what is asked for, or more
};

// Where every node in contact is at the cap the load says nothing of the offset: any that lets the nodes at
// the cap overlap and the others gape is a solution. Takes the one nearest to what is wanted.
void close_within_reach(const HalfSpaceProblem& problem, const WantedLength& wanted,
                        HalfSpaceAnswer& answer) {
  const auto nodes = static_cast<std::int64_t>(problem.grid.nodes());
  if (!problem.yield.caps() || answer.contacts != answer.yielded || answer.contacts == nodes) return;
  const auto ends = over_nodes<0, 2>(problem.grid.nodes(), [&](std::size_t k, double* v) {
    const bool touches = answer.pressure[k] > 0;
    v[0] = touches ? infinity : answer.gap[k];
    v[1] = touches ? -answer.gap[k] : infinity;
  });
  const double least = -ends[1], most = ends[0];
  if (!(least <= most)) return;
  const double further =
      std::clamp(wanted.length * (wanted.target - wanted.measure(problem, answer)), least, most);
  for (double& gap : answer.gap.values()) gap -= further;
  answer.offset += further;
  answer.approach += further;
  certify(problem, answer);
}

// The load of whole nodes at the cap that is nearest to `pressure` and strictly between two others; none, 0.
double whole_nodes(const HalfSpaceProblem& problem, double pressure, double low, double high) {
  const double nodes = static_cast<double>(problem.grid.nodes()), cap = problem.yield.cap;
  const auto load = [&](double whole) { return whole * cap / nodes; };
  const double nearest = std::round(pressure * nodes / cap);
  for (const double whole : {nearest, nearest - 1, nearest + 1})
    if (load(whole) > low && load(whole) < high) return load(whole);
  return 0;
}

Search search(const HalfSpaceProblem& problem, const WantedLength& wanted, Root root, double accuracy,
              double loosest, Monitor& monitor) {
  const double highest = problem.yield.caps() ? greatest_load(problem) * (1 - 1e-12) : infinity;
  HalfSpaceProblem now = problem;
  now.best_effort = true;
  constexpr double by_rounding = 1e-13;
  double tightest = std::min(problem.tolerance, std::max(accuracy * wanted.sharpness, by_rounding));
  now.tolerance = std::max(tightest, loosest);
  Tried low, high{infinity, infinity};
  Tried last;  // by a solve as tight; no pressure: none
  double last_error = infinity;
  Search result;
  result.root = root;
  double pressure = std::min(root.pressure, highest);
  for (int solve = 0; solve < most_solves; ++solve) {
    const HalfSpaceAnswer* start = result.answer.pressure.empty() ? nullptr : &result.answer;
    // Only a near state is worth starting from; a far one is found quicker on nested grids.
    if (start && std::abs(elementary::log(pressure / start->mean_pressure)) > 0.2) start = nullptr;
    result.answer = solve_at_pressure(now, pressure, start, monitor);
    close_within_reach(problem, wanted, result.answer);
    const Tried at{pressure, wanted.measure(problem, result.answer)};
    const double error = std::abs(at.measure - wanted.target) / wanted.target;
    result.enough = result.enough || at.measure >= wanted.target;
    if (error <= accuracy && now.tolerance <= tightest) {
      result.root.pressure = pressure;
      result.reached = true;
      return result;
    }
    if (last.pressure > 0 && at.pressure != last.pressure && at.measure > 0 && last.measure > 0 &&
        at.measure != last.measure) {
      const double slope =
          elementary::log(at.pressure / last.pressure) / elementary::log(at.measure / last.measure);
      if (slope > 0 && std::isfinite(slope)) result.root.slope = slope;
    }
    last = at;
    // What is left of an error that a solve as loose as the last did not lessen may be its own.
    const bool stalls = error < 0.1 && error > 0.25 * last_error;
    last_error = error;
    const double tighter =
        std::max(tightest, std::min((stalls ? 0.1 : 1.0) * now.tolerance, 0.02 * wanted.sharpness * error));
    if (error <= accuracy) {  // right by a loose solve: the same load again, to the end
      now.tolerance = tightest;
      continue;
    }
    if (tighter < result.answer.certificate.worst()) {
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
    double next = at.measure > 0 ? pressure * elementary::pow(wanted.target / at.measure,
                                                              std::clamp(result.root.slope, 0.05, 1e6))
                                 : 4 * pressure;
    next = std::clamp(next, pressure / 100, pressure * 100);
    bool bracketed = high.pressure < infinity && low.pressure > 0;
    // Loads that hardly differ, and yet what is wanted is far off: one of them was put on the wrong side, by
    // a node that weighs nothing in the residual of many.
    if (bracketed && stalls && high.pressure - low.pressure < 1e-6 * pressure &&
        now.tolerance > by_rounding) {
      tightest = now.tolerance = std::min(tightest, by_rounding);
      low = {};
      high = {infinity, infinity};
      bracketed = false;
    }
    if (bracketed && (stalls || !(next > low.pressure && next < high.pressure)))
      next = std::sqrt(low.pressure) * std::sqrt(high.pressure);
    else if (next >= high.pressure)
      next = 0.5 * high.pressure;
    else if (next <= low.pressure)
      next = 2 * low.pressure;
    if (bracketed && problem.yield.caps() && result.answer.contacts - result.answer.yielded <= 1)
      if (const double whole = whole_nodes(problem, next, low.pressure, high.pressure); whole > 0)
        next = whole;
    if (next >= highest) next = pressure + 0.5 * (highest - pressure);
    if (next == pressure || !(next > 0) || !std::isfinite(next)) break;
    if (bracketed && high.pressure <= low.pressure * (1 + 4e-16)) break;
    pressure = next;
  }
  result.root.pressure = pressure;
  return result;
}

HalfSpaceAnswer solve_for(const HalfSpaceProblem& problem, const WantedLength& wanted, double length,
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
  constexpr double nearly = 1e-3;  // nearer than this it is a matter of digits
  if (!found.enough && answer.certificate.load > std::max(problem.tolerance, nearly))
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
  if (approach > 0 && approach < 1e-280 * std::max(problem.grid.size_x, problem.grid.size_y))
    throw Error(ErrorCode::bad_value,
                "`approach` is " + format_short(approach) +
                    " m, less than 1e-280 of the tile: no double holds the pressures it takes",
                "give a larger approach, or none");
  const auto heights = problem.heights->values();
  const Range span = known_range(heights);
  if (problem.boundary == Boundary::periodic && !problem.yield.hardens()) {
    const double most = problem.yield.caps() ? span.span() : span.max - mean(heights);
    if (approach > most || (approach == most && !(approach == 0)))
      throw Error(ErrorCode::infeasible,
                  "an approach of " + format_quantity(approach, dimension::length) +
                      " cannot be reached: this periodic tile is in full contact at " +
                      format_quantity(most, dimension::length) + ", and more load brings it no nearer",
                  "ask for a smaller `approach`, or press by `pressure`");
  }
  WantedLength wanted;
  // Coarser grids miss the highest node: their approach is counted from it all the same.
  wanted.measure = [peak = span.max](const HalfSpaceProblem& on, const HalfSpaceAnswer& answer) {
    return answer.approach + (peak - known_range(on.heights->values()).max);
  };
  wanted.target = approach;
  if (problem.rms > 0) wanted.sharpness = 0.5 * std::min(1.0, approach / problem.rms);
  wanted.what = "an approach of " + format_quantity(approach, dimension::length);
  return solve_for(problem, wanted, approach, monitor);
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
  HalfSpaceCompliance compliance(grid.nx, grid.ny, grid.hy() / grid.hx(), problem.boundary);
  Array<double> u(h.size());
  compliance.apply(answer.pressure.values(), u);
  const double length = grid.hx() / problem.modulus;  // per unit of pressure in cell units
  const auto ends = over_nodes<0, 2>(h.size(), [&](std::size_t k, double* v) {
    const double down = length * u[k] + hardened(problem.yield, answer, k);
    const bool capped = problem.yield.caps() && answer.pressure[k] >= problem.yield.cap;
    v[0] = capped ? answer.approach : (span.max - h[k]) + down;
    v[1] = capped ? span.span() - answer.approach : (h[k] - span.min) - down;
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
    const bool faces = !std::isnan(h[k]);
    v[0] = faces ? low : infinity;
    v[1] = faces ? -low : infinity;
  });
  return 1 - (-ends[1] - ends[0]) / span.span();
}

HalfSpaceAnswer solve_at_flattening(const HalfSpaceProblem& problem, double fraction, Monitor& monitor) {
  if (!(fraction >= 0 && fraction <= 1))
    throw Error(ErrorCode::bad_value, "`flatten` is " + format_short(fraction), "it is a share from 0 to 1");
  WantedLength wanted;
  wanted.measure = [](const HalfSpaceProblem& on, const HalfSpaceAnswer& answer) {
    return flattened(on, answer);
  };
  wanted.target = fraction;
  wanted.length = known_range(problem.heights->values()).span();
  wanted.sharpness = 0.5 * fraction;
  wanted.what = "a flattening of " + format_short(fraction);
  return solve_for(problem, wanted, fraction * wanted.length, monitor);
}

}  // namespace asperity
