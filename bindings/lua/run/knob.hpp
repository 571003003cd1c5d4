// SPDX-License-Identifier: GPL-3.0-or-later
// lab.knob: a number of the script that the user may change. lab.knob.set moves a knob interactively.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

const Module& knob_module();

// No effect without knobs or in a case.
void note_knobs(const Session& session);

}  // namespace asperity::lua
