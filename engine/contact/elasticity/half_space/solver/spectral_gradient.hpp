// SPDX-License-Identifier: GPL-3.0-or-later
// The last resort and the shaker: spectral projected gradients (Birgin, Martínez & Raydan 2000, SIAM J.
// Optim. 10, 1196), alternating Barzilai–Borwein steps, exact projection on bounds and load, nonmonotone
// over a window. Feasible throughout and convergent in theory; slow.
#pragma once

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"

namespace asperity {

// From fields.pressure, feasible. Ends converged (residual < tolerance, fresh gap) or after the applications
// given.
StageEnd spectral_gradient(ContactLevel& level, DescentFields& fields, double tolerance,
                           int most_applications);

}  // namespace asperity
