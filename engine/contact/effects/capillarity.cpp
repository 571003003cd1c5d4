// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/capillarity.hpp"

#include <cmath>
#include <numbers>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

Meniscus meniscus(const CapillarityOptions& options) {
  constexpr double gas_constant = 8.31446261815324;  // J/(mol K)
  const double tension = options.surface_tension;
  double pressure = 0;
  if (options.pressure)
    pressure = *options.pressure;
  else if (*options.humidity > 0)  // dry air has no meniscus
    pressure =
        gas_constant * options.temperature * -elementary::log(*options.humidity) / options.molar_volume;
  if (!(pressure > 0)) return {};
  return {pressure, 2 * tension / pressure * elementary::cos(options.contact_angle)};
}

namespace {

void check_capillarity(const std::any& given, const Scene& scene) {
  const auto& options = std::any_cast<const CapillarityOptions&>(given);
  if (options.pressure.has_value() == options.humidity.has_value())
    refuse(std::string("`capillarity` names ") +
               (options.pressure ? "both `pressure` and `humidity`" : "neither `pressure` nor `humidity`"),
           "give the one that is known: the humidity sets the pressure");
  if (!(options.contact_angle < std::numbers::pi / 2))
    refuse("`contact_angle` is " + format_short(options.contact_angle * 180 / std::numbers::pi) + " deg",
           "give an angle from 0 to below 90 deg: a liquid that does not wet does not attract");
  if (options.pressure.value_or(1) > 0 && options.humidity.value_or(1) > 0)
    check_attraction(scene, "capillarity");
}

void plan_capillarity(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  const Meniscus liquid = meniscus(std::any_cast<const CapillarityOptions&>(given));
  if (!(liquid.pressure > 0)) {
    plan_gap_term({"capillarity", GapLaw::dugdale, 0, 1}, "no liquid: nothing pulls", geometry, plan);
    return;
  }
  if (!std::isfinite(liquid.height))
    refuse("the liquid pulls with " + format_quantity(liquid.pressure, dimension::pressure) +
               ", too little for a finite height of its meniscus",
           "give `capillarity` a `pressure` of 0 for no liquid, or check its units");
  plan_gap_term({"capillarity", GapLaw::dugdale, liquid.pressure * liquid.height, liquid.height},
                "liquid pulls with " + format_quantity(liquid.pressure, dimension::pressure) +
                    " in gaps under " + format_quantity(liquid.height, dimension::length),
                geometry, plan);
}

}  // namespace

const Effect& capillarity_effect() {
  using O = CapillarityOptions;
  static const Effect record{
      .name = "capillarity",
      .sentence = "liquid in narrow gaps pulls the bodies together, and the junctions carry that too",
      .acts = Effect::Acts::adds_term,
      .defaults = O{},
      .options = {quantity_row("pressure", &O::pressure, dimension::pressure, at_least(0),
                               "pressure of the liquid below the air; sets the radius of the meniscus"),
                  number_row("humidity", &O::humidity, {0, 1, false, true, false},
                             "relative; sets the radius and with it the pressure"),
                  quantity_row("surface_tension", &O::surface_tension, dimension::energy_per_area, above(0),
                               "of the liquid; that of water unless given"),
                  quantity_row("contact_angle", &O::contact_angle, dimension::angle, at_least(0),
                               "of the liquid on both bodies, below 90 deg"),
                  number_row("temperature", &O::temperature, above(100),
                             "in kelvins, 293.15 in a room; of `humidity`"),
                  number_row("molar_volume", &O::molar_volume, above(0),
                             "of the liquid in m^3/mol; of `humidity`")},
      .check = check_capillarity,
      .plan = plan_capillarity};
  return record;
}
const Effect& CapillarityOptions::effect() { return capillarity_effect(); }

}  // namespace asperity
