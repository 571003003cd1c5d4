// SPDX-License-Identifier: GPL-3.0-or-later
// The limits of a state, where a solution of the equations says little of real bodies: few nodes in contact,
// a contact or an attraction at the rim of a free tile, steep slopes, pressures near the contact modulus or
// above the hardness. print(st), st.warnings, friction laws and the tilt stage report them; no number
// changes.
#pragma once

#include <string>
#include <vector>

#include "engine/contact/state.hpp"

namespace asperity {

// So few nodes of a half-space that the area of a spot errs by over 10 %.
bool rests_on_few_nodes(const State& state);

// Sentences, most often none. Throws Error{bad_state} for a state that was closed. O(n), no transforms.
std::vector<std::string> state_limits(const State& state);

}  // namespace asperity
