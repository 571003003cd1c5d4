// SPDX-License-Identifier: GPL-3.0-or-later
// The tolerance starts at three ten-thousandths of the error asked for. There the rigorous bound on what a
// solve leaves undone is nearly always below the error of the cells, and what a solve costs more than at
// three times as much is less than what a few solved twice do; where the bound is still too wide, the same
// grid is solved again more tightly. Where areas alone are asked for it starts at a hundredth: their bound
// counts every node that might change sides, of which a tenth or fewer do.
//
// A corrected area of half-spaces lies within an outline between the nodes (contact/outline_area.hpp), whose
// doubt says how far that is from the area on ever finer cells, so that no finer grid has to confirm it. It
// counts with a margin, from the 90 in 100 that are within it to some 95. How far the area moved from the
// grid before counts as well: in full on cells that miss the shortest waves, where the outline is sharp and
// wrong, seven tenths of it on others, of a grid of half the cells; of grids closer together or further
// apart, more or less of it. The bound of the solve, three applications of the half-space, is not
// looked at: an outline moves by so little at this tolerance that as many errors are met without it. These
// shares met 97.1 to 100 in 100 of each of four errors of 210 scenes at little cost (bench/asked_errors.lua,
// seeds 1201 to 1206, and six each from 1301, 1401, 1601 and 1701 on). The doubt falls as the cells a side to
// the power 1.38, so one grid tells which may be fine enough: what lies between is left out, and half as many
// cells again as a grid of the doubling sequence are enough where they do.
//
// Where there is no such outline, what the cells leave wrong in a corrected area follows the one of edges. Of
// the correction c = A - A_c, relative to A_c, a tenth is wrong on every grid and the rest by chance, the
// less the more edges N the outline has:
//   |error| < c (0.1 + 4/sqrt(N))
// in 19 of 20 scenes (balls, Weierstrass-Mandelbrot, self-affine, blasted, capped, hardening; both
// boundaries; N from 8 to 8192; the seeds that it was fitted to are not those of tests/accuracy). Two
// differences between successive grids count beside it, so that grids must agree before the finer of them is
// believed.
#include "engine/accuracy/accuracy_choice.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/accuracy/companion_grids.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/laws_met.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/part_monitor.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/operations/resampling.hpp"

