// SPDX-License-Identifier: GPL-3.0-or-later
// Ageing in the plan of a contact: junctions strengthen with the time they rest, by the logarithmic law of
// AgeingOptions. It brings no term to the normal problem; friction reads it where a rest is named.
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

void plan_ageing(const AgeingOptions& options, Plan& plan);

}  // namespace asperity
