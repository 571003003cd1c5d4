// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/specimen_pair.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/experiment/placement.hpp"

namespace asperity {

namespace {

const Scene& checked(const Scene& scene) {
  check(scene);
  return scene;
}

int whole_cells(double length, double cell, std::string_view key) {
  const double cells = length / cell;
  const double whole = std::round(cells);
  constexpr double most = 1e9;
  if (!(std::abs(cells) <= most))
    throw Error(ErrorCode::bad_value,
                "`shift` along " + std::string(key) + " is " + format_short(length) + " m",
                "give a finite length of a whole number of cells");
  if (std::abs(cells - whole) > 1e-9 * std::max(1.0, std::abs(whole)))
    throw Error(ErrorCode::bad_value,
                "`shift` along " + std::string(key) + " is " + format_short(cells, 10) + " cells",
                "surfaces are never resampled in place: give a whole number of cells of " +
                    format_quantity(cell, dimension::length, 10));
  return static_cast<int>(whole);
}

}  // namespace

SpecimenPair::SpecimenPair(const Scene& scene)
    : scene_(checked(scene)),
      geometry_(std::make_shared<const ContactGeometry>(
          scene_, LatticeIsometry(scene_.lower.grid().nx, scene_.lower.grid().ny))),
      plan_(make_plan(scene_, *geometry_)) {}

std::shared_ptr<const Solver> SpecimenPair::solver() {
  if (!solver_) solver_ = make_solver(plan_, geometry_);
  return solver_;
}

State SpecimenPair::press(const PressRequest& request, Monitor& monitor) {
  check(request);
  warn_of_a_step_at_the_rim(monitor);
  if (request.dwell && !scene_.creep && !std::exchange(warned_of_dwell_, true))
    monitor.warn(
        "`dwell` does nothing without creep: this scene does not name the effect `creep`, so no press "
        "depends "
        "on how long it lasts");
  const bool first = solver_ == nullptr;
  const std::shared_ptr<const Solver> ready = solver();
  State state = ready->press(request, monitor);
  if (first) state = state.costing_also(ready->preparation());
  if (plan_.yield) state = state.costing_also(flatten_for_good(state, monitor));
  under_load_ = state.load() > 0;
  return state;
}

StateCost SpecimenPair::flatten_for_good(const State& state, Monitor& monitor) {
  const CostScope scope;
  if (const std::optional<PlasticChange> change = state.plastic_change()) {
    YieldedBodies after = yielded_bodies(*geometry_, *plan_.yield, *change);
    Scene scene = scene_;
    scene.lower = std::move(after.lower);
    scene.upper = std::move(after.upper);
    auto geometry =
        std::make_shared<const ContactGeometry>(scene, *geometry_, after.hardness, change->approach);
    Plan plan = make_plan(scene, *geometry);
    constexpr double noticeable = 0.05;
    if (std::abs(after.mapped_volume - 1) > noticeable && !std::exchange(warned_of_mapping_, true))
      monitor.warn("at this angle the nodes of the bodies map " + format_short(100 * after.mapped_volume, 3) +
                   " % of the volume that yielded onto the upper body; it was scaled to all of it, so "
                   "finer cells would tell more");
    // Nothing throws from here on.
    std::swap(scene_, scene);
    std::swap(plan_, plan);
    hardness_ = std::move(after.hardness);
    geometry_ = std::move(geometry);
    solver_.reset();
  }
  const Cost cost = scope.so_far();
  return {cost, {{"plasticity", cost}}};
}

void SpecimenPair::warn_of_a_step_at_the_rim(Monitor& monitor) {
  if (warned_of_rim_ || scene_.boundary != Boundary::periodic ||
      !std::holds_alternative<HalfSpaceOptions>(scene_.elasticity))
    return;
  std::vector<std::string> bodies;
  if (!scene_.lower.traits().periodic) bodies.emplace_back("lower");
  if (const auto* rough = std::get_if<Surface>(&scene_.upper); rough && !rough->traits().periodic)
    bodies.emplace_back("upper");
  if (bodies.empty()) return;
  warned_of_rim_ = true;
  monitor.warn("the " + joined(bodies, " and the ") + (bodies.size() > 1 ? " bodies do" : " body does") +
               " not continue across the rim of the tile, so on a periodic half-space the step there "
               "presses too; boundary=\"free\" has none");
}

void SpecimenPair::release() { under_load_ = false; }

void SpecimenPair::lay(const Pose& pose) {
  if (pose == geometry_->pose()) {
    under_load_ = false;
    return;
  }
  auto geometry = std::make_shared<const ContactGeometry>(scene_, pose, hardness_);
  Plan plan = make_plan(scene_, *geometry);
  // Under a rigid flat every placement is the same contact, and what was prepared for it stays good.
  const Material* flat = std::get_if<Material>(&scene_.upper);
  if (flat == nullptr || !flat->rigid) solver_.reset();
  hardness_ = geometry->hardness();
  geometry_ = std::move(geometry);
  plan_ = std::move(plan);
  under_load_ = false;
}

void SpecimenPair::place(std::uint64_t seed) {
  lay(draw_placement(scene_.lower.grid(), scene_.boundary, seed));
}

void SpecimenPair::rotate(double angle) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  const double quarters = angle / quarter;
  const std::string asked =
      "a turn by " + format_short(angle * 180 / std::numbers::pi, 10) + " deg was asked";
  if (!(std::abs(quarters) < 1e6)) throw Error(ErrorCode::bad_value, asked, "give a finite angle");
  const Grid& grid = scene_.lower.grid();
  const Pose turned = pose().turned(angle, grid);
  if (scene_.boundary == Boundary::periodic && !turned.on_lattice()) {
    const double whole = std::round(turned.angle() / quarter);
    if (std::abs(turned.angle() - whole * quarter) <= 1e-9)
      throw Error(ErrorCode::bad_value, asked + " of a tile that is not square",
                  "it can be turned by 180 deg");
    throw Error(ErrorCode::bad_value, asked + "; a periodic contact turns by whole multiples of 90 deg only",
                "put the body down afresh with `place{seed=}`, or give boundary=\"free\": surfaces are never "
                "resampled in place");
  }
  lay(turned);
}

void SpecimenPair::shift(double x, double y) {
  if (scene_.boundary != Boundary::periodic)
    throw Error(ErrorCode::bad_value,
                "`shift` was asked on a free boundary, where a shifted body overhangs the rim",
                "use `boundary` = \"periodic\"");
  const Grid& grid = scene_.lower.grid();
  lay(placement().shifted(whole_cells(x, grid.hx(), "x"), whole_cells(y, grid.hy(), "y")));
}

Surface SpecimenPair::upper() const {
  if (const auto* rough = std::get_if<Surface>(&scene_.upper)) return *rough;
  const Grid& grid = scene_.lower.grid();
  SurfaceTraits traits;
  traits.material = std::get<Material>(scene_.upper);
  traits.periodic = true;
  return Surface(grid, Field(grid.nx, grid.ny), std::move(traits));
}

}  // namespace asperity
