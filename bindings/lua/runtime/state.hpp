// SPDX-License-Identifier: GPL-3.0-or-later
// Lua states of the program and of cases: counted memory, the reduced library (the whole one if trusted),
// strict globals, `require "asperity"`, and math.random seeded from the run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state_heap.hpp"

namespace asperity::lua {

class Argument;

struct StateCloser {
  void operator()(lua_State* L) const;
};
using State = std::unique_ptr<lua_State, StateCloser>;

// After a byte-order mark and "#!...".
std::size_t begin_of_script(std::string_view text);

std::string search_path(const std::string& script_folder);

// `script_folder`: of the script's modules; may be empty. The session must outlive the state. Throws
// Error{out_of_memory}.
State make_state(Session& session, const std::string& script_folder);

// Every later instruction raises "interrupted". From any thread or signal handler.
void interrupt(lua_State* L);
// Checks the stop flag every few thousand instructions, also in coroutines. Slows pure Lua up to two times;
// only for runs with a limit.
void watch_for_stops(lua_State* L);

// Other values as by tostring.
std::string error_text(lua_State* L, int index);

// Calls the function below the top `arguments` values. Returns the message of a failure; throws
// Error{interrupted} after a stop.
std::optional<std::string> failure_of_call(lua_State* L, int arguments, int results);
// The same with these arguments and one result.
std::optional<std::string> failure_of_call(const Argument& function, const Values& arguments);

// More lines only for ledgers, plans and long lists. Never raises.
std::string shown_line(lua_State* L, int index);
// To the session's output, a plain table by its content. Raises.
int print_values(lua_State* L);

// For lua_pcall: text of any error value, with a traceback.
int traceback_handler(lua_State* L);

}  // namespace asperity::lua
