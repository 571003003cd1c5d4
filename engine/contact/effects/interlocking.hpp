// SPDX-License-Identifier: GPL-3.0-or-later
// Interlocking in the plan of a contact: it brings no term to the normal problem, only the direction that
// friction is asked for along. What the slopes do is in friction/interlocking.hpp.
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

// Throws Error{bad_state} for a flat counter-body: two rough bodies interlock, a flat has no slopes.
void plan_interlocking(const InterlockingOptions& options, const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
