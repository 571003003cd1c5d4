// SPDX-License-Identifier: GPL-3.0-or-later
// The middle of the three frames of a call: it runs a body, which is ordinary C++, catches what the
// body throws and leaves either its results or an error message on the Lua stack. The outer frame,
// which owns nothing with a destructor, then returns or raises. Never `catch (...)` here: under the C++
// build of Lua that would swallow Lua's own unwinding.
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

// "script.lua:12: " of the innermost Lua function that is running, or "".
std::string where(lua_State* L);
// The message of an error: where, which function, sentence and hint.
std::string message_of(lua_State* L, const std::string& name, const Error& error);
// Pushes an error message and returns -1, which tells the outer frame to raise it.
int fail(lua_State* L, const std::string& message);
// Pushes results and returns their number; -1, with the error pushed, if Lua has no memory.
int deliver(lua_State* L, const Values& results);

// Runs a body that returns Values; -1 with the error on the stack if it threw. `name` is put before the
// message of an error that does not begin with it.
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

// Runs a body, and once more if it found no memory, after Lua has given back what the script can no longer
// reach. A body that fails must leave everything as it was.
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
    // Nothing is left to give back: the run met its limit, whatever the script makes of the error.
    if (error.code() == ErrorCode::out_of_memory) memory::note_exceeded();
    throw;
  }
}

}  // namespace asperity::lua
