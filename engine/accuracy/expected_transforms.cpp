// SPDX-License-Identifier: GPL-3.0-or-later
// The trial grid takes every k-th node of the combined heights, which preserves short waves, and keeps the
// highest nodes (first contacts) and the lowest (reference of a flattening). Near full contact, the trial
// keeps the share of the load of full contact, which depends on the grid.
#include "engine/accuracy/expected_transforms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// --- constants
// Fit to 1062 presses on more than 96² nodes (900 random scenes, up to 256 cells a side):
//   ASPERITY_FIT=1 test_properties family=explain scenes=300 seed=31
struct Growth {
  double a, b;
};
constexpr Growth by_load{0.06, 0.18}, by_approach{0.14, 0.12}, by_flattening{0.18, 0.16};
// The whole grid is tried if `surely_enough` transforms fit the work of the trial. Otherwise a first trial
// has `first_tried` nodes. A second has all nodes that the work allows, at least `share_tried` (3 % of the
// work of the press), if `enough_more` than the first.
constexpr double surely_enough = 1000, first_tried = 96 * 96, enough_more = 1.5, share_tried = 1.0 / 32;
// Limit of the second trial, relative to its expectation. Expectation of a stopped trial, relative to its
// limit, on all cells and on part of them.
constexpr double room_for_a_stall = 2, times_left = 3, times_left_of_some = 1.5;
// Large presses can stall where the trial does not: 4 of 215 by approach or flattening and 1 of 44 by
// pressure took over four times the estimate (seeds: tests/stability/properties/explain.cpp).
constexpr const char* seldom = "; one such press in some fifty takes over four times as many";

Growth growth_by(PressBy by) {
  switch (by) {
    case PressBy::pressure:
    case PressBy::load:
      return by_load;
    case PressBy::approach:
    case PressBy::indentation:
      return by_approach;
    case PressBy::flatten:
      return by_flattening;
  }
  return by_load;
}

// --- fewer cells

// m of n nodes of one side, including the highest.
struct Sublattice {
  int n, m, shift = 0;
  Sublattice(int all, int kept, int highest) : n(all), m(kept) {
    shift = highest - at(static_cast<int>(static_cast<std::int64_t>(highest) * m / n));
  }
  int at(int k) const { return static_cast<int>(static_cast<std::int64_t>(k) * n / m); }
  int node(int k) const { return std::min(n - 1, at(k) + shift); }
  // Index of the node in place of node i.
  int place(int i) const {
    return std::clamp(static_cast<int>((static_cast<std::int64_t>(i - shift + 1) * m - 1) / n), 0, m - 1);
  }
};

struct HeightOfNode {
  double height;
  std::size_t number;
  bool operator<(const HeightOfNode& other) const { return height < other.height; }
};

// Highest nodes in ascending order. Missing heights are skipped.
constexpr std::size_t kept_highest = 16;
struct Extremes {
  std::vector<HeightOfNode> highest;
  HeightOfNode lowest;
};
Extremes extremes(const Field& h) {
  Extremes found{{}, {0, 0}};
  bool any = false;
  const auto above = [](const HeightOfNode& a, const HeightOfNode& b) { return b < a; };
  std::vector<HeightOfNode>& heap = found.highest;  // minimum in front
  for (std::size_t k = 0; k < h.size(); ++k) {
    if (std::isnan(h[k])) continue;
    if (!any || h[k] < found.lowest.height) found.lowest = {h[k], k};
    any = true;
    if (heap.size() == kept_highest && !(h[k] > heap.front().height)) continue;
    if (heap.size() == kept_highest) {
      std::pop_heap(heap.begin(), heap.end(), above);
      heap.pop_back();
    }
    heap.push_back({h[k], k});
    std::push_heap(heap.begin(), heap.end(), above);
  }
  std::stable_sort(heap.begin(), heap.end());
  return found;
}

