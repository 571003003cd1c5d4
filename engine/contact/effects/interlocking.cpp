// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/interlocking.hpp"

#include <numbers>

#include "engine/contact/plan.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

void plan_interlocking(const std::any& given, const ContactGeometry& geometry, Plan& plan) {
  if (geometry.upper_is_flat())
    refuse_state("the effect `interlocking` needs two rough bodies, and the upper body is flat",
                 "give a surface as `upper`, or leave the effect out");
  const double direction = std::any_cast<const InterlockingOptions&>(given).direction;
  plan.terms.push_back({"interlocking", "slopes of the contact towards " +
                                            format_short(direction * 180 / std::numbers::pi) +
                                            " deg from x add to the angle of friction"});
}

}  // namespace

const Effect& interlocking_effect() {
  using O = InterlockingOptions;
  static const Effect record{
      .name = "interlocking",
      .sentence = "slopes of two rough bodies add to the angle of friction; {} for its defaults",
      .acts = Effect::Acts::reads_state,
      .defaults = O{},
      .options = {quantity_row(
          "direction", &O::direction, dimension::angle, any(),
          "the way the upper body is pushed over the lower one, counter-clockwise from x")},
      .plan = plan_interlocking};
  return record;
}
const Effect& InterlockingOptions::effect() { return interlocking_effect(); }

}  // namespace asperity
