// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/ageing.hpp"

#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void plan_ageing(const AgeingOptions& options, Plan& plan) {
  plan.sliding.ageing = options;
  plan.terms.push_back({"ageing", "tau0 grows with rest, rate " + format_short(options.rate) + " from " +
                                      format_quantity(options.onset, dimension::time)});
}

}  // namespace asperity
