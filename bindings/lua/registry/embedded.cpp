// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/embedded.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>

namespace asperity::lua {

namespace {

// Compiled texts with line numbers and names; compilation dominated the creation of states.
class CompiledTexts {
 public:
  std::shared_ptr<const std::string> find(const void* text) {
    const std::lock_guard lock(mutex_);
    const auto at = codes_.find(text);
    return at == codes_.end() ? nullptr : at->second;
  }
  void add(const void* text, std::string code) {
    const std::lock_guard lock(mutex_);
    codes_.emplace(text, std::make_shared<const std::string>(std::move(code)));
  }

 private:
  std::mutex mutex_;
  std::map<const void*, std::shared_ptr<const std::string>> codes_;
};

CompiledTexts& compiled_texts() {
  static CompiledTexts texts;
  return texts;
}

// -1 if not cached. Lua may raise: no pending destructor.
int load_compiled(lua_State* L, std::string_view text, const char* chunk) {
  const std::shared_ptr<const std::string> code = compiled_texts().find(text.data());
  return code == nullptr ? -1 : luaL_loadbufferx(L, code->data(), code->size(), chunk, "b");
}

void keep_compiled(lua_State* L, std::string_view text) {
  try {
    std::string code;
    if (lua_dump(L, append_code, &code, 0) == 0) compiled_texts().add(text.data(), std::move(code));
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
  int status = load_compiled(L, text, chunk);
  if (status < 0) {
    status = luaL_loadbufferx(L, text.data(), text.size(), chunk, "t");
    if (status == LUA_OK) keep_compiled(L, text);
  }
  if (status != LUA_OK) lua_error(L);
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
