// SPDX-License-Identifier: GPL-3.0-or-later
// lab.knob: a number that whoever runs the script may set otherwise; lab.knob.set moves it where a person is
// there to see it move.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

const Module& knob_module();

// Puts the knobs of the run into its manifest; nothing where there are none, and in a case.
void note_knobs(const Session& session);

}  // namespace asperity::lua
