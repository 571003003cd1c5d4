// SPDX-License-Identifier: GPL-3.0-or-later
// The quick stage: preconditioned conjugate gradients on the current free set, with pressures allowed outside
// their bounds until the next pass: one step a pass where nothing has to be settled, else a few. What the
// clipping changes is not paid for by an application of its own but travels with a fixed preconditioned
// (Richardson) step. On cells much longer than wide it leaves lines their loads (load_projection.hpp).
// Two-cycles of a few nodes are broken by averaging two passes, exact because g is linear in p. It has no
// proof of convergence; it stops when it no longer gains.
#pragma once

#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"
#include "engine/contact/elasticity/half_space/solver/descent.hpp"

namespace asperity {

// From fields.pressure, feasible. Ends converged (residual < tolerance) or with feasible pressures. `exact`:
// pressures that converged are feasible, too, and their gap is computed afresh.
StageEnd active_set_descent(ContactLevel& level, DescentFields& fields, double tolerance,
                            int most_applications, bool exact);

}  // namespace asperity
