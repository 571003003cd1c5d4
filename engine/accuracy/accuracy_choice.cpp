// SPDX-License-Identifier: GPL-3.0-or-later
// Solve, judge, find the next grid. Constants come from bench/requested_error.lua, seeds 1 to 10;
// docs/accuracy.md lists other seeds.
#include "engine/accuracy/accuracy_choice.hpp"

#include "engine/accuracy/companion_grids.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/accuracy/finer_heights.hpp"
#include "engine/contact/quantities.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/operations/resampling.hpp"

namespace asperity {

namespace {

constexpr int fewest_cells_to_begin = 16;
// An area needs a coarser grid, other quantities two.
constexpr int fewest_of_an_area = 32, fewest_of_others = 64;
constexpr double tightest = 1e-10, tighter = 30;
constexpr double with_coarser = 4.0 / 3;  // work including all coarser grids

bool is_area(std::string_view quantity) {
  return quantity == "corrected_area_fraction" || quantity == "area_fraction" || quantity == "area";
}
bool only_areas(const AskedError& asked) { return std::ranges::all_of(asked.of, is_area); }
bool is_corrected_area(std::string_view quantity) { return quantity == "corrected_area_fraction"; }

double rms_of(const Field& heights) {
  const double middle = known_mean(heights.values());
  Array<double> squares(heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) squares[k] = (heights[k] - middle) * (heights[k] - middle);
  return std::sqrt(known_mean(squares));
}

Grid doubled(Grid grid) {
  grid.nx *= 2;
  grid.ny *= 2;
  return grid;
}

// --- the grids

struct GridsToTry {
  Grid first, finest;
  std::string limit;  // "4096 x 4096 cells are the most within 4 GiB of memory"
};

bool can_be_made_again(const Scene& scene) {
  const auto* const upper = std::get_if<Surface>(&scene.upper);
  return scene.lower.recipe() && (upper == nullptr || upper->recipe());
}

// Scaled from the plan of the given cells.
double seconds_up_to(const Grid& grid, const Grid& given, const Plan& plan) {
  return with_coarser * plan.seconds * transform_work(grid) / transform_work(given);
}
double bytes_on(const Grid& grid, const Grid& given, const Plan& plan) {
  return static_cast<double>(plan.bytes_grown()) * static_cast<double>(grid.nodes()) /
         static_cast<double>(given.nodes());
}

GridsToTry grids_to_try(const Scene& scene, const Plan& plan) {
  const AskedError& asked = *scene.accuracy.asked;
  const Grid& given = scene.lower.grid();
  Grid grid = given;
  while (grid.nx % 2 == 0 && grid.ny % 2 == 0 && std::max(grid.nx, grid.ny) / 2 >= fewest_cells_to_begin &&
         !coarser_grids({grid.nx / 2, grid.ny / 2, grid.size_x, grid.size_y}).empty()) {
    grid.nx /= 2;
    grid.ny /= 2;
  }
  GridsToTry grids{grid, grid, {}};
  double most_bytes = asked.most_bytes;
  if (const std::int64_t limit = memory::limit(); limit > 0)
    most_bytes = std::min(most_bytes, 0.8 * static_cast<double>(limit - memory::held()));
  std::string why;
  while (why.empty()) {
    grid = doubled(grids.finest);
    if (std::max(grid.nx, grid.ny) > asked.most_cells)
      why = "within " + std::to_string(asked.most_cells) + " cells a side";
    else if (grid.nx > given.nx && !can_be_made_again(scene))
      why = "with known heights";
    else if (bytes_on(grid, given, plan) > most_bytes)
      why = "within " + format_bytes(static_cast<std::int64_t>(most_bytes)) + " of memory";
    else if (seconds_up_to(grid, given, plan) > asked.most_seconds)
      why = "within an expected " + format_quantity(asked.most_seconds, dimension::time);
    else
      grids.finest = grid;
  }
  grids.limit = cells_text(grids.finest.nx, grids.finest.ny) + " are the most " + why;
  return grids;
}

// --- the bodies on other cells

struct Placed {
  Scene scene;
  Pose pose;
  std::string source;
};

std::string_view word(AtCells::How how) {
  constexpr std::string_view words[] = {"as given", "nodes of the cells given", "generated again",
                                        "interpolated"};
  return words[static_cast<std::size_t>(how)];
}

// Node over node as on the given cells, in its own frame.
AtCells upper_on(const Surface& upper, const Grid& grid, const LatticeIsometry& given, Boundary boundary,
                 const LatticeIsometry& lattice, Monitor& monitor) {
  const AtCells own = grid.nx < given.nx() ? AtCells{upper, AtCells::How::sampled}
                                           : at_cells(upper, grid.nx, grid.ny, monitor);
  const Field seen = sampled(over_lower(own.surface.heights(), given, boundary), grid.nx, grid.ny);
  SurfaceTraits traits = upper.traits();
  traits.aliased_share.reset();
  return {Surface(grid, lattice.to_upper(seen), std::move(traits)), own.how};
}

Placed placed_on(const Scene& scene, const Pose& pose, const Grid& grid, Monitor& monitor) {
  AtCells lower = at_cells(scene.lower, grid.nx, grid.ny, monitor);
  if (lower.how == AtCells::How::unchanged) return {scene, pose, std::string(word(lower.how))};
  Scene there = scene;
  there.lower = std::move(lower.surface);
  std::string source(word(lower.how));
  const LatticeIsometry lattice = LatticeIsometry(grid.nx, grid.ny).turned(pose.lattice().quarters());
  if (const auto* upper = std::get_if<Surface>(&scene.upper)) {
    AtCells own = pose.on_lattice()
                      ? upper_on(*upper, there.lower.grid(), pose.lattice(), scene.boundary, lattice, monitor)
                      : at_cells(*upper, grid.nx, grid.ny, monitor);
    if (own.how != lower.how) source += " and " + std::string(word(own.how));
    there.upper = std::move(own.surface);
  }
  Pose turned = lattice;
  if (!pose.on_lattice()) turned = turned.turned(pose.rest(), there.lower.grid());
  return {std::move(there), turned, std::move(source)};
}

// --- the error of a state

// Waves shorter than four cells, by mean square slopes or bends (which decide peaks between nodes). Over two
// cells, a wave of m cells has c = 2(1 + cos(2 pi/m)) times the square slope, c² times the square bend.
// Smooth heights: c = 4, white noise: c = 1; a kink: 6 for bends.
bool waves_are_missed(const State& state, bool bends) {
  constexpr double smooth_slopes = 2.8, smooth_bends = 5;
  const Field& h = state.geometry().combined();
  const bool wraps = state.geometry().boundary() == Boundary::periodic;
  const int nx = h.nx(), ny = h.ny();
  const auto mean_square = [&](int apart) {
    double sum = 0, count = 0;
    const auto add = [&](double before, double here, double after) {
      const double difference = after - here - (bends ? here - before : 0);
      if (std::isnan(difference)) return;
      sum += difference * difference;
      count += 1;
    };
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (wraps || (i >= apart && i + apart < nx))
          add(h((i + nx - apart) % nx, j), h(i, j), h((i + apart) % nx, j));
        if (wraps || (j >= apart && j + apart < ny))
          add(h(i, (j + ny - apart) % ny), h(i, j), h(i, (j + apart) % ny));
      }
    return count > 0 ? sum / count : 0.0;
  };
  return mean_square(2) < (bends ? smooth_bends : smooth_slopes) * mean_square(1);
}

// At most a tenth of the doubtful nodes change sides.
double algebraic_share(const State& state, std::string_view name) {
  constexpr double of_areas = 0.1;
  const StateQuantity* const quantity = find_quantity(name);
  if (quantity->bound == nullptr || (state.outline() && is_corrected_area(name))) return 0;
  return (is_area(name) ? of_areas : 1) * quantity->bound(state).value_or(0);
}

// `chosen.values`: from the first press, or empty. Returns the algebraic part.
double judge(const State& state, ChosenAccuracy& chosen) {
  constexpr double no_value = 1e-9;
  const std::vector<double> first = std::exchange(chosen.values, {});
  double algebraic = 0;
  for (std::size_t k = 0; k < chosen.asked.of.size(); ++k) {
    const std::string& name = chosen.asked.of[k];
    const DiscretisationEstimate estimate = discretisation_estimate(state, name);
    double scale = std::abs(estimate.value);
    if (k < first.size() && scale < no_value * std::abs(first[k])) scale = std::abs(first[k]);
    const double bound = algebraic_share(state, name), error = estimate.margin * estimate.error + bound;
    const double relative = error == 0 ? 0.0 : error / scale;
    chosen.values.push_back(estimate.value);
    if (k > 0 && !(relative > chosen.error)) continue;
    chosen.error = relative;
    chosen.of = name;
    algebraic = bound == 0 ? 0.0 : bound / scale;
  }
  chosen.outline_between_nodes = state.outline().has_value();
  return algebraic;
}

// On every grid, if requested and possible.
State outlined(State state, const Plan& plan, const AskedError& asked) {
  if (plan.elasticity->wave_share() != nullptr || std::ranges::none_of(asked.of, is_corrected_area))
    return state;
  const double modulus = plan.elasticity->modulus;
  const CompanionGrids& coarser = *state.companion_grids();
  std::vector<CompanionGrids::Level> levels(coarser.levels().begin(), coarser.levels().end());
  for (CompanionGrids::Level& level : levels)
    if (!level.state.outline()) level.state = level.state.with_outline(modulus);
  return state.beside(std::make_shared<const CompanionGrids>(coarser.request(), std::move(levels)))
      .with_outline(modulus);
}

[[noreturn]] void refuse_accuracy(const ChosenAccuracy& reached, const std::string& where) {
  const bool endless = !std::isfinite(reached.error);
  const std::string& note = reached.tried.back().note;
  throw Error(ErrorCode::not_converged,
              "`error` = " + format_short(reached.asked.error) + " of " + quoted(reached.of) +
                  " was requested, and " + where + " it comes to " + percent_text(reached.error) +
                  (note.empty() ? "" : " (" + note + ")"),
              (endless ? "it grows without limit on finer grids, or the quantity is zero: request another one"
                       : "it needs about " + std::to_string(reached.cells_needed()) + " cells a side, and " +
                             reached.limit + "; press a smaller piece (`cropped`)" +
                             (reached.error < 0.5 ? ", request " + format_short(2 * reached.error, 1) : "")) +
                  ", or accept the best result with on_failure=\"best\"");
}

// --- the choice

class Choice {
 public:
  Choice(const Scene& scene, const ContactGeometry& geometry, const PressRequest& request, Monitor& monitor)
      : scene_(scene),
        geometry_(geometry),
        request_(request),
        monitor_(monitor),
        grids_(grids_to_try(scene, plan_with_estimate(scene, geometry))),
        rms_given_(rms_of(geometry.combined())) {
    chosen_.asked = *scene.accuracy.asked;
    chosen_.limit = grids_.limit;
    chosen_.precision = scene.accuracy.precision;
    chosen_.why_precision = scene.accuracy.precision_named      ? "as named"
                            : scene.elasticity.model().is_local ? "boxes are solved in no other"
                                                                : "single saves no time";
  }

