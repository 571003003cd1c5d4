// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/guard.hpp"

#include <string_view>

namespace asperity::lua {

std::string where(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; level < 16 && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    // Functions replaced by the sandbox have no line in the script.
    if (frame.currentline > 0 && std::string_view(frame.source) != "=sandbox")
      return std::string(frame.short_src) + ":" + std::to_string(frame.currentline) + ": ";
  }
  return "";
}

std::string message_of(lua_State* L, const std::string& name, const Error& error) {
  if (error.code() == ErrorCode::interrupted) return where(L) + "interrupted";
  const std::string text = error.what();
  return where(L) + (text.starts_with(name) || name.empty() ? text : name + ": " + text);
}

int fail(lua_State* L, const std::string& message) {
  auto action = [&message](lua_State* state) {
    lua_pushlstring(state, message.data(), message.size());
    return 1;
  };
  protect(L, 0, 1, action);  // if protect fails, the stack holds Lua's memory error
  return -1;
}

int deliver(lua_State* L, const Values& results) {
  const int count = static_cast<int>(results.size());
  auto action = [&results](lua_State* state) {
    luaL_checkstack(state, static_cast<int>(results.size()) + 8, "too many results");
    for (const Value& value : results) push(state, value);
    return static_cast<int>(results.size());
  };
  return protect(L, 0, count, action) == LUA_OK ? count : -1;
}

}  // namespace asperity::lua
