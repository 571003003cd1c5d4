// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/layer/layer_plan.hpp"

#include <cmath>
#include <string>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
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

void refuse_on_layer(const std::string& effect) {
  throw Error(ErrorCode::bad_value, quoted(effect) + " is not computed on a layer by this version",
              "name elasticity=\"half_space\" beside it, or leave it out");
}

std::string sinking_under_pressure(double metres_per_pascal) {
  return format_quantity(metres_per_pascal * 1e6, dimension::length) + " a MPa";
}

}  // namespace

void check_layer(const LayerOptions& options, const Scene& scene) {
  if (!(options.thickness > 0) || !std::isfinite(options.thickness))
    throw Error(ErrorCode::bad_value, "`thickness` of the layer is " + format_short(options.thickness) + " m",
                "give a finite length above zero, such as \"50 um\"");
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
  if (scene.capillarity && scene.capillarity->pressure.value_or(1) > 0 &&
      scene.capillarity->humidity.value_or(1) > 0)
    refuse_on_layer("capillarity");
  if (scene.adhesion && scene.adhesion->work > 0) refuse_on_layer("adhesion");
  if (scene.sliding.tangential) refuse_on_layer("tangential");
}

void plan_layer(const LayerOptions& options, const ContactGeometry& geometry, Plan& plan) {
  plan_half_space(geometry, plan);
  auto& half_space = std::get<HalfSpaceOperator>(plan.elasticity);
  const double poisson = *lower_material(geometry.lower())->poisson;
  half_space.layer = ElasticLayer{options.thickness, poisson, options.base};
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
      preconditioner(in_cells(*half_space.layer, grid.hx(), false)) - preconditioner({});
  if (more > 0) plan.buffers.push_back({"waves that feel the base", more, false});
}

}  // namespace asperity
