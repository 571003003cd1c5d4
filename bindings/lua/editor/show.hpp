// SPDX-License-Identifier: GPL-3.0-or-later
// show(value): what a prompt draws in the terminal. A surface or a field of a state as a map, a profile or
// the columns of a notebook as a chart; with the name of a file, the picture goes there instead.
#pragma once

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Pushes the function. Raises on lack of memory.
void push_show(lua_State* L);

}  // namespace asperity::lua