namespace asperity {

namespace {

constexpr int fewest_cells_to_begin = 16;
// Fewer are not believed; what is not an area was looked into on no fewer than the second.
constexpr int fewest_of_an_area = 32, fewest_of_others = 64;
constexpr double share_of_bound = 0.1;  // of the nodes that might change sides
constexpr double margin_of_doubt = 1.2;
constexpr double tightest = 1e-10, tighter = 30;

double transform_work(int nx, int ny) {
  const double n = static_cast<double>(nx) * ny;
  return n * elementary::log2(std::max(n, 2.0));
}

double rms_of(const Field& heights) {
  const double middle = known_mean(heights.values());
  Array<double> squares(heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) squares[k] = (heights[k] - middle) * (heights[k] - middle);
  return std::sqrt(known_mean(squares));
}

// --- the bodies on other cells

struct Placed {
  Scene scene;
  Pose pose;
  std::string source;
};

using Node = LatticeIsometry::Node;

std::string_view word(AtCells::How how) {
  switch (how) {
    case AtCells::How::unchanged:
      return "as given";
    case AtCells::How::sampled:
      return "nodes of the cells given";
    case AtCells::How::made_again:
      return "generated again";
    default:
      return "interpolated";
  }
}

Placed placed_on(const Scene& scene, const Pose& pose, AtCells lower, Monitor& monitor) {
  const Grid& given = scene.lower.grid();
  const int nx = lower.surface.grid().nx, ny = lower.surface.grid().ny;
  if (lower.how == AtCells::How::unchanged) return {scene, pose, std::string(word(lower.how))};
  Scene there = scene;
  there.lower = std::move(lower.surface);
  std::string source(word(lower.how));
  LatticeIsometry lattice = LatticeIsometry(nx, ny).turned(pose.lattice().quarters());
  if (const auto* upper = std::get_if<Surface>(&scene.upper)) {
    const int ratio_x = given.nx / nx, ratio_y = given.ny / ny;
    if (pose.on_lattice() && nx * ratio_x == given.nx && ny * ratio_y == given.ny) {
      // Of the upper body, the nodes that lie over those taken of the lower one.
      Field heights(nx, ny);
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          const Node over = lattice.to_lower(Node{i, j});
          const Node own = pose.lattice().to_upper(Node{over.i * ratio_x, over.j * ratio_y});
          heights(i, j) = upper->heights()(own.i, own.j);
        }
      SurfaceTraits traits = upper->traits();
      traits.aliased_share.reset();
      there.upper = Surface(there.lower.grid(), std::move(heights), std::move(traits));
    } else {
      AtCells own = at_cells(*upper, nx, ny, monitor);
      if (own.how != lower.how) source += " and " + std::string(word(own.how));
      there.upper = std::move(own.surface);
      const int finer_x = nx / given.nx, finer_y = ny / given.ny;
      if (scene.boundary == Boundary::periodic && pose.on_lattice() && finer_x * given.nx == nx &&
          finer_y * given.ny == ny) {
        // The middle of the nodes, about which it is turned over, moves with the cells.
        const Node first = pose.lattice().to_upper(Node{0, 0});
        const Node now = lattice.to_lower(Node{first.i * finer_x, first.j * finer_y});
        lattice = lattice.shifted(-now.i, -now.j);
      }
    }
  }
  Pose turned = lattice;
  if (!pose.on_lattice()) turned = turned.turned(pose.rest(), there.lower.grid());
  return {std::move(there), turned, std::move(source)};
}

// --- the error of a state

// The bound on a quantity against the exact solution on the same grid; 0 where it has none.
double algebraic_bound(const State& state, std::string_view name) {
  const StateQuantity* const quantity = find_quantity(name);
  if (quantity == nullptr || quantity->bound == nullptr) return 0;
  return quantity->bound(state).value_or(0);
}

bool is_area(std::string_view quantity) {
  return quantity == "corrected_area_fraction" || quantity == "area_fraction" || quantity == "area";
}

bool is_corrected_area(const std::string& quantity) { return quantity == "corrected_area_fraction"; }

// Whether the combined heights have waves of fewer than seven cells, in the mean. Over two cells a wave of m
// cells differs by 2(1 + cos(2 pi/m)) times as much as over one, in the mean square: smooth heights by 4,
// white noise by 1.
bool waves_are_missed(const State& state) {
  constexpr double smooth_enough = 3.2;
  const Field& h = state.geometry().combined();
  const bool wraps = state.geometry().boundary() == Boundary::periodic;
  const auto mean_square = [&](int apart) {
    double sum = 0, count = 0;
    const auto add = [&](double difference) {
      if (std::isnan(difference)) return;
      sum += difference * difference;
      count += 1;
    };
    for (int j = 0; j < h.ny(); ++j)
      for (int i = 0; i < h.nx(); ++i) {
        if (wraps || i + apart < h.nx()) add(h((i + apart) % h.nx(), j) - h(i, j));
        if (wraps || j + apart < h.ny()) add(h(i, (j + apart) % h.ny()) - h(i, j));
      }
    return count > 0 ? sum / count : 0.0;
  };
  return mean_square(2) < smooth_enough * mean_square(1);
}

// How much of a step from a grid of `ratio` times wider cells counts. What chance leaves falls as the cells a
// side to the power 3/2, and a step holds that of both grids.
double share_of_step(double ratio, bool waves_missed) {
  constexpr double of_half_the_cells = 0.7, steeper = 3.2;
  if (waves_missed) return std::max(1.0, 1 + steeper * (2 - ratio));
  return of_half_the_cells * std::sqrt(9 / (1 + ratio * ratio * ratio));
}

// Of the corrected area fraction: what its error, relative, stays within in 19 scenes of 20.
double corrected_area_error(const State& state) {
  if (state.outline()) {
    const CompanionGrids::Level& before = state.companion_grids()->levels().front();
    const double of_a_step = share_of_step(before.ratio, waves_are_missed(state));
    const double fine = state.corrected_area_fraction();
    const double coarser = before.state.corrected_area_fraction();
    const double least = std::min(fine, coarser);
    if (!(least > 0)) return std::numeric_limits<double>::infinity();
    return std::max(margin_of_doubt * state.outline()->doubt, of_a_step * std::abs(fine - coarser) / least);
  }
  constexpr double on_every_grid = 0.1, by_chance = 4, of_a_step = 0.7, of_the_step_before = 0.1;
  constexpr double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24;
  const double area = state.corrected_area_fraction();
  if (area <= 0) return state.area_fraction() == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  const double correction = state.area_fraction() - area;
  const double edges = correction / excess * static_cast<double>(state.grid().nodes());
  double error = edges > 0 ? correction / area * (on_every_grid + by_chance / std::sqrt(edges)) : 0.0;
  double share = of_a_step, finer = area;
  for (const CompanionGrids::Level& level : state.companion_grids()->levels()) {
    const double coarser = level.state.corrected_area_fraction();
    error = std::max(error, share * std::abs(finer - coarser) / (coarser > 0 ? coarser : finer));
    finer = coarser;
    share = of_the_step_before;
  }
  return error;
}

struct Judged {
  double error = 0, algebraic = 0;  // relative; the first holds the second
  std::string of;
};

// Bounds cost a little, so they are looked at only where the estimates alone are good enough. `values` are
// those that a choice began with, or empty.
Judged judged(const State& state, const AskedError& asked, const std::vector<double>& values = {}) {
  constexpr double no_value = 1e-9;
  std::vector<double> estimates, scales;
  for (std::size_t k = 0; k < asked.of.size(); ++k) {
    const DiscretisationEstimate estimate = discretisation_estimate(state, asked.of[k]);
    double scale = std::abs(estimate.value);
    if (k < values.size() && scale < no_value * std::abs(values[k])) scale = std::abs(values[k]);
    const double error = estimate.margin * estimate.error;
    if (error != 0 && is_corrected_area(asked.of[k]))
      estimates.push_back(corrected_area_error(state) * std::abs(estimate.value) / scale);
    else
      estimates.push_back(error == 0 ? 0.0 : error / scale);
    scales.push_back(scale);
  }
  const auto worst =
      static_cast<std::size_t>(std::max_element(estimates.begin(), estimates.end()) - estimates.begin());
  Judged result{estimates[worst], 0, asked.of[worst]};
  if (!(result.error <= asked.error)) return result;
  for (std::size_t k = 0; k < asked.of.size(); ++k) {
    if (state.outline() && is_corrected_area(asked.of[k])) continue;
    const double bound = algebraic_bound(state, asked.of[k]);
    const double share = is_area(asked.of[k]) ? share_of_bound : 1;
    const double algebraic = bound == 0 ? 0.0 : share * bound / scales[k];
    if (estimates[k] + algebraic > result.error) {
      result.error = estimates[k] + algebraic;
      result.of = asked.of[k];
    }
    result.algebraic = std::max(result.algebraic, algebraic);
  }
  return result;
}

// Of half-spaces that do not attract each other: where an outline between the nodes may be known.
const HalfSpaceOperator* operator_of_outlines(const Plan& plan) {
  const auto* const half_spaces = std::get_if<HalfSpaceOperator>(&plan.elasticity);
  return half_spaces == nullptr || half_spaces->share || plan.attracts() ? nullptr : half_spaces;
}

// With outlines between the nodes, on the coarser grids as well, where a corrected area is asked for and such
// an outline is known.
State outlined(State state, const Plan& plan, const AskedError& asked) {
  const HalfSpaceOperator* const half_spaces = operator_of_outlines(plan);
  if (half_spaces == nullptr || std::none_of(asked.of.begin(), asked.of.end(), is_corrected_area))
    return state;
  const double modulus = half_spaces->modulus;
  const CompanionGrids& coarser = *state.companion_grids();
  std::vector<CompanionGrids::Level> levels(coarser.levels().begin(), coarser.levels().end());
  for (CompanionGrids::Level& level : levels)
    if (!level.state.outline()) level.state = level.state.with_outline(modulus);
  return state.beside(std::make_shared<const CompanionGrids>(coarser.request(), std::move(levels)))
      .with_outline(modulus);
}

struct Trial {
  Scene scene;
  std::shared_ptr<const ContactGeometry> geometry;
  Plan plan;
  std::shared_ptr<const Solver> solver;
  std::optional<State> state;
  std::string source;
};

Trial make_trial(Placed placed, double tolerance) {
  Trial trial{std::move(placed.scene), {}, {}, {}, {}, std::move(placed.source)};
  trial.scene.accuracy.tolerance = tolerance;
  trial.scene.accuracy.estimate = Accuracy::Estimate::coarser;
  trial.scene.accuracy.chosen = true;
  trial.geometry = std::make_shared<const ContactGeometry>(trial.scene, placed.pose);
  trial.plan = plan_with_estimate(trial.scene, *trial.geometry);
  // A coarse grid that misses its tolerance is not the last word.
  Plan lenient = trial.plan;
  lenient.accuracy.on_failure = Accuracy::OnFailure::best;
  trial.solver = make_solver(lenient, trial.geometry);
  return trial;
}

struct GridToTry {
  Grid grid;
  bool half_way = false;  // half as many cells again as one of the doubling sequence
};

// Coarse to fine, through the cells given, each twice the cells of the one before, and with `half_ways` those
// half-way between.
std::vector<GridToTry> grids_to_try(const Grid& given, const Grid& finest, bool half_ways) {
  Grid grid = given;
  while (grid.nx % 2 == 0 && grid.ny % 2 == 0 && std::max(grid.nx, grid.ny) / 2 >= fewest_cells_to_begin &&
         !coarser_grids({grid.nx / 2, grid.ny / 2, grid.size_x, grid.size_y}).empty()) {
    grid.nx /= 2;
    grid.ny /= 2;
  }
  std::vector<GridToTry> grids;
  for (; grid.nx <= finest.nx && grid.ny <= finest.ny; grid.nx *= 2, grid.ny *= 2) {
    grids.push_back({grid});
    const Grid between{grid.nx / 2 * 3, grid.ny / 2 * 3, grid.size_x, grid.size_y};
    if (half_ways && grid.nx % 2 == 0 && grid.ny % 2 == 0 && between.nx < finest.nx)
      grids.push_back({between, true});
  }
  return grids;
}

// On half-way cells a body under a flat alone lies as it did, and the doubt of an outline alone is known to
// fall as it should.
bool takes_half_ways(const Scene& scene, const Plan& plan) {
  const std::vector<std::string>& of = scene.accuracy.asked->of;
  return std::all_of(of.begin(), of.end(), is_corrected_area) && operator_of_outlines(plan) != nullptr &&
         !std::holds_alternative<Surface>(scene.upper);
}

// The grid to try after that of this state, at place `k`, of which the outline, where the choice goes by it,
// tells how many cells would do; else twice the cells. The last where none is fine enough.
std::size_t next_to_try(const std::vector<GridToTry>& grids, std::size_t k, const State& state, double error,
                        int fewest, bool by_outline) {
  constexpr double falls = 1 / 1.38, most_times = 16, rounding = 0.999;
  const int nx = grids[k].grid.nx;
  std::size_t next = k + 1;
  if (by_outline && state.outline()) {
    const double times =
        elementary::pow(std::max(1.0, margin_of_doubt * state.outline()->doubt / error), falls);
    const double wanted = rounding * std::min(most_times, times) * nx;
    while (next + 1 < grids.size() &&
           (grids[next].grid.nx < wanted || std::max(grids[next].grid.nx, grids[next].grid.ny) < fewest))
      ++next;
  } else {
    while (next < grids.size() && grids[next].half_way) ++next;
  }
  return next;
}

// The trial before on a grid of `nx` cells, and the finer of the two grids that it was compared with.
std::shared_ptr<const CompanionGrids> coarser_than(int nx, const PressRequest& request, const State& before) {
  std::vector<CompanionGrids::Level> levels{
      {before.beside(nullptr), static_cast<double>(nx) / before.grid().nx},
      before.companion_grids()->levels().front()};
  return std::make_shared<const CompanionGrids>(request, std::move(levels));
}

[[noreturn]] void refuse(const ChosenAccuracy& reached, const std::string& where) {
  throw Error(ErrorCode::not_converged,
              "`error` = " + format_short(reached.asked.error) + " of " + quoted(reached.of) +
                  " was asked for, and " + where + " it comes to " + percent_text(reached.error),
              std::isfinite(reached.error)
                  ? "ask for " + format_short(2 * reached.error, 1) +
                        ", or give on_failure=\"best\" to have what was reached"
                  : "it grows from grid to grid without end or is zero there: ask for another quantity, or "
                    "give on_failure=\"best\" to have what was reached");
}

}  // namespace

