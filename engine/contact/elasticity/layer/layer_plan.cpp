// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/layer/layer_plan.hpp"

#include <cmath>
#include <string>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string material_found(const Material* material) {
  if (material == nullptr) return "has no material";
  if (material->rigid) return "is rigid";
  return material->name.empty() ? std::string("is elastic") : "is of " + quoted(material->name);
}

std::string sinking_under_pressure(double metres_per_pascal) {
  return format_quantity(metres_per_pascal * 1e6, dimension::length) + " a MPa";
}

// Throws Error{bad_value} for a boundary that is not periodic, and for a lower body that is rigid or an upper
// one that is not.
void check_layer(const std::any&, const Scene& scene) {
  if (scene.boundary != Boundary::periodic)
    throw Error(ErrorCode::bad_value,
                "`boundary` is \"free\" on a layer, which is not computed by this version",
                "give boundary=\"periodic\", on a tile several times as wide as contact and layer, or name "
                "elasticity=\"half_space\"");
  const Material* const lower = lower_material(scene.lower);
  if (lower != nullptr && lower->rigid)
    throw Error(ErrorCode::bad_value, "the lower body is rigid, and is the layer that gives way",
                "give the lower body the material of the layer, and lay it below");
  const Material* const upper = upper_material(scene.upper);
  if (upper == nullptr || !upper->rigid)
    throw Error(ErrorCode::bad_value,
                "the upper body " + material_found(upper) +
                    ", and what presses on a layer is rigid in this "
                    "version",
                "press with lab.rigid, or give the upper surface material=lab.rigid");
}

// As plan_half_space, with the layer in the operator and in the sentence.
void plan_layer(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  const auto& options = std::any_cast<const LayerOptions&>(given);
  plan_half_space(geometry, plan);
  auto& half_space = std::get<HalfSpaceOperator>(plan.elasticity);
  const double poisson = *lower_material(geometry.lower())->poisson;
  half_space.share = wave_share({options.thickness, poisson, options.base});
  const double uniform = options.thickness * uniform_share(poisson) / half_space.modulus;
  const bool bonded = options.base == LayerBase::bonded;
  plan.terms.back().sentence =
      "layer of " + format_quantity(options.thickness, dimension::length) +
      (bonded ? ", bonded to a rigid base" : " on a frictionless rigid base") + ", E* " +
      format_quantity(half_space.modulus, dimension::pressure) +
      ", Fourier multiplier: a share of 2/(E*|q|); a uniform pressure compresses it by " +
      (uniform > 0 ? sinking_under_pressure(uniform) : "nothing, for its volume stays");
  // On a thin layer the preconditioner is a transform of the grid as it is, or of one not much coarser.
  const Grid& grid = geometry.grid();
  const double aspect = grid.hy() / grid.hx();
  const auto preconditioner = [&](const ComplianceMultiplier& multiplier) {
    return HalfOrderPyramid::bytes(grid.nx, grid.ny, aspect, Boundary::periodic, multiplier);
  };
  const std::int64_t more =
      preconditioner(in_cells(*half_space.share, grid.hx(), false)) - preconditioner({});
  if (more > 0) plan.buffers.push_back({"waves that feel the base", more, false});
}

}  // namespace

const ElasticModel& layer_model() {
  using O = LayerOptions;
  static const ElasticModel record{
      .name = "layer",
      .noun = "a layer",
      .called = "layer",
      .sentence = "an elastic layer on a rigid base, the lower body, under a rigid one",
      .moves_every_node = true,
      .defaults = O{},
      .options = {quantity_row(
                      "thickness", &O::thickness, dimension::length, above(0),
                      "of the layer, the lower body; of model=\"layer\", which needs it. Approach and "
                      "energy hold its uniform compression, K(0) = t (1+nu)(1-2nu)/(E (1-nu)) per mean "
                      "pressure")
                      .needed(),
                  choice_row("base", &O::base,
                             {{"bonded", LayerBase::bonded}, {"frictionless", LayerBase::frictionless}},
                             "how the layer lies on its rigid base; of model=\"layer\" alone")},
      .boundary = "a layer needs boundary=\"periodic\": the tile goes on beyond its rim",
      .periodic_only = true,
      .check = check_layer,
      .plan = plan_layer,
      .solver = half_space_solver};
  return record;
}
const ElasticModel& LayerOptions::model() { return layer_model(); }

}  // namespace asperity
