// SPDX-License-Identifier: GPL-3.0-or-later
// The load that brings two bodies in slabs together by so much: a bracketed secant over the logarithm of the
// load, begun on a grid of a quarter of the nodes, where it costs little, and finished by a few solves on the
// finest, each from the one before.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/contact/elasticity/slabs/slab_solve.hpp"
#include "engine/contact/elasticity/slabs/slab_transfer.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr int most_solves = 60;
constexpr double least_nodes = 64 * 64;

// The same contact on the next coarser grid, heights counted as on the fine one.
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
  double slope = 0;      // d approach / d ln load; 0 where nothing is known
};

struct Found {
  SlabContactAnswer answer;
  Root root;
  bool reached = false;
};

// `target` is the approach of the planes, from the first touch of the finest grid's `peak`.
Found search(Team& team, const SlabContactProblem& problem, double target, double peak, Root root,
             double accuracy, Monitor& monitor) {
  SlabContactProblem now = problem;
  now.best_effort = true;
  const double share = std::min(1.0, target / problem.surface.rms);
  now.tolerance = std::max(1e-13, 0.2 * std::min(problem.tolerance, accuracy) * share);
  const double highest = elementary::log(problem.cap) - 1e-12;  // infinite without a cap
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
    // What the slope says, within the bracket and not too far beyond it.
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

SlabContactAnswer solve_slabs_at_approach(Team& team, const SlabContactProblem& problem, double approach,
                                          Monitor& monitor) {
  if (!(approach >= 0) || !std::isfinite(approach))
    throw Error(ErrorCode::bad_value, "`approach` is " + metres(approach), "give zero or a length above it");
  if (approach == 0) return solve_slabs_at_pressure(team, problem, 0, nullptr, monitor);
  const SlabSurface& surface = problem.surface;
  const double full = surface.peak - surface.mean;
  if (!std::isfinite(problem.cap) && approach >= full)
    throw Error(ErrorCode::infeasible,
                "`approach` is " + metres(approach) + ", and all of the tile touches at " + metres(full) +
                    ": past full contact no load brings a periodic tile closer",
                "give less, or `pressure`");
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
    throw Error(ErrorCode::infeasible,
                "`approach` is " + metres(approach) +
                    ", and under the greatest load that `hardness` allows it is " + metres(answer.approach),
                "give less, or `pressure`");
  if (!answer.converged && !problem.best_effort)
    throw Error(ErrorCode::not_converged,
                "the approach of " + metres(approach) + " was missed by " +
                    metres(answer.approach - approach) + " with a residual of " +
                    format_short(answer.certificate.worst(), 3) + " where `tolerance` asks for " +
                    format_short(problem.tolerance, 3),
                "ask for a larger `tolerance`, or accept the best reached with `on_failure = \"best\"`");
  return std::move(found.answer);
}

}  // namespace asperity