double first_tolerance(const AskedError& asked) {
  struct Share {
    double of_error, loosest;
  };
  constexpr double of_areas = 1e-2, of_others = 3e-4, loosest = 1e-3;
  const bool areas = std::all_of(asked.of.begin(), asked.of.end(), is_area);
  return std::clamp((areas ? of_areas : of_others) * asked.error, tightest, loosest);
}

std::string choice_text(const Scene& scene, const Plan& plan) {
  if (!scene.accuracy.asked) return {};
  const AskedError& asked = *scene.accuracy.asked;
  const std::string error = percent_text(asked.error) + " of " + joined(asked.of, " and ");
  if (scene.accuracy.chosen)
    return "cells and tolerance as the first press chose them for an error of " + error;
  const std::vector<GridToTry> grids =
      grids_to_try(scene.lower.grid(), finest_grid(scene.lower.grid(), plan), false);
  return "the first press chooses cells and tolerance for an error of " + error + ", from " +
         cells_text(grids.front().grid.nx, grids.front().grid.ny) + " up to " +
         cells_text(grids.back().grid.nx, grids.back().grid.ny) + "; what follows is of the cells given";
}

Grid finest_grid(const Grid& given, const Plan& plan) {
  double most = most_bytes_of_a_choice;
  if (const std::int64_t limit = memory::limit(); limit > 0)
    most = std::min(most, 0.8 * static_cast<double>(limit - memory::held()));
  Grid finest = given;
  double bytes = static_cast<double>(plan.bytes_grown());
  while (std::max(finest.nx, finest.ny) <= max_cells / 2 && 4 * bytes <= most) {
    finest.nx *= 2;
    finest.ny *= 2;
    bytes *= 4;
  }
  return finest;
}

