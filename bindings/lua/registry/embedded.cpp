// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/embedded.hpp"

namespace asperity::lua {

namespace {
// package.preload's loader: upvalue 1 is the index of the script.
int load_embedded(lua_State* L) {
  const EmbeddedScript& script =
      embedded_scripts()[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
  lua_pushfstring(L, "=asperity.%s", script.name.data());
  if (luaL_loadbufferx(L, script.text.data(), script.text.size(), lua_tostring(L, -1), "t") != LUA_OK)
    return lua_error(L);
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return 1;
}
}  // namespace

std::string_view embedded_script(std::string_view name) {
  for (const EmbeddedScript& script : embedded_scripts())
    if (script.name == name) return script.text;
  return {};
}

void preload_embedded_scripts(lua_State* L) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  lua_Integer k = 0;
  for (const EmbeddedScript& script : embedded_scripts()) {
    if (script.name == "sandbox") {
      ++k;  // runs once, before the script
      continue;
    }
    lua_pushinteger(L, k++);
    lua_pushcclosure(L, load_embedded, 1);
    lua_pushfstring(L, "asperity.%s", script.name.data());
    lua_insert(L, -2);
    lua_settable(L, -3);
  }
  lua_pop(L, 1);
}

}  // namespace asperity::lua
