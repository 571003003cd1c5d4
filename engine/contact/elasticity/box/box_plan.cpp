// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/box_plan.hpp"

#include <algorithm>
#include <cmath>

#include "engine/contact/elasticity/box/box_solver.hpp"
#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/elasticity/box/yielding_elements.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/require.hpp"

namespace asperity {

BoxOperator::BoxOperator(const ElasticModel& of, double stiffness, double reference)
    : ElasticOperator(of), reference_pressure(reference) {
  modulus = stiffness;
}

Field BoxOperator::apply(const Field& pressure, const Grid&, Boundary) const {
  Field u = pressure;
  for (double& value : u.values()) value /= modulus;
  return u;
}

Field BoxOperator::inverse(const Field& displacement, const Grid&) const {
  Field p = displacement;
  for (double& value : p.values()) value *= modulus;
  return p;
}

void BoxOperator::plan(const ContactGeometry& geometry, Plan& plan) const {
  const auto nodes = static_cast<std::size_t>(geometry.facing());
  constexpr double seconds_per_node = 4e-8;  // of sorting, on one core
  plan.solver = "closed form (sorted heights)";
  plan.buffers.push_back({"sorted heights and their sums", SortedDrops::bytes(nodes)});
  plan.buffers.push_back(
      {"while sorting",
       SortedDrops::bytes_while_sorting(nodes) - static_cast<std::int64_t>(nodes * sizeof(double)), false});
  plan.seconds = std::max(1e-6, seconds_per_node * static_cast<double>(nodes));
}

// Throws Error{bad_state} for rigid bodies without yield: nothing would carry a load.
void BoxOperator::plan_after_effects(const ContactGeometry& geometry, Plan& plan) const {
  if (!plan.yield || !plan.yield->limits()) {
    if (!std::isfinite(modulus))
      refuse_state("rigid bodies carry a load only where they yield, and their `hardness` is infinite",
                   "give a finite `hardness`, or name another elasticity");
    return;
  }
  const std::size_t nodes = geometry.grid().nodes();
  plan.solver = "closed form (sorted elements)";
  plan.buffers.push_back(
      {"sums over the elements in the order in which they yield", YieldingElements::bytes(nodes)});
  const auto fields = [&](int count) { return static_cast<std::int64_t>(count * nodes * sizeof(double)); };
  if (plan.yield->hardens())
    plan.buffers.push_back({"elements of bodies that have hardened, in order", fields(3)});
  else  // yielding reuses the room of sorting
    plan.buffers.push_back({"bodies as they have yielded", fields(geometry.upper_is_flat() ? 1 : 2), false});
}

std::shared_ptr<const Solver> BoxOperator::solver(const Plan& plan,
                                                  std::shared_ptr<const ContactGeometry> geometry) const {
  if (plan.yield && plan.yield->limits())
    return std::make_shared<const YieldingBoxSolver>(plan, std::move(geometry));
  return std::make_shared<const BoxSolver>(plan, reference_pressure, std::move(geometry));
}

namespace {

std::shared_ptr<const ElasticOperator> make_box(const std::any& given, const ContactGeometry& geometry) {
  const auto& options = std::any_cast<const BoxOptions&>(given);
  const double height = geometry.peak_to_valley();
  double stiffness = 0, reference = 0;
  std::string origin;
  if (options.stiffness) {
    stiffness = *options.stiffness;
    origin = "as given";
    // With equal heights a cell is the only length.
    const Grid& grid = geometry.grid();
    reference = stiffness * (height > 0 ? height : std::min(grid.hx(), grid.hy()));
  } else {
    reference = contact_modulus(geometry, "box elements need `young` and `poisson`", "to set their stiffness",
                                "`stiffness` to the box elements");
    if (!(height > 0))
      refuse("all combined heights are equal, so E*/peak-to-valley gives box elements no stiffness",
             "give `stiffness` in Pa/m");
    stiffness = reference / height;
    origin = "E*/peak-to-valley, " + format_quantity(reference, dimension::pressure) + " / " + metres(height);
  }
  if (!std::isfinite(stiffness) || !std::isfinite(reference) || !(stiffness > 0))
    refuse("the stiffness of the box elements comes to " + format_short(stiffness) + " Pa/m",
           "check the units of the heights and of `young`, or give `stiffness`");
  auto box = std::make_shared<BoxOperator>(BoxOptions::model(), stiffness, reference);
  box->lower_share = lower_elastic_share(geometry);
  box->sentence =
      "box elements, stiffness " + format_quantity(stiffness, dimension::stiffness) + " (" + origin + ")";
  return box;
}

std::shared_ptr<const ElasticOperator> make_rigid(const std::any&, const ContactGeometry&) {
  auto box =
      std::make_shared<BoxOperator>(RigidOptions::model(), std::numeric_limits<double>::infinity(), 0.0);
  box->sentence = "rigid bodies, which rest on what has yielded";
  return box;
}

void check_rigid(const std::any&, const Scene& scene) {
  if (scene.effects.any_that(Effect::Acts::bounds_pressure)) return;
  const std::string wanted = effects_that(Effect::Acts::bounds_pressure);
  refuse("rigid bodies carry a load only where they yield, and this scene does not name " + wanted,
         "name " + wanted + " as well, or give another elasticity");
}

}  // namespace

const ElasticModel& BoxOptions::model() {
  using O = BoxOptions;
  static const ElasticModel record{
      .name = "box",
      .noun = "box elements",
      .called = "box elements",
      .sentence =
          "a Winkler foundation: independent elements over the nodes, pressure in proportion to their "
          "shortening",
      .is_local = true,
      .defaults = O{},
      .options = {quantity_row("stiffness", &O::stiffness, dimension::stiffness, above(0),
                               "pressure per shortening of a box element; of model=\"box\" alone")
                      .defaults_to("E*/peak-to-valley")},
      .make = make_box};
  return record;
}

const ElasticModel& RigidOptions::model() {
  static const ElasticModel record{.name = "rigid",
                                   .noun = "rigid bodies",
                                   .called = "rigid bodies",
                                   .sentence = "no elastic deformation, the bodies rest on what has yielded",
                                   .is_local = true,
                                   .defaults = RigidOptions{},
                                   .options = {},
                                   .check = check_rigid,
                                   .make = make_rigid};
  return record;
}

}  // namespace asperity
