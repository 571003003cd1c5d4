// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral projected gradients in slabs, as half_space/descent.hpp: feasible throughout and
// convergent in theory; slow.
#pragma once

#include "engine/contact/elasticity/slabs/slab_descent.hpp"

namespace asperity {

// From fields.pressure, feasible. Whether it converged within the applications given.
bool slab_gradient(SlabLevel& level, SlabFields& fields, double tolerance, int most_applications);

}  // namespace asperity
