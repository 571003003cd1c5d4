// SPDX-License-Identifier: GPL-3.0-or-later
// Other cells get the combined heights under a flat body with the upper material, which avoids turns and
// shifts.
#include "engine/accuracy/companion_grids.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/accuracy/finer_heights.hpp"
#include "engine/contact/planned_yield.hpp"
#include "engine/contact/solver.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/operations/resampling.hpp"

namespace asperity {

namespace {

constexpr int fewest_cells = 8;
constexpr double loose_enough = 1e-5, close_enough = 1e-6;

int halved(int cells) { return cells < 2 * fewest_cells ? cells : (cells + 1) / 2; }

Field on_cells(const Field& field, const Grid& from, const Grid& to, bool periodic) {
  return at_cells(Surface(from, field, {.material = {}, .periodic = periodic, .aliased_share = {}}), to.nx,
                  to.ny)
      .surface.heights();
}

// Limited to the range of the given nodes.
Field hardness_on_cells(const Field& hardness, const Grid& from, const Grid& to) {
  Field result = on_cells(hardness, from, to, false);
  const Range known = range(hardness.values());
  for (double& value : result.values()) value = std::clamp(value, known.min, known.max);
  return result;
}

bool periodic_together(const Scene& scene) {
  const auto* upper = std::get_if<Surface>(&scene.upper);
  return scene.lower.traits().periodic && (upper == nullptr || upper->traits().periodic);
}

// Marks missing heights (no opposite surface) and sets the lowest height.
Array<std::uint8_t> taken_out(Field& heights) {
  Array<std::uint8_t> uncovered;
  if (known_count(heights.values()) == heights.size()) return uncovered;
  const double lowest = known_range(heights.values()).min;
  uncovered.resize(heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    uncovered[k] = std::isnan(heights[k]) ? 1 : 0;
    if (uncovered[k] != 0) heights[k] = lowest;
  }
  return uncovered;
}

// Missing if a neighbouring node of the given grid is missing.
Field combined_on_cells(const ContactGeometry& geometry, const Grid& grid, bool periodic) {
  const Grid& given = geometry.grid();
  if (!geometry.overhangs()) return on_cells(geometry.combined(), given, grid, periodic);
  Field known = geometry.combined();
  const Array<std::uint8_t> uncovered = taken_out(known);
  Field heights = on_cells(known, given, grid, periodic);
  const auto beside = [](int k, int coarse, int fine) {
    const double at = static_cast<double>(k) * fine / coarse;
    const int low = std::min(static_cast<int>(at), fine - 1);
    return std::pair{low, std::min(fine - 1, at > low ? low + 1 : low)};
  };
  for (int j = 0; j < grid.ny; ++j) {
    const auto [below, above] = beside(j, grid.ny, given.ny);
    for (int i = 0; i < grid.nx; ++i) {
      const auto [left, right] = beside(i, grid.nx, given.nx);
      for (const int row : {below, above})
        for (const int column : {left, right})
          if (uncovered[static_cast<std::size_t>(row) * static_cast<std::size_t>(given.nx) +
                        static_cast<std::size_t>(column)] != 0)
            heights(i, j) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return heights;
}

}  // namespace

State press_from_coarser(const Solver& solver, const State* coarser, const PressRequest& request,
                         Monitor& monitor) {
  // From a coarser start, nested grids are cheaper.
  constexpr double near_enough = 4;
  const int nx = solver.geometry().grid().nx;
  if (coarser == nullptr || !coarser->converged() || nx > near_enough * coarser->grid().nx)
    return solver.press(request, monitor);
  return solver.press_from(*coarser->solution(), request, monitor);
}

State press_on(const Grid& grid, Field heights, double tolerance, const Scene& scene,
               const ContactGeometry& geometry, const Plan& given_plan, const PressRequest& request,
               Monitor& monitor, const State* coarser) {
  const Grid& given = geometry.grid();
  const auto* upper = std::get_if<Surface>(&scene.upper);
  Scene there = scene;
  const Array<std::uint8_t> uncovered = taken_out(heights);
  there.lower = Surface(
      grid, std::move(heights),
      {.material = scene.lower.material(), .periodic = periodic_together(scene), .aliased_share = {}});
  if (upper != nullptr)
    there.upper = Surface(grid, Field(grid.nx, grid.ny),
                          {.material = upper->material(), .periodic = true, .aliased_share = {}});
  there.accuracy.tolerance = std::max(scene.accuracy.tolerance, tolerance);
  there.accuracy.on_failure = Accuracy::OnFailure::best;
  there.accuracy.estimate = Accuracy::Estimate::none;
  there.accuracy.asked.reset();
  there.effects = scene.effects.of_solve();

  const LatticeIsometry flat_pose(grid.nx, grid.ny);
  BodyMemory memory;
  if (given_plan.yield && !geometry.kept(hardness_memory).empty()) {
    const MetMemory local = local_hardness(geometry, *given_plan.yield);
    NodeMemory& hardness = memory[std::string(hardness_memory)];
    if (local.lower)
      hardness.lower = std::make_shared<const Field>(hardness_on_cells(*local.lower, given, grid));
    if (local.upper)
      hardness.upper =
          std::make_shared<const Field>(flat_pose.to_upper(hardness_on_cells(*local.upper, given, grid)));
  }
  auto geometry_there =
      std::make_shared<const ContactGeometry>(there, flat_pose, std::move(memory), uncovered);
  Plan plan = given_plan.yield ? make_plan_like(given_plan, there, *geometry_there)
                               : make_plan(there, *geometry_there);
  if (plan.yield && given_plan.yield) plan.yield->carried = given_plan.yield->carried;
  // In transforms of the given grid.
  const double before = cost::transforms();
  State state = press_from_coarser(*make_solver(plan, std::move(geometry_there)), coarser, request, monitor);
  const double weight = transform_work(grid) / transform_work(given);
  cost::count_transforms((weight - 1) * (cost::transforms() - before));
  return state;
}

double transform_work(const Grid& grid) {
  const auto n = static_cast<double>(grid.nodes());
  return n * elementary::log2(std::max(n, 2.0));
}

double estimate_work(const ContactGeometry& geometry, const Accuracy& accuracy) {
  const Grid& grid = geometry.grid();
  if (accuracy.estimate == Accuracy::Estimate::none) return 0;
  if (accuracy.estimate == Accuracy::Estimate::finer)
    return transform_work(finer_grid(grid)) / transform_work(grid);
  double work = 0;
  for (const Grid& coarser : coarser_grids(grid)) work += transform_work(coarser) / transform_work(grid);
  return work;
}

std::vector<Grid> coarser_grids(const Grid& grid) {
  std::vector<Grid> grids;
  Grid last = grid;
  while (grids.size() < 2) {
    const Grid next{halved(last.nx), halved(last.ny), grid.size_x, grid.size_y};
    if (next == last) break;
    grids.push_back(next);
    last = next;
  }
  return grids;
}

void check_estimate(const Grid& grid) {
  if (coarser_grids(grid).empty())
    refuse("`estimate` was asked for a tile of " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
               " cells",
           "an estimate compares with half the cells: give at least " + std::to_string(2 * fewest_cells) +
               " along x or y, or leave `estimate` out");
}

std::shared_ptr<const CompanionGrids> solve_coarser(const Scene& scene, const ContactGeometry& geometry,
                                                    const Plan& plan, const PressRequest& request,
                                                    Monitor& monitor) {
  check_estimate(geometry.grid());
  const std::vector<Grid> grids = coarser_grids(geometry.grid());
  const bool periodic = periodic_together(scene);
  std::vector<CompanionGrids::Level> levels;  // coarse to fine
  for (std::size_t k = grids.size(); k-- > 0;) {
    const Grid &grid = grids[k], &finer = k > 0 ? grids[k - 1] : geometry.grid();
    const State* const coarser = scene.accuracy.chosen && !levels.empty() ? &levels.back().state : nullptr;
    State state = press_on(grid, combined_on_cells(geometry, grid, periodic), loose_enough, scene, geometry,
                           plan, request, monitor, coarser);
    const double across = static_cast<double>(finer.nx) / grid.nx,
                 up = static_cast<double>(finer.ny) / grid.ny;
    levels.push_back({std::move(state), std::max(across, up)});
  }
  std::reverse(levels.begin(), levels.end());
  return std::make_shared<const CompanionGrids>(request, std::move(levels));
}

std::shared_ptr<const CompanionGrids> solve_finer(const Scene& scene, const ContactGeometry& geometry,
                                                  const Plan& plan, const PressRequest& request,
                                                  Monitor& monitor) {
  const Grid grid = finer_grid(geometry.grid());
  State state = press_on(grid, finer_heights(scene, geometry, monitor), close_enough, scene, geometry, plan,
                         request, monitor);
  return std::make_shared<const CompanionGrids>(
      request, std::vector<CompanionGrids::Level>{{std::move(state), 1.0 / times_finer}});
}

std::int64_t bytes_held_with_other_grids(const State& state) {
  std::int64_t bytes = state.bytes_held();
  if (state.companion_grids())
    for (const CompanionGrids::Level& level : state.companion_grids()->levels())
      bytes += bytes_held_with_other_grids(level.state);
  return bytes;
}

void plan_estimate(const ContactGeometry& geometry, Plan& plan) {
  if (plan.accuracy.estimate == Accuracy::Estimate::none) return;
  const Grid& fine = geometry.grid();
  const double work = estimate_work(geometry, plan.accuracy);
  double kept = 0;
  if (plan.accuracy.estimate == Accuracy::Estimate::finer) {
    const Grid grid = finer_grid(fine);
    const auto held = static_cast<std::int64_t>(3 * static_cast<double>(grid.nodes()) * sizeof(double));
    const double solve = static_cast<double>(plan.bytes_grown()) * static_cast<double>(grid.nodes()) /
                         static_cast<double>(fine.nodes());
    plan.estimate = "the same press on " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
                    " cells, with it about " + format_short(1 + work, 2) +
                    " times the cost of the press alone, by effect as `estimate`";
    plan.buffers.push_back({"heights, pressures and gaps of the finer grid", held});
    plan.buffers.push_back({"the solve on the finer grid",
                            std::max<std::int64_t>(0, static_cast<std::int64_t>(solve) - held), false});
    plan.transforms *= 1 + work;
    plan.seconds *= 1 + work;
    return;
  }
  std::vector<std::string> cells;
  for (const Grid& grid : coarser_grids(fine)) {
    kept += static_cast<double>(grid.nodes());
    cells.push_back(std::to_string(grid.nx) + " x " + std::to_string(grid.ny));
  }
  if (cells.empty()) return;
  plan.estimate = "the same press on " + joined(cells, " and ") + " cells, by effect as `estimate`";
  plan.buffers.push_back({"heights, pressures and gaps of the coarser grids",
                          static_cast<std::int64_t>(3 * kept * sizeof(double))});
  plan.transforms *= 1 + work;
  plan.seconds *= 1 + work;
}

Plan plan_with_estimate(const Scene& scene, const ContactGeometry& geometry) {
  Plan plan = make_plan(scene, geometry);
  plan_estimate(geometry, plan);
  return plan;
}

}  // namespace asperity
