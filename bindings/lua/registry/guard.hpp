// SPDX-License-Identifier: GPL-3.0-or-later
// The middle frame of a call: runs a C++ body, catches its exception and leaves results or a message on the
// Lua stack. The outer frame, without destructors, then returns or raises. Never `catch (...)`: it would
// swallow Lua's own unwinding in the C++ build.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/value.hpp"
#include "engine/core/arithmetic/rounding_mode.hpp"
#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::lua {

// "script.lua:12: " of the innermost running Lua function, or "".
std::string where(lua_State* L);
std::string message_of(lua_State* L, const std::string& name, const Error& error);
// Pushes the message and returns -1.
int fail(lua_State* L, const std::string& message);
// Raises on lack of memory: call inside protect().
void push(lua_State* L, const Value& value);
// Gives the list on top the methods of a Table, with display units (run/row_list.cpp). A number under "Ra
// [um]" becomes one in SI under `Ra`. Raises on lack of memory.
void set_row_methods(lua_State* L, const std::vector<std::pair<std::string, std::string>>& units);
// The unit in which print shows the numbers of a list; "" without. The first raises on lack of memory.
void set_list_unit(lua_State* L, const std::string& unit);  // of the list on top
std::string list_unit(lua_State* L, int index);
// Pushes a value; throws Error{out_of_memory}, which names `what`, with Lua's error on the stack.
void push_checked(lua_State* L, const Value& value, const std::string& what);
// Number of results; -1 with the error on the stack if memory runs out.
int deliver(lua_State* L, const Values& results);

// -1 with the error on the stack if the body throws. Prefixes messages by `name`.
template <class Run>
int guarded(lua_State* L, const std::string& name, Run run) {
  const RoundToNearest whatever_the_host_does;
  try {
    stop_flag().check();
    return deliver(L, run());
  } catch (const Error& error) {
    return fail(L, message_of(L, name, error));
  } catch (const std::bad_alloc&) {
    return fail(L, where(L) + name + ": out of memory");
  } catch (const std::exception& error) {
    return fail(L, where(L) + name + ": internal error: " + error.what());
  }
}

// Repeats the body after a garbage collection if memory ran out. A failed body must change nothing.
template <class Run>
auto with_collection(lua_State* L, Run run) {
  try {
    return run();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::out_of_memory) throw;
    lua_gc(L, LUA_GCCOLLECT);
  }
  try {
    return run();
  } catch (const Error& error) {
    // Also if the script catches the error.
    if (error.code() == ErrorCode::out_of_memory) memory::note_exceeded();
    throw;
  }
}

}  // namespace asperity::lua