Field thinned(const Field& h, const Grid& grid) {
  if (h.nx() == grid.nx && h.ny() == grid.ny) return h;
  const Extremes kept = extremes(h);
  const auto nx = static_cast<std::size_t>(h.nx());
  const auto column = [&](const HeightOfNode& node) { return static_cast<int>(node.number % nx); };
  const auto row = [&](const HeightOfNode& node) { return static_cast<int>(node.number / nx); };
  const HeightOfNode top = kept.highest.back();
  const Sublattice x(h.nx(), grid.nx, column(top)), y(h.ny(), grid.ny, row(top));
  Field result(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) result(i, j) = h(x.node(i), y.node(j));
  const auto keep = [&](const HeightOfNode& node) {
    result(x.place(column(node)), y.place(row(node))) = node.height;
  };
  keep(kept.lowest);
  for (const HeightOfNode& node : kept.highest) keep(node);
  return result;
}

// s of the header, from at most `most_rows` rows.
double roughness(const Field& h) {
  constexpr int most_rows = 256;
  const int nx = h.nx(), ny = h.ny(), step = (ny + most_rows - 1) / most_rows;
  double sum = 0, squares = 0, along = 0, across = 0;
  std::int64_t count = 0, pairs_along = 0, pairs_across = 0;
  const double origin = known_mean(h.values());
  for (int j = 0; j < ny; j += step)
    for (int i = 0; i < nx; ++i) {
      const double here = h(i, j) - origin;
      if (std::isnan(here)) continue;
      sum += here;
      squares += here * here;
      ++count;
      if (const double d = i + 1 < nx ? h(i + 1, j) - h(i, j) : NAN; !std::isnan(d)) {
        along += d * d;
        ++pairs_along;
      }
      if (const double d = j + 1 < ny ? h(i, j + 1) - h(i, j) : NAN; !std::isnan(d)) {
        across += d * d;
        ++pairs_across;
      }
    }
  const auto n = static_cast<double>(count);
  const double twice = 2 * (squares - sum * (sum / n)) / n;
  if (!(twice > 0)) return 0;
  const auto share = [&](double differences, std::int64_t pairs) {
    return pairs > 0 ? differences / static_cast<double>(pairs) / twice : 0.0;
  };
  const double most = std::max(share(along, pairs_along), share(across, pairs_across));
  return std::isfinite(most) ? std::sqrt(std::min(1.0, most)) : 0;
}

// --- full contact of a periodic tile

double distance_to_full_contact(const Field& h, Range known) { return known.max - known_mean(h.values()); }

// Divided by E*: −min (|q|/2) h, to some tens of percent.
double pressure_of_full_contact(const Field& h, const Grid& grid, const HalfSpaceOperator& half_space) {
  ComplianceMultiplier multiplier;
  if (half_space.share) multiplier = in_cells(*half_space.share, grid.hx(), false);
  HalfOrderPyramid half_order(grid.nx, grid.ny, grid.hy() / grid.hx(), Boundary::periodic, 1, multiplier);
  const double middle = mean(h.values()), span = range(h.values()).span();
  if (!(span > 0)) return 0;
  const std::span<float> in = half_order.input();
  for (std::size_t k = 0; k < in.size(); ++k) in[k] = static_cast<float>((h[k] - middle) / span);
  const std::span<const float> out = half_order.apply();
  return std::max(0.0, -static_cast<double>(*std::min_element(out.begin(), out.end()))) * (span / grid.hx());
}

struct Tried {
  double transforms = 0;
  bool ended = true, full = false;
  std::string refused;
};