  AccuracyChoice run() {
    std::optional<Step> step = Step{grids_.first, before_choice(scene_.accuracy).tolerance};
    while (step) {
      try_grid(*step);
      judge_grid(*step);
      step = next(*step);
    }
    if (!chosen_.met() && scene_.accuracy.on_failure == Accuracy::OnFailure::error)
      refuse_accuracy(chosen_, "on " + cells_text(chosen_.nx, chosen_.ny));
    return result();
  }

 private:
  struct Step {
    Grid grid;
    double tolerance;
  };

  void try_grid(const Step& step);
  void judge_grid(const Step& step);
  std::optional<Step> next(const Step& step) const;
  AccuracyChoice result();
  std::string why_it_does_not_count(const Grid& grid) const;
  // After failure of a generator, for example random heights.
  bool is_interpolated(const Grid& grid) const {
    return grid.nx > geometry_.grid().nx && chosen_.source.find("interpolated") != std::string::npos;
  }

  const Scene& scene_;
  const ContactGeometry& geometry_;
  const PressRequest& request_;
  Monitor& monitor_;
  const GridsToTry grids_;
  const double rms_given_;
  const CostScope scope_;
  const PartMonitor::Clock::time_point begun_ = PartMonitor::Clock::now();
  ChosenAccuracy chosen_;
  std::optional<AccuracyChoice> trial_;
  Cost press_{}, tried_{};        // of the trial, without and with other grids
  std::optional<State> coarser_;  // previous grid
  double algebraic_ = 0;
};

// At first, also solves coarser grids of the estimate.
void Choice::try_grid(const Step& step) {
  const double parts = elementary::log2(static_cast<double>(grids_.finest.nx) / grids_.first.nx) + 1;
  const double part_now = elementary::log2(static_cast<double>(step.grid.nx) / grids_.first.nx);
  PartMonitor part(monitor_, "choice of cells", cells_text(step.grid.nx, step.grid.ny), part_now / parts,
                   (part_now + 1) / parts, begun_);
  part.begin();
  const CostScope here;
  const std::optional<State> guess = trial_ ? std::optional(trial_->state) : std::nullopt;
  if (guess && guess->grid() != step.grid) coarser_ = guess;
  trial_.reset();
  Placed placed = placed_on(scene_, geometry_.pose(), step.grid, part);
  chosen_.source = std::move(placed.source);
  Scene scene = std::move(placed.scene);
  scene.accuracy.tolerance = step.tolerance;
  scene.accuracy.estimate = Accuracy::Estimate::coarser;
  scene.accuracy.chosen = true;
  const auto geometry = std::make_shared<const ContactGeometry>(scene, placed.pose);
  Plan plan = plan_with_estimate(scene, *geometry), lenient = plan;
  lenient.accuracy.on_failure = Accuracy::OnFailure::best;
  const std::shared_ptr<const Solver> solver = make_solver(lenient, geometry);
  State state = press_from_coarser(*solver, guess ? &*guess : nullptr, request_, part)
                    .costing_also(solver->preparation());
  press_ = here.so_far();
  const auto levels =
      coarser_
          ? std::make_shared<const CompanionGrids>(
                request_, std::vector<CompanionGrids::Level>{{coarser_->beside(nullptr), 2.0},
                                                             coarser_->companion_grids()->levels().front()})
          : solve_coarser(scene, *geometry, plan, request_, part);
  state = outlined(state.beside(levels), plan, chosen_.asked);
  trial_ = AccuracyChoice{std::move(scene), geometry, std::move(plan), solver, std::move(state)};
  tried_ = here.so_far();
}

// Reason to reject this grid; empty if none.
std::string Choice::why_it_does_not_count(const Grid& grid) const {
  constexpr double alike = 0.1;
  const State& state = trial_->state;
  if (!state.converged()) return "the tolerance was missed";
  if (is_interpolated(grid)) return "the heights are not known there";
  if (grid.nx < geometry_.grid().nx &&
      std::abs(rms_of(trial_->geometry->combined()) - rms_given_) > alike * rms_given_)
    return "the heights were not carried";
  if (grid.nx >= grids_.finest.nx) return {};
  const bool areas = only_areas(chosen_.asked);
  if (std::max(grid.nx, grid.ny) < (areas ? fewest_of_an_area : fewest_of_others))
    return "too few grids to compare";
  return waves_are_missed(state, !areas) ? "waves have fewer than four cells" : "";
}

void Choice::judge_grid(const Step& step) {
  chosen_.nx = step.grid.nx;
  chosen_.ny = step.grid.ny;
  chosen_.tolerance = step.tolerance;
  chosen_.values.clear();
  algebraic_ = judge(trial_->state, chosen_);
  chosen_.tried.push_back({step.grid.nx, step.grid.ny, step.tolerance, chosen_.error, chosen_.of,
                           why_it_does_not_count(step.grid), tried_});
}

std::optional<Choice::Step> Choice::next(const Step& step) const {
  if (chosen_.met()) return {};
  const TriedGrid& last = chosen_.tried.back();
  // More cells do not reduce the algebraic error.
  if (last.note.empty() && last.error - algebraic_ <= chosen_.asked.error && step.tolerance > tightest)
    return Step{step.grid, std::max(step.tolerance / tighter, tightest)};
  if (step.grid.nx >= grids_.finest.nx || is_interpolated(step.grid)) return {};
  // On a measured map, further grids are cheaper than another measurement.
  if (scene_.accuracy.on_failure == Accuracy::OnFailure::error && last.note.empty() &&
      grids_.finest.nx > geometry_.grid().nx) {
    constexpr std::size_t in_a_row = 3;
    std::size_t endless = 0;
    for (const TriedGrid& tried : chosen_.tried)
      endless = std::isinf(tried.error) && std::max(tried.nx, tried.ny) >= fewest_of_others ? endless + 1 : 0;
    // Coarse grids overestimate the required cells by less.
    constexpr double far_beyond = 4;
    if (endless == in_a_row ||
        (std::isfinite(last.error) && chosen_.cells_needed() > far_beyond * grids_.finest.nx))
      return {};
  }
  return Step{doubled(step.grid), step.tolerance};
}

AccuracyChoice Choice::result() {
  const Grid& grid = trial_->geometry->grid();
  double surplus = 0;
  for (const TriedGrid& tried : chosen_.tried)
    surplus +=
        (1 - transform_work({tried.nx, tried.ny, 1, 1}) / transform_work(grid)) * tried.cost.transforms;
  cost::count_transforms(-surplus);
  Cost others = scope_.so_far();
  others.seconds -= press_.seconds;
  others.transforms -= press_.transforms;
  plan_choice(trial_->scene, trial_->plan);
  trial_->solver = make_solver(trial_->plan, trial_->geometry);
  trial_->state = trial_->state.costing_also({others, {{"choice", others}}})
                      .chosen_as(std::make_shared<const ChosenAccuracy>(std::move(chosen_)));
  return *std::move(trial_);
}

}  // namespace

