// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/ageing.hpp"

#include "engine/contact/plan.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/text.hpp"

namespace asperity {

double strengthening(const AgeingOptions& ageing, std::optional<double> rest) {
  return rest ? 1 + ageing.rate * elementary::log1p(*rest / ageing.onset) : 1.0;
}

namespace {

void plan_ageing(const std::any& given, const ContactGeometry&, Plan& plan) {
  const auto& options = std::any_cast<const AgeingOptions&>(given);
  plan.terms.push_back({"ageing", "tau0 grows with rest, rate " + format_short(options.rate) + " from " +
                                      format_quantity(options.onset, dimension::time)});
}

}  // namespace

const Effect& ageing_effect() {
  using O = AgeingOptions;
  static const Effect record{
      .name = "ageing",
      .sentence = "tau0 of the friction law grows with the time the junctions rest",
      .acts = Effect::Acts::reads_state,
      .defaults = O{},
      .options = {number_row("rate", &O::rate, at_least(0), "growth of tau0 per unit of ln(1 + rest/onset)")
                      .needed(),
                  quantity_row("onset", &O::onset, dimension::time, above(0), "rest from which ageing counts")
                      .needed()},
      .plan = plan_ageing};
  return record;
}
const Effect& AgeingOptions::effect() { return ageing_effect(); }

}  // namespace asperity
