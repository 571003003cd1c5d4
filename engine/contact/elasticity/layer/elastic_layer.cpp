// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/layer/elastic_layer.hpp"

#include <string>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/half_space/preconditioner/half_order_pyramid.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// From this y on the share is 1 to rounding: the difference is y² exp(−y).
constexpr double deep = 60;

// sinh y − y for y <= 1 by its power series; the next term is below 1e-17 of the first.
double sinh_less_argument(double y) {
  const double z = y * y;
  double sum = 1;
  for (int k = 8; k >= 1; --k) sum = 1 + z / ((2 * k + 2) * (2 * k + 3)) * sum;
  return y * z / 6 * sum;
}

// Numerator and denominator times 2 exp(−y), y = 2x: no term overflows. Only the numerator has terms of
// unlike sign, which cancel for long waves on a nearly incompressible layer; (a − 1) sinh y + (sinh y − y)
// avoids this.
double bonded_share(double y, double poisson) {
  const double more = 2 * (1 - 2 * poisson), a = 1 + more;
  const double fall = elementary::exp(-y), missing = -elementary::expm1(-2 * y);  // 1 − exp(−2y)
  const double denominator = a * (1 + fall * fall) + (y * y + 1 + a * a) * fall;
  const double numerator =
      y < 1 ? more * missing + 2 * fall * sinh_less_argument(y) : a * missing - 2 * y * fall;
  return numerator / denominator;
}

// 2 sinh² x/(sinh 2x + 2x), both parts times 2 exp(−2x): all terms are positive.
double frictionless_share(double x) {
  const double missing = -elementary::expm1(-2 * x);
  return missing * (missing / (-elementary::expm1(-4 * x) + 4 * x * elementary::exp(-2 * x)));
}

}  // namespace

double layer_share(double x, double poisson, LayerBase base) {
  if (!(x > 0)) return 0;
  if (2 * x > deep) return 1;
  return base == LayerBase::bonded ? bonded_share(2 * x, poisson) : frictionless_share(x);
}

double uniform_share(double poisson) { return (1 - 2 * poisson) / ((1 - poisson) * (1 - poisson)); }

WaveShare wave_share(const ElasticLayer& layer) {
  return {[poisson = layer.poisson, base = layer.base](double x) { return layer_share(x, poisson, base); },
          layer.thickness,
          uniform_share(layer.poisson),
          {layer.poisson, static_cast<double>(layer.base)}};
}

namespace {

std::string material_found(const Material* material) {
  if (material == nullptr) return "has no material";
  if (material->rigid) return "is rigid";
  return material->name.empty() ? std::string("is elastic") : "is of " + quoted(material->name);
}

std::string sinking_under_pressure(double metres_per_pascal) {
  return format_quantity(metres_per_pascal * 1e6, dimension::length) + " a MPa";
}

// Throws Error{bad_value} unless the boundary is periodic, the lower body elastic, the upper body rigid.
void check_layer(const std::any&, const Scene& scene) {
  if (scene.boundary != Boundary::periodic)
    refuse("`boundary` is \"free\" on a layer, which is not computed by this version",
           "give boundary=\"periodic\", on a tile several times as wide as contact and layer, or name "
           "elasticity=\"half_space\"");
  const Material* const lower = lower_material(scene.lower);
  if (lower != nullptr && lower->rigid)
    refuse("the lower body is rigid, and is the layer that gives way",
           "give the lower body the material of the layer, and lay it below");
  const Material* const upper = upper_material(scene.upper);
  if (upper == nullptr || !upper->rigid)
    refuse(
        "the upper body " + material_found(upper) + ", and what presses on a layer is rigid in this version",
        "press with lab.rigid, or give the upper surface material=lab.rigid");
}

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
  // A thin layer coarsens the grid of the preconditioner little or not at all.
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
                      "of the layer, the lower body; of model=\"layer\", which needs it. Approach and energy "
                      "hold its uniform compression, K(0) = t (1+nu)(1-2nu)/(E (1-nu)) per mean pressure")
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
