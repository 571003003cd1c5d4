// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of validity of a state: few nodes in contact, contact or attraction at the rim of a free tile,
// steep slopes, pressures near the contact modulus or above the hardness. No number changes.
#pragma once

#include <string>
#include <vector>

#include "engine/contact/state.hpp"

namespace asperity {

// The area of a spot of a half-space then errs by over 10 %.
bool rests_on_few_nodes(const State& state);

// Sentences, mostly none. Throws Error{bad_state} for a closed state. O(n), no transforms.
std::vector<std::string> state_limits(const State& state);

}  // namespace asperity
