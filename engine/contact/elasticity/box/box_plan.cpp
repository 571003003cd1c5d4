// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/box_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/elastic_bodies.hpp"
#include "engine/contact/elasticity/box/box_solver.hpp"
#include "engine/contact/elasticity/box/sorted_drops.hpp"
#include "engine/contact/elasticity/box/yielding_elements.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

void plan_sorting(const BoxOperator& box, const ContactGeometry& geometry, Plan& plan) {
  const auto nodes = static_cast<std::size_t>(geometry.facing());
  constexpr double seconds_per_node = 4e-8;  // of sorting, measured on one core
  plan.elasticity = box;
  plan.solver = "closed form (sorted heights)";
  plan.buffers.push_back({"sorted heights and their sums", SortedDrops::bytes(nodes)});
  plan.buffers.push_back(
      {"while sorting",
       SortedDrops::bytes_while_sorting(nodes) - static_cast<std::int64_t>(nodes * sizeof(double)), false});
  plan.seconds = std::max(1e-6, seconds_per_node * static_cast<double>(nodes));
}

void plan_box(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  const auto& options = std::any_cast<const BoxOptions&>(given);
  const double height = geometry.peak_to_valley();
  BoxOperator box;
  std::string origin;
  if (options.stiffness) {
    box.stiffness = *options.stiffness;
    origin = "as given";
    // With equal heights a cell is the only length.
    const Grid& grid = geometry.grid();
    box.reference_pressure = box.stiffness * (height > 0 ? height : std::min(grid.hx(), grid.hy()));
  } else {
    const double modulus = contact_modulus(geometry, "box elements need `young` and `poisson`",
                                           "to set their stiffness", "`stiffness` to the box elements");
    if (!(height > 0))
      refuse("all combined heights are equal, so E*/peak-to-valley gives box elements no stiffness",
             "give `stiffness` in Pa/m");
    box.stiffness = modulus / height;
    box.reference_pressure = modulus;
    origin = "E*/peak-to-valley, " + format_quantity(modulus, dimension::pressure) + " / " + metres(height);
  }
  if (!std::isfinite(box.stiffness) || !std::isfinite(box.reference_pressure) || !(box.stiffness > 0))
    refuse("the stiffness of the box elements comes to " + format_short(box.stiffness) + " Pa/m",
           "check the units of the heights and of `young`, or give `stiffness`");
  box.lower_share = lower_elastic_share(geometry);
  plan.terms.push_back({"elasticity", "box elements, stiffness " +
                                          format_quantity(box.stiffness, dimension::stiffness) + " (" +
                                          origin + ")"});
  plan_sorting(box, geometry, plan);
}

void plan_rigid(const std::any&, const ContactGeometry& geometry, Plan& plan) {
  BoxOperator box;
  box.stiffness = std::numeric_limits<double>::infinity();
  plan.terms.push_back({"elasticity", "rigid bodies, which rest on what has yielded"});
  plan_sorting(box, geometry, plan);
}

// Throws Error{bad_state} for rigid bodies that cannot yield: nothing would carry a load.
void plan_yield_of_boxes(const ContactGeometry& geometry, Plan& plan) {
  const auto& box = std::get<BoxOperator>(plan.elasticity);
  if (!plan.yield || !plan.yield->limits()) {
    if (!std::isfinite(box.stiffness))
      throw Error(ErrorCode::bad_state,
                  "rigid bodies carry a load only where they yield, and their `hardness` is infinite",
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

void check_rigid(const std::any&, const Scene& scene) {
  if (scene.effects.any_that(Effect::Acts::bounds_pressure)) return;
  const std::string wanted = effects_that(Effect::Acts::bounds_pressure);
  refuse("rigid bodies carry a load only where they yield, and this scene does not name " + wanted,
         "name " + wanted + " beside elasticity=\"rigid\", or name another elasticity");
}

std::any stiffness_as_planned(const std::any&, const Plan& before) {
  return BoxOptions{std::get<BoxOperator>(before.elasticity).stiffness};
}

std::shared_ptr<const Solver> box_solver(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry) {
  const auto& box = std::get<BoxOperator>(plan.elasticity);
  if (plan.yield && plan.yield->limits())
    return std::make_shared<const YieldingBoxSolver>(plan, box, std::move(geometry));
  return std::make_shared<const BoxSolver>(plan, box, std::move(geometry));
}

}  // namespace

const ElasticModel& box_model() {
  using O = BoxOptions;
  static const ElasticModel record{
      .name = "box",
      .noun = "box elements",
      .called = "box elements",
      .sentence =
          "a Winkler foundation: independent elements over the nodes, pressure in proportion to their "
          "shortening",
      .defaults = O{},
      .options = {quantity_row("stiffness", &O::stiffness, dimension::stiffness, above(0),
                               "pressure per shortening of a box element; of model=\"box\" alone")
                      .defaults_to("E*/peak-to-valley")},
      .plan = plan_box,
      .finish = plan_yield_of_boxes,
      .as_planned = stiffness_as_planned,
      .solver = box_solver};
  return record;
}
const ElasticModel& BoxOptions::model() { return box_model(); }

const ElasticModel& rigid_model() {
  static const ElasticModel record{.name = "rigid",
                                   .noun = "rigid bodies",
                                   .called = "rigid bodies",
                                   .sentence = "no elastic deformation, the bodies rest on what has yielded",
                                   .defaults = RigidOptions{},
                                   .options = {},
                                   .check = check_rigid,
                                   .plan = plan_rigid,
                                   .finish = plan_yield_of_boxes,
                                   .solver = box_solver};
  return record;
}
const ElasticModel& RigidOptions::model() { return rigid_model(); }

}  // namespace asperity
