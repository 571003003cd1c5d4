// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/creep.hpp"

#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void plan_creep(const CreepOptions& options, Plan& plan) {
  plan.yield->creep = options;
  plan.terms.push_back({"creep", "hardness falls with dwell, rate " + format_short(options.rate) + " from " +
                                     format_quantity(options.onset, dimension::time) + ", stated for " +
                                     format_quantity(options.reference, dimension::time)});
}

}  // namespace asperity
