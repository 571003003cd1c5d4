// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/lua_names.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/base_library.hpp"
#include "bindings/lua/runtime/state.hpp"

namespace asperity::lua {

namespace {

// Refusals of the sandbox have an upvalue `what`.
bool is_refused(lua_State* L, int index) {
  if (!is_sandbox_function(L, index)) return false;
  bool refused = false;
  for (int k = 1; const char* name = lua_getupvalue(L, index, k); ++k) {
    refused = refused || std::string_view(name) == "what";
    lua_pop(L, 1);
  }
  return refused;
}

void list_table(lua_State* L, const Argument& table, const std::string& library,
                std::vector<LuaName>& names) {
  table.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text() || key.text().starts_with("_")) return;
    const bool function = lua_isfunction(L, value.index());
    if (function && is_refused(L, value.index())) return;
    const std::string name(key.text());
    names.push_back({library, name, function});
    if (library.empty() && lua_istable(L, value.index()) && name != "package")
      list_table(L, value, name, names);
  });
}

std::vector<LuaName> read_names() {
  Session session(Monitor::silent());
  const State state = make_state(session, "");
  std::vector<LuaName> names;
  lua_rawgeti(state.get(), LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  list_table(state.get(), Argument(state.get(), lua_gettop(state.get())), "", names);
  std::sort(names.begin(), names.end(), [](const LuaName& a, const LuaName& b) {
    return std::tie(a.library, a.name) < std::tie(b.library, b.name);
  });
  return names;
}

}  // namespace

const std::vector<LuaName>& lua_names() {
  static const std::vector<LuaName> names = read_names();
  return names;
}

}  // namespace asperity::lua
