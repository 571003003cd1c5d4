// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/specimen_pair.hpp"
#include "engine/core/require.hpp"

#include <numbers>

#include "engine/accuracy/accuracy_choice.hpp"
#include "engine/accuracy/discretisation_error.hpp"
#include "engine/contact/after_event.hpp"
#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/arithmetic/random.hpp"

namespace asperity {

namespace {

Scene checked(const Scene& scene) {
  check(scene);
  check_accuracy(scene);
  Scene result = scene;
  result.accuracy = before_choice(scene.accuracy);
  return result;
}

Plan planned(const Scene& scene, const ContactGeometry& geometry) {
  Plan plan = plan_with_estimate(scene, geometry);
  plan_choice(scene, plan);
  return plan;
}

// With companion grids at the cost `estimate`. With chosen accuracy the press starts from coarser grids.
State pressed_with_estimate(const Solver& solver, const Scene& scene, const ContactGeometry& geometry,
                            const Plan& plan, const PressRequest& request, const ChosenAccuracy* chosen,
                            Monitor& monitor) {
  const bool finer = scene.accuracy.estimate == Accuracy::Estimate::finer;
  const bool coarser_first = chosen != nullptr && !finer && request.by_load();
  // A quarter plus a sixteenth, or four times the cells.
  const double share_of_press = finer ? 0.2 : 0.75;
  const double from = coarser_first ? 1 - share_of_press : 0;
  const auto begun = PartMonitor::Clock::now();
  const auto part = [&](const char* name, double begin, double end) {
    return PartMonitor(monitor, "press with an estimate", name, begin, end, begun);
  };
  PartMonitor pressing = part("press", from, from + share_of_press);
  PartMonitor estimating = part(finer ? "finer grid" : "coarser grids", coarser_first ? 0 : share_of_press,
                                coarser_first ? from : 1);
  std::optional<State> state;
  if (!coarser_first) state = solver.press(request, pressing);
  const CostScope scope;
  estimating.begin();
  const std::shared_ptr<const CompanionGrids> companions =
      finer ? solve_finer(scene, geometry, plan, request, estimating)
            : solve_coarser(scene, geometry, plan, request, estimating);
  Cost cost = scope.so_far();
  if (coarser_first)
    state = press_from_coarser(solver, &companions->levels().front().state, request, pressing);
  const CostScope judging;
  state = state->beside(companions);
  if (chosen != nullptr) state = held_to(*state, *chosen, scene, plan);
  cost += judging.so_far();
  return state->costing_also({cost, {{"estimate", cost}}});
}

// Rms step across the rim over twice the one inside, along one direction.
template <class At>
bool steps_along(int along, int lines, const At& at) {
  double inside = 0, across = 0;
  const auto squared = [](double difference) { return difference * difference; };
  for (int line = 0; line < lines; ++line) {
    for (int k = 0; k + 1 < along; ++k) inside += squared(at(k + 1, line) - at(k, line));
    across += squared(at(0, line) - at(along - 1, line));
  }
  constexpr double times = 2;
  return across / lines > times * times * (inside / std::max(1.0, static_cast<double>(along - 1) * lines));
}

bool steps_at_the_rim(const Surface& surface) {
  if (surface.traits().periodic) return false;
  const Field& z = surface.heights();
  const int nx = surface.grid().nx, ny = surface.grid().ny;
  return steps_along(nx, ny, [&](int k, int line) { return z(k, line); }) ||
         steps_along(ny, nx, [&](int k, int line) { return z(line, k); });
}

int whole_cells(double length, double cell, std::string_view key) {
  const double cells = length / cell;
  const double whole = std::round(cells);
  constexpr double most = 1e9;
  if (!(std::abs(cells) <= most))
    refuse("`shift` along " + std::string(key) + " is " + format_short(length) + " m",
           "give a finite length of a whole number of cells");
  if (std::abs(cells - whole) > 1e-9 * std::max(1.0, std::abs(whole)))
    refuse("`shift` along " + std::string(key) + " is " + format_short(cells, 10) + " cells",
           "give a whole number of cells of " + format_quantity(cell, dimension::length, 10));
  return static_cast<int>(whole);
}

}  // namespace

LatticeIsometry draw_placement(const Grid& grid, Boundary boundary, std::uint64_t seed) {
  const Stream stream(seed, "placement");
  const bool square = grid.nx == grid.ny && grid.size_x == grid.size_y;
  const auto quarters = static_cast<int>(square ? stream.below(0, 4) : 2 * stream.below(0, 2));
  const LatticeIsometry turned = LatticeIsometry(grid.nx, grid.ny).turned(quarters);
  if (boundary == Boundary::free) return turned;
  return turned.shifted(static_cast<int>(stream.below(1, static_cast<std::uint64_t>(grid.nx))),
                        static_cast<int>(stream.below(2, static_cast<std::uint64_t>(grid.ny))));
}

SpecimenPair::SpecimenPair(const Scene& scene)
    : scene_(checked(scene)),
      geometry_(std::make_shared<const ContactGeometry>(
          scene_, LatticeIsometry(scene_.lower.grid().nx, scene_.lower.grid().ny))),
      plan_(planned(scene_, *geometry_)) {}

std::shared_ptr<const Solver> SpecimenPair::solver() {
  if (!solver_) solver_ = make_solver(plan_, geometry_);
  return solver_;
}

Plan SpecimenPair::plan_of(const PressRequest& request) const {
  return plan_of_press(scene_, *geometry_, plan_, request);
}

void SpecimenPair::warn(const PressRequest& request, Monitor& monitor) {
  if (!std::exchange(warned_of_plan_, true))
    for (const std::string& warning : plan_.warnings) monitor.warn(warning);
  warn_of_an_overhang(monitor);
  warn_of_a_step_at_the_rim(monitor);
  if (request.dwell && !(plan_.yield && plan_.yield->softening) && !std::exchange(warned_of_dwell_, true))
    monitor.warn("`dwell` does nothing without " + joined(effect_names(Effect::Acts::scales_bound)) +
                 ": this scene does not name the effect " + effects_that(Effect::Acts::scales_bound) +
                 ", so no press depends on how long it lasts");
}

State SpecimenPair::press(const PressRequest& request, Monitor& monitor) {
  check(request, plan_.attracts());
  warn(request, monitor);
  if (scene_.accuracy.asked && !chosen_ && request.value > 0) return choose_and_press(request, monitor);
  const bool first = solver_ == nullptr;
  const std::shared_ptr<const Solver> ready = solver();
  State state =
      scene_.accuracy.estimate == Accuracy::Estimate::none
          ? ready->press(request, monitor)
          : pressed_with_estimate(*ready, scene_, *geometry_, plan_, request, chosen_.get(), monitor);
  if (first) state = state.costing_also(ready->preparation());
  return finished(state, request, monitor);
}

State SpecimenPair::finished(State state, const PressRequest& request, Monitor& monitor) {
  state = state.costing_also(leave_on_bodies(state, monitor));
  // Attractions without work appear in the ledger only.
  for (const GapTerm& term : plan_.attraction)
    if (!(term.work > 0)) state = state.costing_also({{}, {{term.effect, {}}}});
  carry(state, request);
  return state;
}

State SpecimenPair::choose_and_press(const PressRequest& request, Monitor& monitor) {
  AccuracyChoice choice = choose_accuracy(scene_, *geometry_, request, monitor);
  SpecimenPair after = *this;
  after.scene_ = std::move(choice.scene);
  after.geometry_ = std::move(choice.geometry);
  after.plan_ = std::move(choice.plan);
  after.solver_ = std::move(choice.solver);
  after.chosen_ = choice.state.chosen();
  State state = after.finished(std::move(choice.state), request, monitor);
  *this = std::move(after);
  return state;
}

StateCost SpecimenPair::leave_on_bodies(const State& state, Monitor& monitor) {
  StateCost cost;
  const auto counted = [&](const Effect& effect, const CostScope& scope) {
    const Cost its = scope.so_far();
    cost += {its, {{std::string(effect.name), its}}};
  };
  const Effect* last = nullptr;
  AfterEvent after(*geometry_);
  for (const Effect* effect : known_effects()) {
    if (effect->leave == nullptr || scene_.effects.options_of(*effect) == nullptr) continue;
    const CostScope scope;
    const bool before = std::exchange(after.changed, false);
    effect->leave(state, plan_, after);
    if (after.changed) last = effect;
    after.changed |= before;
    counted(*effect, scope);
  }
  if (!after.changed) return cost;

  const CostScope scope;
  Scene scene = scene_;
  scene.lower = std::move(after.lower);
  scene.upper = std::move(after.upper);
  auto geometry =
      std::make_shared<const ContactGeometry>(scene, *geometry_, std::move(after.memory), after.yielded);
  Plan plan = make_plan_like(plan_, scene, *geometry);
  plan_estimate(*geometry, plan);
  plan.choice = plan_.choice;
  if (plan.yield) {
    plan.yield->carried = plan_.yield->carried;
    if (after.carried) asperity::carry(plan.yield->carried, *after.carried);
  }
  constexpr double noticeable = 0.05;
  if (std::abs(after.mapped_volume - 1) > noticeable && !std::exchange(warned_of_mapping_, true))
    monitor.warn("at this angle, the cells give the upper body " +
                 format_short(100 * after.mapped_volume, 3) +
                 " % of its plastic volume, scaled to 100 % here; finer cells need less scaling");
  // Nothing throws below.
  std::swap(scene_, scene);
  std::swap(plan_, plan);
  geometry_ = std::move(geometry);
  solver_.reset();
  counted(*last, scope);
  return cost;
}

void SpecimenPair::warn_of_an_overhang(Monitor& monitor) {
  if (warned_of_overhang_ || !geometry_->overhangs()) return;
  warned_of_overhang_ = true;
  monitor.warn(
      "after this turn, the bodies face each other on " +
      format_short(100 * geometry_->overlap_fraction(), 3) +
      " % of the tile, the `overlap_fraction` of each state; `pressure` is load over the whole tile");
}

void SpecimenPair::warn_of_a_step_at_the_rim(Monitor& monitor) {
  if (warned_of_rim_ || scene_.boundary != Boundary::periodic || scene_.elasticity.model().is_local) return;
  std::vector<std::string> bodies;
  if (steps_at_the_rim(scene_.lower)) bodies.emplace_back("lower");
  if (const auto* rough = std::get_if<Surface>(&scene_.upper); rough && steps_at_the_rim(*rough))
    bodies.emplace_back("upper");
  if (bodies.empty()) return;
  warned_of_rim_ = true;
  const ElasticModel& model = scene_.elasticity.model();
  monitor.warn("the " + joined(bodies, " and the ") + (bodies.size() > 1 ? " bodies do" : " body does") +
               " not continue across the rim of the tile: on a periodic " + std::string(model.called) +
               " the step at the rim carries load, too" +
               (model.periodic_only ? "" : "; boundary=\"free\" avoids it"));
}

void SpecimenPair::carry(const State& state, const PressRequest& request) {
  history_.push_back({request,
                      {},
                      Done::Measured{state.load(), state.pressure(), state.approach(), state.area_fraction(),
                                     state.peak_pressure()}});
  // Removes expired watches.
  if (states_.size() == states_.capacity())
    std::erase_if(states_, [](const State::Watch& watch) { return watch.expired(); });
  states_.push_back(state.watch());
  under_load_ = state.load() > 0 || state.contacts() > 0;
  pressed_.reset();
  if (under_load_ && has_tangential(scene_.effects)) pressed_ = state;
}

PartialSlip SpecimenPair::shear(const ShearRequest& request, Monitor& monitor) {
  require_tangential(scene_.effects);
  if (pressed() == nullptr)
    refuse_state("the contact carries no load, so nothing resists shear", "press it first");
  return asperity::shear(*solver(), *pressed(), request, monitor);
}

void SpecimenPair::release() {
  history_.push_back({Protocol::Release{}});
  unload();
}

void SpecimenPair::date(std::size_t first, std::optional<double> time) {
  for (std::size_t k = first; k < history_.size(); ++k) history_[k].time = time;
}

void SpecimenPair::unload() {
  under_load_ = false;
  pressed_.reset();
}

void SpecimenPair::lay(const Pose& pose) {
  if (pose == geometry_->pose()) {
    unload();
    return;
  }
  auto geometry = std::make_shared<ContactGeometry>(scene_, pose, geometry_->memory());
  geometry->keep_first_touch(*geometry_);
  Plan plan = planned(scene_, *geometry);
  // Under a rigid flat placements are one contact.
  const Material* flat = std::get_if<Material>(&scene_.upper);
  if (flat == nullptr || !flat->rigid) solver_.reset();
  geometry_ = std::move(geometry);
  plan_ = std::move(plan);
  unload();
}

void SpecimenPair::place(std::uint64_t seed) {
  lay(draw_placement(scene_.lower.grid(), scene_.boundary, seed));
  history_.push_back({Protocol::Place{seed}});
}

Pose SpecimenPair::turned(const Pose& from, double angle) const {
  constexpr double quarter = 0.5 * std::numbers::pi;
  const double quarters = angle / quarter;
  const std::string asked = "a turn by " + format_short(angle * 180 / std::numbers::pi, 10) + " deg";
  if (!(std::abs(quarters) < 1e6)) refuse(asked, "give a finite angle");
  const Grid& grid = scene_.lower.grid();
  const Pose turned = from.turned(angle, grid);
  if (scene_.boundary == Boundary::periodic && !turned.on_lattice()) {
    const double whole = std::round(turned.angle() / quarter);
    if (std::abs(turned.angle() - whole * quarter) <= 1e-9)
      refuse(asked + " does not fit a tile that is not square", "turn it by 180 deg, or use a square tile");
    refuse(asked + " does not fit a periodic tile, which turns by multiples of 90 deg",
           "place the body again with `place{seed=}`, or give boundary=\"free\"");
  }
  return turned;
}

void SpecimenPair::rotate(double angle) {
  lay(turned(pose(), angle));
  history_.push_back({Protocol::Rotate{angle}});
}

Pose SpecimenPair::shifted(const Pose& from, double x, double y) const {
  if (scene_.boundary != Boundary::periodic)
    refuse("`shift` is given on a free boundary, where a shifted body overhangs the rim",
           "use `boundary` = \"periodic\"");
  const Grid& grid = scene_.lower.grid();
  return from.lattice().shifted(whole_cells(x, grid.hx(), "x"), whole_cells(y, grid.hy(), "y"));
}

void SpecimenPair::shift(double x, double y) {
  lay(shifted(pose(), x, y));
  history_.push_back({Protocol::Shift{x, y}});
}

std::optional<State> SpecimenPair::perform(const Protocol::Step& step, Monitor& monitor) {
  if (const auto* request = std::get_if<PressRequest>(&step)) return press(*request, monitor);
  if (std::holds_alternative<Protocol::Release>(step)) release();
  if (const auto* placed = std::get_if<Protocol::Place>(&step)) place(placed->seed);
  if (const auto* turn = std::get_if<Protocol::Rotate>(&step)) rotate(turn->angle);
  if (const auto* moved = std::get_if<Protocol::Shift>(&step)) shift(moved->x, moved->y);
  return {};
}

void SpecimenPair::check_ahead(const Protocol::Step& step, Pose& lying) const {
  if (const auto* place = std::get_if<Protocol::Place>(&step))
    lying = draw_placement(scene_.lower.grid(), scene_.boundary, place->seed);
  if (const auto* turn = std::get_if<Protocol::Rotate>(&step)) lying = turned(lying, turn->angle);
  if (const auto* moved = std::get_if<Protocol::Shift>(&step)) lying = shifted(lying, moved->x, moved->y);
  const auto* press = std::get_if<PressRequest>(&step);
  if (press == nullptr) return;
  check(*press, plan_.attracts());
  if (!press->by_load() || !plan_.yield || !plan_.yield->limits() || plan_.yield->hardens()) return;
  const double pressure =
      press->by == PressBy::load ? press->value / scene_.lower.grid().area() : press->value;
  const double hardness = plan_.yield->softened(press->dwell) * plan_.yield->hardness();
  if (pressure >= hardness)
    refuse_infeasible("a mean pressure of " + format_quantity(pressure, dimension::pressure) +
                          " cannot be carried: `hardness` is " +
                          format_quantity(hardness, dimension::pressure) +
                          (hardness < plan_.yield->hardness() ? " after that dwell" : ""),
                      "press with less than the hardness, or give `hardening`");
}

Surface SpecimenPair::upper() const {
  if (const auto* rough = std::get_if<Surface>(&scene_.upper)) return *rough;
  const Grid& grid = scene_.lower.grid();
  SurfaceTraits traits;
  traits.material = std::get<Material>(scene_.upper);
  traits.periodic = true;
  return Surface(grid, Field(grid.nx, grid.ny), std::move(traits));
}

void SpecimenPair::close() {
  for (const State::Watch& state : states_) State::close(state);
  states_.clear();
  closed_ = true;
}

SpecimenPair SpecimenPair::copy() const {
  SpecimenPair result = *this;
  result.states_.clear();
  result.closed_ = false;
  return result;
}

ProtocolRun::ProtocolRun(Protocol protocol, std::shared_ptr<SpecimenPair> pair)
    : protocol_(std::move(protocol)),
      pair_(std::move(pair)),
      presses_(protocol_.presses()),
      begun_(std::chrono::steady_clock::now()) {
  Pose lying = pair_->pose();
  for (std::size_t k = 0; k < protocol_.count(); ++k)
    with_title(k, [&] { pair_->check_ahead(protocol_.events()[k].step, lying); });
}

std::string ProtocolRun::title(std::size_t k) const {
  return "event " + std::to_string(k + 1) + " of " + std::to_string(protocol_.count()) + ": " +
         text(protocol_.events()[k].step);
}

template <class Work>
void ProtocolRun::with_title(std::size_t k, const Work& work) const {
  try {
    work();
  } catch (const Error& error) {
    const std::string& origin = protocol_.events()[k].origin;
    throw Error(error.code(),
                title(k) + (origin.empty() ? "" : " (" + origin + ")") + ": " + error.sentence(),
                error.hint());
  }
}

std::optional<State> ProtocolRun::step(Monitor& monitor) {
  const Protocol::Event& event = protocol_.events()[next_];
  std::optional<State> state;
  with_title(next_, [&] {
    stop_flag().check();
    const bool press = std::holds_alternative<PressRequest>(event.step);
    const double all = presses_ == 0 ? 1 : static_cast<double>(presses_);
    const double before = static_cast<double>(pressed_) / all;
    const double after = static_cast<double>(pressed_ + (press ? 1 : 0)) / all;
    PartMonitor part(monitor, "protocol", title(next_), before, after, begun_);
    part.begin();
    const std::size_t done = pair_->history().size();
    state = pair_->perform(event.step, part);
    pair_->date(done, event.time);
    if (press) ++pressed_;
    ++next_;
  });
  return state;
}

}  // namespace asperity
