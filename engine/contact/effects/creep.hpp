// SPDX-License-Identifier: GPL-3.0-or-later
// Creep: the longer a load dwells, the lower the hardness that limits the pressure, by the logarithmic law
// of CreepOptions. Its one term scales the cap; it costs nothing else.
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

// plan.yield must be there.
void plan_creep(const CreepOptions& options, Plan& plan);

}  // namespace asperity
