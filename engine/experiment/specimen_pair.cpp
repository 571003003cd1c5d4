// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/specimen_pair.hpp"

#include <cmath>
#include <numbers>
#include <utility>

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
  const bool first = solver_ == nullptr;
  State state = solver()->press(request, monitor);
  if (first) state = state.costing_also(solver_->preparation());
  under_load_ = state.load() > 0;
  return state;
}

void SpecimenPair::release() { under_load_ = false; }

void SpecimenPair::lay(const LatticeIsometry& placement) {
  if (placement == geometry_->placement()) {
    under_load_ = false;
    return;
  }
  auto geometry = std::make_shared<const ContactGeometry>(scene_, placement);
  Plan plan = make_plan(scene_, *geometry);
  // Under a rigid flat every placement is the same contact, and what was prepared for it stays good.
  const Material* flat = std::get_if<Material>(&scene_.upper);
  if (flat == nullptr || !flat->rigid) solver_.reset();
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
  const double whole = std::round(quarters);
  if (std::abs(angle - whole * quarter) > 1e-9)
    throw Error(ErrorCode::bad_value, asked + "; this contact turns by whole multiples of 90 deg only",
                "put the body down afresh with `place{seed=}`: surfaces are never resampled in place");
  const Grid& grid = scene_.lower.grid();
  const auto turns = static_cast<int>(whole);
  if (turns % 2 != 0 && (grid.nx != grid.ny || grid.size_x != grid.size_y))
    throw Error(ErrorCode::bad_value, asked + " of a tile that is not square", "it can be turned by 180 deg");
  lay(placement().turned(turns));
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
