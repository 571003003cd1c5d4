// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/interlocking.hpp"

#include <numbers>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void plan_interlocking(const InterlockingOptions& options, const ContactGeometry& geometry, Plan& plan) {
  if (geometry.upper_is_flat())
    throw Error(ErrorCode::bad_state,
                "the effect `interlocking` is of two rough bodies, and the upper body is a flat",
                "give a surface as `upper`, or leave the effect out");
  plan.sliding.interlocking = options;
  plan.terms.push_back({"interlocking", "slopes of the contact towards " +
                                            format_short(options.direction * 180 / std::numbers::pi) +
                                            " deg from x add to the angle of friction"});
}

}  // namespace asperity
