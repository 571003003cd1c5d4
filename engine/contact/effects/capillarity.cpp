// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/capillarity.hpp"

#include <cmath>

#include "engine/contact/effects/adhesion.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"

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

void plan_capillarity(const CapillarityOptions& options, const ContactGeometry& geometry, Plan& plan) {
  const Meniscus liquid = meniscus(options);
  if (!(liquid.pressure > 0)) {
    plan_gap_term({"capillarity", GapLaw::dugdale, 0, 1, 0.5}, "no liquid: nothing pulls", geometry, plan);
    return;
  }
  if (!std::isfinite(liquid.height))
    throw Error(ErrorCode::bad_value,
                "the liquid pulls with " + format_quantity(liquid.pressure, dimension::pressure) +
                    ", so little that its meniscus has no height that a number holds",
                "give `capillarity` a `pressure` of 0 for no liquid, or check its units");
  plan_gap_term({"capillarity", GapLaw::dugdale, liquid.pressure * liquid.height, liquid.height, 0.5},
                "liquid pulls with " + format_quantity(liquid.pressure, dimension::pressure) +
                    " in gaps under " + format_quantity(liquid.height, dimension::length),
                geometry, plan);
}

}  // namespace asperity
