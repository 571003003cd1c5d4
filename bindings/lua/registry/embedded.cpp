// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/embedded.hpp"

#include <map>
#include <mutex>
#include <new>
#include <string>
#include <utility>

namespace asperity::lua {

namespace {

// Compiled texts with line numbers and names; compilation dominated the creation of states. They stay as long
// as the program.
struct CompiledTexts {
  std::mutex mutex;
  std::map<const void*, std::string> codes;
};

CompiledTexts& compiled_texts() {
  static CompiledTexts texts;
  return texts;
}

// Null if not cached.
const std::string* compiled(std::string_view text) {
  CompiledTexts& all = compiled_texts();
  const std::lock_guard lock(all.mutex);
  const auto at = all.codes.find(text.data());
  return at == all.codes.end() ? nullptr : &at->second;
}

void keep_compiled(lua_State* L, std::string_view text) {
  try {
    std::string code;
    if (lua_dump(L, append_code, &code, 0) != 0) return;
    CompiledTexts& all = compiled_texts();
    const std::lock_guard lock(all.mutex);
    all.codes.emplace(text.data(), std::move(code));
  } catch (const std::bad_alloc&) {
  }
}

// For package.preload; upvalue 1: index of the script.
int load_embedded(lua_State* L) {
  const EmbeddedScript& script =
      embedded_scripts()[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
  lua_pushfstring(L, "=asperity.%s", script.name.data());
  load_embedded_text(L, script.text, lua_tostring(L, -1));
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return 1;
}
}  // namespace

int append_code(lua_State*, const void* bytes, std::size_t size, void* code) {
  try {
    static_cast<std::string*>(code)->append(static_cast<const char*>(bytes), size);
    return 0;
  } catch (const std::bad_alloc&) {
    return 1;
  }
}

void load_embedded_text(lua_State* L, std::string_view text, const char* chunk) {
  const std::string* code = compiled(text);
  const std::string_view loaded = code != nullptr ? std::string_view(*code) : text;
  const int status = luaL_loadbufferx(L, loaded.data(), loaded.size(), chunk, code != nullptr ? "b" : "t");
  if (status != LUA_OK) lua_error(L);
  if (code == nullptr) keep_compiled(L, text);
}

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
      ++k;  // the sandbox runs once, first
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
