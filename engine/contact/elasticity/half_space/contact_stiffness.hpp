// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the mean pressure rises with the approach while the contact set stays as it is: K_FF x = 1 on
// the nodes F whose pressure is free to change, stiffness = Σx / n (Pa/m). Capped nodes give nothing; nodes
// past their yield pressure give way by 1/K_h besides K.
#pragma once

#include "engine/contact/elasticity/half_space/solver/half_space_solve.hpp"

namespace asperity {

// By preconditioned conjugate gradients on the finest grid, some 10 to 20 applications of K; +∞ where all of
// a periodic half-space is in elastic contact (1/K(0) of a layer), 0 where no node is free. Relative accuracy
// about 1e-8.
double contact_stiffness(const HalfSpaceProblem& problem, const HalfSpaceAnswer& answer, Monitor& monitor);

}  // namespace asperity
