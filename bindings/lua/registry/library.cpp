// SPDX-License-Identifier: GPL-3.0-or-later
// `lab` in Lua: every module is an empty table whose metatable finds what the module has, so that an
// unknown name is an error with the nearest one and nothing can be changed.
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

const char module_key = 0;  // metatable[module_key] = Module* marks the metatables of modules

int module_index(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  const int results = [&] {
    static const std::string nothing;
    return guarded(L, nothing, [&]() -> Values {
      std::vector<std::string> names;
      Argument(L, lua_upvalueindex(2)).each([&](const Argument& key, const Argument&) {
        names.emplace_back(key.text());
      });
      const Argument key(L, 2);
      const std::string shown = key.is_text() ? quoted(key.text().substr(0, 40)) : key.describe();
      throw Error(
          ErrorCode::unknown_name,
          module.path + " has no field " + shown + (key.is_text() ? did_you_mean(key.text(), names) : ""),
          "lab.help \"" + module.path + "\" lists what it has");
    });
  }();
  return results < 0 ? mistaken_field(L) : results;
}

int module_new_index(lua_State* L) {
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  return luaL_error(L, "%s cannot be changed", module.path.c_str());
}

// The storage stays an upvalue: handed to the script, it could be written to.
int module_next(lua_State* L) {
  lua_settop(L, 2);
  return lua_next(L, lua_upvalueindex(1)) != 0 ? 2 : (lua_pushnil(L), 1);
}

int module_pairs(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_pushcclosure(L, module_next, 1);
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

// With [-1] = the metatable being made and [-2] = hidden storage: sets a closure over both.
void set_module_method(lua_State* L, const char* name, lua_CFunction function, const Module& module) {
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_pushvalue(L, -3);
  lua_pushcclosure(L, function, 2);
  lua_setfield(L, -2, name);
}

int module_call(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_replace(L, 1);  // in place of the module itself
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

// Pushes the proxy of a module and leaves its storage below it: storage, proxy.
void push_module(lua_State* L, const Module& module) {
  lua_newtable(L);  // storage
  for (const Function& function : module.functions) {
    push_function(L, function);
    lua_setfield(L, -2, function.name.c_str());
  }
  for (const Constant& constant : module.constants) {
    push(L, constant.value());
    lua_setfield(L, -2, constant.name.c_str());
  }
  lua_newtable(L);  // proxy, empty for ever
  lua_pushvalue(L, -2);
  lua_newtable(L);  // its metatable
  set_module_method(L, "__index", module_index, module);
  set_module_method(L, "__newindex", module_new_index, module);
  set_module_method(L, "__pairs", module_pairs, module);
  if (module.call) {
    push_function(L, *module.call);
    lua_pushcclosure(L, module_call, 1);
    lua_setfield(L, -2, "__call");
  }
  lua_pushstring(L, module.path.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, module.path.c_str());
  lua_setfield(L, -2, "__metatable");
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_rawsetp(L, -2, &module_key);
  lua_remove(L, -2);  // the second reference to storage
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &module);
}

}  // namespace

const Module* module_at(lua_State* L, int index) {
  if (lua_type(L, index) != LUA_TTABLE || lua_getmetatable(L, index) == 0) return nullptr;
  lua_rawgetp(L, -1, &module_key);
  const auto* module = static_cast<const Module*>(lua_touserdata(L, -1));
  lua_pop(L, 2);
  return module;
}

void push_proxy(lua_State* L, const Module& module) { lua_rawgetp(L, LUA_REGISTRYINDEX, &module); }

void push_library(lua_State* L) {
  luaL_checkstack(L, 16, nullptr);
  lua_newtable(L);  // path -> storage
  const int storages = lua_gettop(L);
  int root = 0;
  for (const Module* module : modules()) {
    push_module(L, *module);
    if (module->path == "lab") {
      root = lua_gettop(L);
    } else {
      const std::string& path = module->path;
      const std::size_t dot = path.rfind('.');
      lua_pushlstring(L, path.data(), dot);
      lua_rawget(L, storages);  // the parent's storage
      lua_pushvalue(L, -2);
      lua_setfield(L, -2, path.c_str() + dot + 1);
      lua_pop(L, 1);
    }
    lua_pushvalue(L, -2);  // this module's storage
    lua_setfield(L, storages, module->path.c_str());
    if (lua_gettop(L) != root) lua_pop(L, 2);
  }
  lua_pushvalue(L, root);
  lua_replace(L, storages);
  lua_settop(L, storages);
}

Session& Call::session() const { return Session::of(L); }

}  // namespace asperity::lua
