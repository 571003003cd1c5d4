// SPDX-License-Identifier: GPL-3.0-or-later
// Lua's headers. Functions that may raise are called only inside protect(): an error leaves by longjmp in the
// C build of Lua (no destructor runs) and by Lua's own exception in the C++ build (which no other code may
// swallow).
#pragma once

#include <lua.hpp>

#include <type_traits>

namespace asperity::lua {

// Runs action(L) under lua_pcall with the top `arguments` values; leaves the results, or an error value.
// Returns a Lua status. The action must own no destructor.
template <class Action>
int protect(lua_State* L, int arguments, int results, Action& action) {
  static_assert(!std::is_const_v<Action>);
  if (lua_checkstack(L, 4) == 0) {
    lua_settop(L, -1 - arguments);
    lua_pushliteral(L, "stack overflow");
    return LUA_ERRMEM;
  }
  lua_pushcfunction(L, [](lua_State* state) -> int {
    Action& inner = *static_cast<Action*>(lua_touserdata(state, 1));
    lua_remove(state, 1);
    return inner(state);
  });
  lua_pushlightuserdata(L, &action);
  lua_rotate(L, -2 - arguments, 2);
  return lua_pcall(L, arguments + 1, results, 0);
}

// Copies the entries of the table at an index into that at another; both count from the bottom. Raises on
// lack of memory.
inline void copy_entries(lua_State* L, int from, int to) {
  lua_pushnil(L);
  while (lua_next(L, from) != 0) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, to);
  }
}

}  // namespace asperity::lua
