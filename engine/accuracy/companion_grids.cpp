// SPDX-License-Identifier: GPL-3.0-or-later
// Other cells get the combined heights under a flat body with the upper material, which avoids turns and
// shifts.
#include "engine/accuracy/companion_grids.hpp"

#include "engine/accuracy/chosen_accuracy.hpp"
#include "engine/accuracy/finer_heights.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/operations/resampling.hpp"

namespace asperity {

namespace {

constexpr int fewest_cells = 8;
constexpr double loose_enough = 1e-5, close_enough = 1e-6;

int halved(int cells) { return cells < 2 * fewest_cells ? cells : (cells + 1) / 2; }

Field on_cells(const Field& field, const Grid& from, const Grid& to, bool periodic) {
  if (from.nx % to.nx == 0 && from.ny % to.ny == 0) return sampled(field, to.nx, to.ny);
  return resampled(
             Surface::with_holes(from, field, {.material = {}, .periodic = periodic, .aliased_share = {}}),
             to.nx, to.ny)
      .measured_heights();
}

// Limited to the range of given nodes.
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

// Marks missing heights and sets the lowest height.
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

std::vector<Grid> other_grids(const Grid& grid, Accuracy::Estimate estimate) {
  if (estimate == Accuracy::Estimate::none) return {};
  return estimate == Accuracy::Estimate::finer ? std::vector{finer_grid(grid)} : coarser_grids(grid);
}

// Similar shape. Multiples of four admit nested grids.
Grid trial_grid(const Grid& grid) {
  constexpr double most_nodes = 128 * 128;
  const double share = std::sqrt(most_nodes / static_cast<double>(grid.nodes()));
  if (share >= 1) return grid;
  const auto fewer = [&](int n) {
    return std::max(std::min(n, fewest_cells), static_cast<int>(n * share) / 4 * 4);
  };
  return {fewer(grid.nx), fewer(grid.ny), grid.size_x, grid.size_y};
}

}  // namespace

State press_from_coarser(const Solver& solver, const State* coarser, const PressRequest& request,
                         Monitor& monitor) {
  // From a coarser start, nested grids cost less.
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
  there.accuracy = companion_accuracy(scene.accuracy, tolerance);
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
  double work = 0;
  for (const Grid& other : other_grids(grid, accuracy.estimate))
    work += transform_work(other) / transform_work(grid);
  return work;
}

std::vector<Grid> coarser_grids(const Grid& grid) {
  std::vector<Grid> grids;
  for (Grid last = grid; grids.size() < 2;) {
    const Grid next{halved(last.nx), halved(last.ny), grid.size_x, grid.size_y};
    if (next == last) break;
    grids.push_back(last = next);
  }
  return grids;
}

void check_estimate(const Grid& grid) {
  if (coarser_grids(grid).empty())
    refuse("`estimate` is given for a tile of " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
               " cells",
           "it also presses on half the cells: give at least " + std::to_string(2 * fewest_cells) +
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
    State state = press_on(grid, on_cells(geometry.combined(), geometry.grid(), grid, periodic), loose_enough,
                           scene, geometry, plan, request, monitor, coarser);
    levels.push_back({std::move(state), std::max(static_cast<double>(finer.nx) / grid.nx,
                                                 static_cast<double>(finer.ny) / grid.ny)});
  }
  std::ranges::reverse(levels);
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
  const Grid& given = geometry.grid();
  const bool finer = plan.accuracy.estimate == Accuracy::Estimate::finer;
  const std::vector<Grid> grids = other_grids(given, plan.accuracy.estimate);
  if (grids.empty()) return;
  std::vector<std::string> cells;
  double nodes = 0;
  for (const Grid& grid : grids) {
    nodes += static_cast<double>(grid.nodes());
    cells.push_back(std::to_string(grid.nx) + " x " + std::to_string(grid.ny));
  }
  const double times = 1 + estimate_work(geometry, plan.accuracy);
  plan.estimate = "the same press on " + joined(cells, " and ") + " cells, with it about " +
                  format_short(times, 2) + " times the cost of the press alone, by effect as `estimate`";
  const auto held = static_cast<std::int64_t>(3 * nodes * sizeof(double));
  const double solve = static_cast<double>(plan.bytes_grown()) * nodes / static_cast<double>(given.nodes());
  plan.buffers.push_back({finer ? "heights, pressures and gaps of the finer grid"
                                : "heights, pressures and gaps of the coarser grids",
                          held});
  if (finer)
    plan.buffers.push_back({"the solve on the finer grid",
                            std::max<std::int64_t>(0, static_cast<std::int64_t>(solve) - held), false});
  plan.transforms *= times;
  plan.seconds *= times;
}

Plan plan_with_estimate(const Scene& scene, const ContactGeometry& geometry) {
  Plan plan = make_plan(scene, geometry);
  plan_estimate(geometry, plan);
  return plan;
}

Plan plan_of_press(const Scene& scene, const ContactGeometry& geometry, const Plan& plan,
                   const PressRequest& request) {
  check(request, plan.attracts());
  Plan result = plan;
  result.press = "by " + quoted(name(request.by));
  if (request.by == PressBy::flatten) hold_flattening(result);
  const bool unknown_cells = scene.accuracy.asked && !scene.accuracy.chosen;
  if (plan.transforms == 0 || unknown_cells) return result;
  const Grid &given = geometry.grid(), grid = trial_grid(given);
  const std::string cells = (grid == given ? "all " : "") + cells_text(grid.nx, grid.ny);
  const double before = cost::transforms();
  try {
    const State trial =
        press_on(grid, sampled(geometry.combined(), grid.nx, grid.ny), 0, scene, geometry, plan, request);
    const double spent = cost::transforms() - before;
    result.transforms = trial.cost().total.transforms * (1 + estimate_work(geometry, plan.accuracy));
    result.seconds *= result.transforms / plan.transforms;
    result.press += ", from a trial on " + cells + " that took " + format_short(spent, 3);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::infeasible && error.code() != ErrorCode::bad_value &&
        error.code() != ErrorCode::not_converged)
      throw;
    result.press += ", a rough guess: in a trial on " + cells + " " + error.sentence();
  }
  cost::count_transforms(before - cost::transforms());
  return result;
}

}  // namespace asperity