AccuracyChoice choose_accuracy(const Scene& scene, const ContactGeometry& geometry,
                               const PressRequest& request, Monitor& monitor) {
  laws_met().meet(Law::asked_error);
  const AskedError& asked = *scene.accuracy.asked;
  const Grid& given = geometry.grid();
  const Plan plan_given = plan_with_estimate(scene, geometry);
  const bool by_outline = takes_half_ways(scene, plan_given);
  const std::vector<GridToTry> grids = grids_to_try(given, finest_grid(given, plan_given), by_outline);
  const double rms_given = rms_of(geometry.combined());
  const auto begun = std::chrono::steady_clock::now();

  ChosenAccuracy chosen;
  chosen.asked = asked;
  chosen.precision = scene.accuracy.precision;
  chosen.why_precision = scene.accuracy.precision_named               ? "as named"
                         : !scene.elasticity.model().moves_every_node ? "boxes are solved in no other"
                                                                      : "single saves no time";
  double tolerance = first_tolerance(asked);
  const CostScope scope;
  Cost last;  // of the press that is kept
  std::optional<Trial> trial;
  const int fewest =
      std::all_of(asked.of.begin(), asked.of.end(), is_corrected_area) ? fewest_of_an_area : fewest_of_others;
  int endless = 0;
  for (std::size_t k = 0; k < grids.size();) {
    const Grid& grid = grids[k].grid;
    const auto shares = static_cast<double>(grids.size());
    PartMonitor part(monitor, "choice of cells", cells_text(grid.nx, grid.ny),
                     static_cast<double>(k) / shares, static_cast<double>(k + 1) / shares, begun);
    part.begin();
    const std::optional<State> before = trial ? trial->state : std::nullopt;
    std::optional<State> guess = before;
    // Fewer cells than were measured are nodes of theirs; between these heights would be smoothed.
    const bool known_only = grids[k].half_way && grid.nx < given.nx;
    std::optional<AtCells> lower = known_only ? known_at_cells(scene.lower, grid.nx, grid.ny, part)
                                              : at_cells(scene.lower, grid.nx, grid.ny, part);
    if (!lower) {
      ++k;
      continue;
    }
    const Placed placed = placed_on(scene, geometry.pose(), *std::move(lower), part);
    bool counts = true;  // this grid tells how many cells would do
    for (bool again = true; again;) {
      again = false;
      const CostScope here;
      trial = make_trial(placed, tolerance);
      State state = press_from_coarser(*trial->solver, guess ? &*guess : nullptr, request, part)
                        .costing_also(trial->solver->preparation());
      last = here.so_far();
      state =
          state.beside(before ? coarser_than(grid.nx, request, *before)
                              : solve_coarser(trial->scene, *trial->geometry, trial->plan, request, part));
      state = outlined(std::move(state), trial->plan, asked);
      Judged found = judged(state, asked);
      std::string note;
      constexpr double alike = 0.1;
      counts = true;
      if (grid.nx < given.nx &&
          std::abs(rms_of(trial->geometry->combined()) - rms_given) > alike * rms_given) {
        note = "the heights were not carried";
        counts = false;
      } else if (!state.converged()) {
        note = "the tolerance was missed";
        counts = false;
      } else if (grid.nx < given.nx && std::max(grid.nx, grid.ny) < fewest) {
        note = "no finer grid agreed yet";
      }
      if (!note.empty()) found.error = std::max(found.error, 2 * asked.error);
      const Cost cost = here.so_far();
      chosen.tried.push_back({grid.nx, grid.ny, tolerance, found.error, found.of, note, cost});
      trial->state = std::move(state);
      chosen.nx = grid.nx;
      chosen.ny = grid.ny;
      chosen.tolerance = tolerance;
      chosen.error = found.error;
      chosen.of = found.of;
      chosen.outline_between_nodes = trial->state->outline().has_value();
      chosen.source = trial->source;
      // More cells would not help where the bound of the solve is what is missing.
      if (!chosen.met() && note.empty() && found.error - found.algebraic <= asked.error &&
          tolerance > tightest) {
        tolerance = std::max(tolerance / tighter, tightest);
        guess = trial->state;
        again = true;
      }
      endless = std::isinf(found.error) && std::max(grid.nx, grid.ny) >= fewest_of_others ? endless + 1 : 0;
    }
    if (chosen.met() || endless == 3) break;
    k = next_to_try(grids, k, *trial->state, asked.error, fewest, by_outline && counts);
  }
  if (!chosen.met() && scene.accuracy.on_failure == Accuracy::OnFailure::error)
    refuse(chosen, "on " + cells_text(chosen.nx, chosen.ny) +
                       (endless == 3 ? "" : ", the finest that memory allows,"));

  // Every solver counted transforms of its own grid; they count as those of the grid chosen.
  double surplus = 0;
  for (const TriedGrid& tried : chosen.tried)
    surplus += (1 - transform_work(tried.nx, tried.ny) / transform_work(chosen.nx, chosen.ny)) *
               tried.cost.transforms;
  cost::count_transforms(-surplus);
  for (const std::string& quantity : asked.of)
    chosen.values.push_back(discretisation_estimate(*trial->state, quantity).value);
  Cost others = scope.so_far();
  others.seconds -= last.seconds;
  others.transforms -= last.transforms;

  // What later presses are compared with.
  constexpr std::size_t most_compared = 2;
  std::vector<Grid>& compared = trial->scene.accuracy.compared;
  for (const TriedGrid* tried = chosen.before(); tried != nullptr && compared.size() < most_compared;
       tried = chosen.before(tried->nx))
    compared.push_back({tried->nx, tried->ny, given.size_x, given.size_y});
  trial->plan = plan_with_estimate(trial->scene, *trial->geometry);
  trial->plan.choice = choice_text(trial->scene, trial->plan);
  trial->solver = make_solver(trial->plan, trial->geometry);
  State state = trial->state->costing_also({others, {{"choice", others}}})
                    .chosen_as(std::make_shared<const ChosenAccuracy>(std::move(chosen)));
  return {std::move(trial->scene), std::move(trial->geometry), std::move(trial->plan),
          std::move(trial->solver), std::move(state)};
}

State held_to(const State& given, const ChosenAccuracy& chosen, const Scene& scene, const Plan& plan) {
  ChosenAccuracy now = chosen;
  const State state = outlined(given, plan, chosen.asked);
  now.outline_between_nodes = state.outline().has_value();
  const Judged found = judged(state, chosen.asked, chosen.values);
  now.error = found.error;
  now.of = found.of;
  if (!now.met() && scene.accuracy.on_failure == Accuracy::OnFailure::error)
    refuse(now, "on the " + cells_text(now.nx, now.ny) + " that the first press of this contact chose");
  return state.chosen_as(std::make_shared<const ChosenAccuracy>(std::move(now)));
}

}  // namespace asperity
