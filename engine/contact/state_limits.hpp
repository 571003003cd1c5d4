// SPDX-License-Identifier: GPL-3.0-or-later
// The limits of a state: where its numbers say little of real bodies although the equations are solved. Too
// few nodes in contact, a contact or an attraction that the rim of a free tile cuts off, slopes that are not
// small (a half-space is flat before it is loaded), pressures near the contact modulus (elasticity is
// linear), and pressures above the hardness without yielding. None of these is an error of the solver, and
// none changes a number. print(st), st.warnings, friction laws and the tilt stage report them from here.
#pragma once

#include <string>
#include <vector>

#include "engine/contact/state.hpp"

namespace asperity {

// On fewer nodes of a half-space sizes and errors are those of the grid: the area of a spot errs by over 10 %.
bool rests_on_few_nodes(const State& state);

// Sentences, most often none. Throws Error{bad_state} for a state that was closed. O(n), no transforms.
std::vector<std::string> state_limits(const State& state);

}  // namespace asperity
