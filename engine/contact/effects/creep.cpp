// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/creep.hpp"

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

double softening(const CreepOptions& creep, std::optional<double> dwell) {
  const auto growth = [&](double time) { return 1 + creep.rate * elementary::log1p(time / creep.onset); };
  return dwell ? growth(creep.reference) / growth(*dwell) : 1.0;
}

namespace {

void check_creep(const std::any&, const Scene& scene) {
  if (!scene.effects.has<PlasticityOptions>())
    refuse("`creep` lowers the hardness of `plasticity`, and this scene names no `plasticity`",
           "name `plasticity` as well, or leave `creep` out");
}

void plan_creep(const std::any& given, const ContactGeometry&, Plan& plan) {
  const auto& options = std::any_cast<const CreepOptions&>(given);
  plan.yield->softening = [options](std::optional<double> dwell) { return softening(options, dwell); };
  plan.terms.push_back({"creep", "hardness falls with dwell, rate " + format_short(options.rate) + " from " +
                                     format_quantity(options.onset, dimension::time) + ", stated for " +
                                     format_quantity(options.reference, dimension::time)});
}

}  // namespace

const Effect& creep_effect() {
  using O = CreepOptions;
  static const Effect record{
      .name = "creep",
      .sentence = "hardness falls with the dwell of the load; needs plasticity; {} for its defaults",
      .acts = Effect::Acts::scales_bound,
      .defaults = O{},
      .options =
          {number_row(
               "rate", &O::rate, at_least(0),
               "b of the law H = hardness (1 + b ln(1 + reference/onset)) / (1 + b ln(1 + dwell/onset))"),
           quantity_row("onset", &O::onset, dimension::time, above(0), "time from which creep counts"),
           quantity_row("reference", &O::reference, dimension::time, above(0),
                        "dwell at which the hardness is the stated one, and of a press that names no dwell")},
      .check = check_creep,
      .plan = plan_creep};
  return record;
}
const Effect& CreepOptions::effect() { return creep_effect(); }

}  // namespace asperity
