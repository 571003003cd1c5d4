// SPDX-License-Identifier: GPL-3.0-or-later
// What a solution of the equations does not know of itself: that they were asked where they say little of
// real bodies. Small slopes (a half-space is flat before it is loaded), pressures well under the contact
// modulus (elasticity is linear), and pressures that the material carries without yielding. None of these
// is an error of the solver, and none changes a number.
#pragma once

#include <string>
#include <vector>

#include "engine/contact/state.hpp"

namespace asperity {

// The line of a state with what is known of the error of its cells (an estimate, what was chosen for an error
// that was asked for), and below it the doubts, a line each. Of a state that was closed its line alone.
std::string described(const State& state);

// Sentences, most often none. Throws Error{bad_state} for a state that was closed. O(n).
std::vector<std::string> doubts(const State& state);

}  // namespace asperity