Tried try_press(const Grid& grid, const Field& heights, const Scene& scene, const ContactGeometry& geometry,
                const Plan& plan, const PressRequest& request, double most) {
  Tried tried;
  const double weight = transform_work(grid) / transform_work(geometry.grid());
  const double before = cost::transforms();
  try {
    const TransformLimit limit(most);
    const State state = press_on(grid, heights, 0, scene, geometry, plan, request);
    tried.transforms = state.cost().total.transforms;
    tried.full = state.contacts() == static_cast<std::int64_t>(grid.nodes());
  } catch (const TransformLimit::Spent&) {
    tried.transforms = most;
    tried.ended = false;
    cost::count_transforms((weight - 1) * (cost::transforms() - before));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::infeasible && error.code() != ErrorCode::bad_value &&
        error.code() != ErrorCode::not_converged)
      throw;
    tried.refused = error.sentence();
    cost::count_transforms((weight - 1) * (cost::transforms() - before));
  }
  return tried;
}

PressRequest request_times(PressRequest request, double factor) {
  request.value *= factor;
  for (double& turn : request.preload) turn *= factor;
  return request;
}

Tried try_on(const Grid& grid, const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
             const PressRequest& request, double most) {
  const Grid& given = geometry.grid();
  const bool fewer = grid != given;
  const Field& all = geometry.combined();
  // Few nodes gain little from threads.
  constexpr std::size_t small = 128 * 128;
  std::optional<SingleThreaded> alone;
  if (grid.nodes() <= small) alone.emplace();
  const Field heights = thinned(all, grid);
  const bool periodic = geometry.boundary() == Boundary::periodic;

  PressRequest there = request;
  if (request.by == PressBy::indentation) {
    there = request_times(there, geometry.peak_to_valley());
    there.by = PressBy::approach;
  }
  if (there.by == PressBy::approach && fewer && periodic) {
    const double here = distance_to_full_contact(all, geometry.combined_range());
    if (here > 0)
      there = request_times(there, distance_to_full_contact(heights, known_range(heights.values())) / here);
  }
  Tried found = try_press(grid, heights, scene, geometry, plan, there, most);
  const bool by_pressure = there.by == PressBy::pressure || there.by == PressBy::load;
  if (found.full && fewer && periodic && by_pressure && !(plan.yield && plan.yield->limits())) {
    const auto& half_space = std::get<HalfSpaceOperator>(plan.elasticity);
    const double pressure = there.by == PressBy::load ? there.value / given.area() : there.value;
    const double needed = pressure_of_full_contact(all, given, half_space);
    if (pressure < needed * half_space.modulus) {
      there = request_times(there, pressure_of_full_contact(heights, grid, half_space) / needed);
      if (there.value > 0) found = try_press(grid, heights, scene, geometry, plan, there, most);
    }
  }
  return found;
}

// Nodes for half of the free memory: `explain` must work for presses above the limit.
double nodes_within_memory(const Plan& plan, PressBy by, double nodes) {
  constexpr double share = 0.5;
  const std::int64_t limit = memory::limit();
  if (limit <= 0) return infinity;
  const std::int64_t needed = plan.bytes_peak() + (by == PressBy::flatten ? plan.bytes_to_flatten : 0);
  const auto left = static_cast<double>(std::max<std::int64_t>(limit - memory::held(), 0));
  return std::max(1.0, nodes * share * left / static_cast<double>(std::max<std::int64_t>(needed, 1)));
}

