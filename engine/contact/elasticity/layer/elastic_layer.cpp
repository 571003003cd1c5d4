// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/layer/elastic_layer.hpp"

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

// From here on the share is 1 to rounding: the difference is y² exp(−y).
constexpr double deep = 60;

// Power series for y <= 1; the next term is below 1e-17 of the first.
double sinh_less_argument(double y) {
  const double z = y * y;
  double sum = 1;
  for (int k = 8; k >= 1; --k) sum = 1 + z / ((2 * k + 2) * (2 * k + 3)) * sum;
  return y * z / 6 * sum;
}

// Both parts times 2 exp(−y), y = 2x: no term overflows. On a nearly incompressible layer terms of the
// numerator cancel for long waves; (a − 1) sinh y + (sinh y − y) avoids this.
double bonded_share(double y, double poisson) {
  const double more = 2 * (1 - 2 * poisson), a = 1 + more;
  const double fall = elementary::exp(-y), missing = -elementary::expm1(-2 * y);  // 1 − exp(−2y)
  const double denominator = a * (1 + fall * fall) + (y * y + 1 + a * a) * fall;
  const double numerator =
      y < 1 ? more * missing + 2 * fall * sinh_less_argument(y) : a * missing - 2 * y * fall;
  return numerator / denominator;
}

// 2 sinh² x/(sinh 2x + 2x), both parts times 2 exp(−2x): no cancellation.
double frictionless_share(double x) {
  const double missing = -elementary::expm1(-2 * x);
  return missing * (missing / (-elementary::expm1(-4 * x) + 4 * x * elementary::exp(-2 * x)));
}

std::string material_found(const Material* material) {
  if (material == nullptr) return "has no material";
  if (material->rigid) return "is rigid";
  return material->name.empty() ? std::string("is elastic") : "is of " + quoted(material->name);
}

// Throws Error{bad_value} unless the boundary is periodic, the lower body elastic, the upper rigid.
void check_layer(const std::any&, const Scene& scene) {
  if (scene.boundary != Boundary::periodic)
    refuse("`boundary` is \"free\", and a layer is computed on a periodic tile only",
           "give boundary=\"periodic\", on a tile several times as wide as contact and layer, or name "
           "elasticity=\"half_space\"");
  const Material* const lower = lower_material(scene.lower);
  if (lower != nullptr && lower->rigid)
    refuse("the lower body is rigid, and it is the elastic layer",
           "give the lower body the elastic material of the layer");
  const Material* const upper = upper_material(scene.upper);
  if (upper == nullptr || !upper->rigid)
    refuse("the upper body " + material_found(upper) + ", and only a rigid body can press on a layer",
           "press with lab.rigid, or give the upper surface material=lab.rigid");
}

std::shared_ptr<const ElasticOperator> make_layer(const std::any& given, const ContactGeometry& geometry) {
  const auto& options = std::any_cast<const LayerOptions&>(given);
  auto layer = std::make_shared<HalfSpaceOperator>(LayerOptions::model(), geometry);
  const double poisson = *lower_material(geometry.lower())->poisson;
  layer->share = wave_share({options.thickness, poisson, options.base});
  const double uniform = options.thickness * uniform_share(poisson) / layer->modulus;
  const bool bonded = options.base == LayerBase::bonded;
  layer->sentence = "layer of " + format_quantity(options.thickness, dimension::length) +
                    (bonded ? ", bonded to a rigid base" : " on a frictionless rigid base") + ", E* " +
                    format_quantity(layer->modulus, dimension::pressure) +
                    ", Fourier multiplier: a share of 2/(E*|q|); a uniform pressure compresses it by " +
                    (uniform > 0 ? metres(uniform * 1e6) + " a MPa" : "nothing, for its volume stays");
  return layer;
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

const ElasticModel& LayerOptions::model() {
  using O = LayerOptions;
  static const ElasticModel record{
      .name = "layer",
      .noun = "a layer",
      .called = "layer",
      .sentence = "an elastic layer on a rigid base, the lower body, under a rigid one",
      .defaults = O{},
      .options = {quantity_row(
                      "thickness", &O::thickness, dimension::length, above(0),
                      "of the layer, the lower body; of model=\"layer\", which needs it. Approach and energy "
                      "hold its uniform compression, K(0) = t (1+nu)(1-2nu)/(E (1-nu)) per mean pressure")
                      .needed(),
                  choice_row("base", &O::base,
                             {{"bonded", LayerBase::bonded}, {"frictionless", LayerBase::frictionless}},
                             "bond of the layer to its rigid base; of model=\"layer\" alone")},
      .boundary = "a layer needs boundary=\"periodic\": the tile goes on beyond its rim",
      .periodic_only = true,
      .shear = false,
      .check = check_layer,
      .make = make_layer};
  return record;
}

}  // namespace asperity
