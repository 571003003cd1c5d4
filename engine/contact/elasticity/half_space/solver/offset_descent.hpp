// SPDX-License-Identifier: GPL-3.0-or-later
// The contact at a given offset δ, on one grid: 0 <= p <= H with g = K p − h − δ (and what yielded) as the
// law of the pressure has it, and no load to keep. Preconditioned conjugate gradients on the free set,
// pressures being allowed outside their bounds until the next pass, as in active_set_descent.hpp; there the
// load balances the gaps of the free nodes, here these are brought to δ itself. So no load is sought, and one
// that hardly tells offsets apart, or hardly depends on them, costs no more than another. Where that stalls,
// passes that each lower the energy ½ p·Kp − (h + δ)·p take over, for a while.
#pragma once

#include "engine/contact/elasticity/half_space/solver/descent_chain.hpp"

namespace asperity {

// From fields.pressure, and from fields.gap, K p − h of them, where `gap_known`; without it the pressures are
// feasible (zero will do). Ends with feasible pressures and, if converged, a gap that is computed afresh
// (full), as the steps left it (brief), or that of pressures before they were settled (start). The residual
// is measured by level.length. Where all of a periodic tile would touch without yielding no pressure has the
// gap: does not converge then.
ChainEnd run_offset_chain(ContactLevel& level, DescentFields& fields, double offset, double tolerance,
                          ChainEffort effort, bool gap_known);

}  // namespace asperity