ExpectedTransforms tried(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                         const PressRequest& request, const TrialEffort& effort) {
  const Grid& given = geometry.grid();
  const auto nodes = static_cast<double>(given.nodes());
  const Growth grows = growth_by(request.by);
  const double by_pressure = plan.transforms / (1 + estimate_work(geometry, plan.accuracy));
  ExpectedTransforms expected;
  expected.roughness = roughness(geometry.combined());
  const auto take = [&](const Grid& grid, double most, double times) {
    const Tried found = try_on(grid, scene, geometry, plan, request, most);
    expected.tried_on = grid;
    expected.tried = found.transforms;
    expected.ended = found.ended;
    expected.refused = found.refused;
    expected.halvings = 0.5 * elementary::log2(nodes / static_cast<double>(grid.nodes()));
    const double grown = elementary::pow(2, expected.halvings * (grows.a + grows.b * expected.roughness));
    expected.transforms =
        found.refused.empty() ? found.transforms * grown * (found.ended ? 1 : times) : by_pressure;
  };
  const double greatest = std::min(effort.most_nodes, nodes_within_memory(plan, request.by, nodes));
  const auto on_at_most = [&](double most) { return trial_grid(given, std::min(most, greatest)); };
  const bool whole = effort.work >= surely_enough * transform_work(given);
  const Grid first = on_at_most(whole ? nodes : first_tried);
  take(first, effort.work / transform_work(first), times_left);
  if (first == given || !expected.ended) return expected;
  const double told = std::max(expected.transforms, 1.0);
  const double room = effort.work / told / elementary::log2(nodes);
  const Grid second = on_at_most(std::max(room, share_tried * nodes));
  if (static_cast<double>(second.nodes()) < enough_more * static_cast<double>(first.nodes())) return expected;
  take(second, room_for_a_stall * std::max(told, effort.work / transform_work(second)),
       second == given ? times_left : times_left_of_some);
  return expected;
}

}  // namespace

Grid trial_grid(const Grid& grid, double most) {
  if (static_cast<double>(grid.nodes()) <= most) return grid;
  // Nested grids need multiples of four.
  constexpr int fewest = 8, nested = 32;
  const auto side = [&](int n, double share) {
    const int m = std::max(std::min(n, fewest), static_cast<int>(n * share));
    return m >= nested ? m / 4 * 4 : m;
  };
  const double share = std::sqrt(most / static_cast<double>(grid.nodes()));
  Grid result = grid;
  result.nx = side(grid.nx, share);
  result.ny = side(grid.ny, share);
  if (static_cast<double>(result.nodes()) <= most) return result;
  int& along = result.nx >= result.ny ? result.nx : result.ny;
  along = side(along, most / static_cast<double>(result.nodes()));
  return result;
}

ExpectedTransforms expected_transforms(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                                       const PressRequest& request, const TrialEffort& effort) {
  check(request, plan.attracts());
  if (!std::holds_alternative<HalfSpaceOperator>(plan.elasticity)) return {};
  if (request.value == 0 && !plan.attracts()) return {};
  const double before = cost::transforms();
  ExpectedTransforms expected = tried(scene, geometry, plan, request, effort);
  expected.work = cost::transforms() - before;
  cost::count_transforms(-expected.work);
  return expected;
}

Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request) {
  Plan result = plan;
  result.press = "by " + quoted(name(request.by));
  if (scene.accuracy.asked && !scene.accuracy.chosen) return result;  // the grid is unknown
  const ExpectedTransforms expected = expected_transforms(scene, geometry, plan, request);
  if (request.by == PressBy::flatten) hold_flattening(result);
  if (!std::holds_alternative<HalfSpaceOperator>(plan.elasticity)) return result;
  const Grid& grid = expected.tried_on;
  if (!expected.refused.empty()) {
    result.press += ", as far as is known: on " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
                    " cells " + expected.refused;
    return result;
  }
  const double transforms = expected.transforms * (1 + estimate_work(geometry, plan.accuracy));
  result.seconds *= plan.transforms > 0 ? transforms / plan.transforms : 1;
  result.transforms = transforms;
  const bool whole = grid == geometry.grid();
  if (grid.nodes() > 0)
    result.press += std::string(", tried on ") + (whole ? "all " : "") + std::to_string(grid.nx) + " x " +
                    std::to_string(grid.ny) + " cells";
  const bool under_load = request.by == PressBy::pressure || request.by == PressBy::load;
  if (expected.ended && !whole && !under_load) result.press += seldom;
  if (!expected.ended)
    result.press += ", where it was left after " + format_short(expected.tried) + ": they may be many more";
  return result;
}

}  // namespace asperity