Accuracy before_choice(Accuracy accuracy) {
  // Shares of the request: algebraic bounds almost always below the discretisation error.
  constexpr double of_areas = 1e-2, of_others = 3e-4, loosest = 1e-3;
  if (!accuracy.asked) return accuracy;
  const double share = only_areas(*accuracy.asked) ? of_areas : of_others;
  accuracy.tolerance = std::clamp(share * accuracy.asked->error, tightest, loosest);
  return accuracy;
}

Accuracy with_tolerance(Accuracy accuracy, double tolerance) {
  accuracy.tolerance = tolerance;
  accuracy.asked.reset();
  return accuracy;
}

Accuracy without_companion(Accuracy accuracy) {
  accuracy.estimate = Accuracy::Estimate::none;
  return accuracy;
}

void plan_choice(const Scene& scene, Plan& plan) {
  if (!scene.accuracy.asked) return;
  const AskedError& asked = *scene.accuracy.asked;
  const std::string error = percent_text(asked.error) + " of " + joined(asked.of, " and ");
  if (scene.accuracy.chosen) {
    plan.choice = "cells and tolerance as the first press chose them for an error of " + error;
    return;
  }
  const Grid& given = scene.lower.grid();
  const GridsToTry grids = grids_to_try(scene, plan);
  plan.choice = "the first press chooses cells and tolerance for an error of " + error + ", from " +
                cells_text(grids.first.nx, grids.first.ny) + " on; " + grids.limit +
                ", the grid of the memory and time below";
  plan.transforms *= with_coarser;
  plan.seconds = seconds_up_to(grids.finest, given, plan);
  plan.buffers = {
      {"a press on the finest cells", static_cast<std::int64_t>(bytes_on(grids.finest, given, plan)), true}};
  plan.bytes_to_flatten = 0;
}

AccuracyChoice choose_accuracy(const Scene& scene, const ContactGeometry& geometry,
                               const PressRequest& request, Monitor& monitor) {
  return Choice(scene, geometry, request, monitor).run();
}

State held_to(const State& given, const ChosenAccuracy& chosen, const Scene& scene, const Plan& plan) {
  ChosenAccuracy now = chosen;
  const State state = outlined(given, plan, chosen.asked);
  judge(state, now);
  if (!now.met() && scene.accuracy.on_failure == Accuracy::OnFailure::error)
    refuse_accuracy(now,
                    "on the " + cells_text(now.nx, now.ny) + " that the first press of this contact chose");
  return state.chosen_as(std::make_shared<const ChosenAccuracy>(std::move(now)));
}

}  // namespace asperity
