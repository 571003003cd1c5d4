// SPDX-License-Identifier: GPL-3.0-or-later
// A Lua state as the program and the cases of an ensemble use it: counted memory, the reduced
// library (or the whole one when trusted), strict globals, `require "asperity"`, and math.random
// seeded from the run. The loadable module does not use this: it lives in somebody else's state.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state_heap.hpp"

namespace asperity::lua {

struct StateCloser {
  void operator()(lua_State* L) const;
};
using State = std::unique_ptr<lua_State, StateCloser>;

// The first byte of a script after a byte-order mark or a first line "#!...", which is for the shell.
std::size_t begin_of_script(std::string_view text);

// The pattern by which `require` looks in a folder.
std::string search_path(const std::string& script_folder);

// `script_folder` is where require looks for a script's own modules; may be empty. The session must
// outlive the state. Throws Error{out_of_memory}.
State make_state(Session& session, const std::string& script_folder);

// Makes the state raise "interrupted" at its next instruction, and at every one after. Callable from
// another thread or a signal handler.
void interrupt(lua_State* L);
// Looks at the stop flag every few thousand instructions, in coroutines too. Costs pure Lua up to half
// its speed, so it is for runs with a limit.
void watch_for_stops(lua_State* L);

// An error value as text: a string as it is, anything else as tostring would show it.
std::string error_text(lua_State* L, int index);

// The message handler of an uncaught error: text of the value, whatever it is, and a traceback.
int traceback_handler(lua_State* L);

}  // namespace asperity::lua
