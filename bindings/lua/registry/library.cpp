// SPDX-License-Identifier: GPL-3.0-or-later
// `lab` in Lua: each module is an empty, read-only table whose metatable finds members. Unknown names are
// errors with the nearest name.
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

const char module_key = 0;  // metatable[module_key] = Module*

// At most one is set. A submodule hides a constant of the same name; a constant hides a function.
struct Member {
  const Module* module = nullptr;
  const Constant* constant = nullptr;
  const Function* function = nullptr;
};

// Last part of the path of a submodule, or "".
std::string_view name_within(const Module& outer, const Module& inner) {
  const std::string_view path = inner.path;
  const std::size_t dot = path.rfind('.');
  return dot != std::string_view::npos && path.substr(0, dot) == outer.path ? path.substr(dot + 1)
                                                                            : std::string_view();
}

Member member_of(const Module& module, std::string_view name) {
  for (const Module* inner : modules())
    if (!name.empty() && name_within(module, *inner) == name) return {.module = inner};
  for (const Constant& constant : module.constants)
    if (constant.name == name) return {.constant = &constant};
  for (const Function& function : module.functions)
    if (function.name == name) return {.function = &function};
  return {};
}

std::vector<std::string> names_of_members(const Module& module) {
  std::vector<std::string> names;
  for (const Function& function : module.functions) names.push_back(function.name);
  for (const Constant& constant : module.constants) names.push_back(constant.name);
  for (const Module* inner : modules())
    if (const std::string_view name = name_within(module, *inner); !name.empty()) names.emplace_back(name);
  return names;
}

// Caches the member in `storage`: scripts use few of several hundred functions. Raises.
void make_member(lua_State* L, int storage, const char* name, const Member& member) {
  if (member.module != nullptr) {
    push_proxy(L, *member.module);
  } else if (member.constant != nullptr) {
    static const std::string nothing;
    const auto value = [&member]() -> Values { return {member.constant->value()}; };
    if (guarded(L, nothing, value) < 0) lua_error(L);
  } else {
    push_function(L, *member.function);
  }
  lua_pushvalue(L, -1);
  lua_setfield(L, storage, name);
}

// Makes the missing members. Raises.
template <class Named>
void make_all(lua_State* L, int storage, const Module& module, const std::vector<Named>& members) {
  for (const Named& named : members) {
    if (lua_getfield(L, storage, named.name.c_str()) == LUA_TNIL)
      make_member(L, storage, named.name.c_str(), member_of(module, named.name));
    lua_settop(L, 1);
  }
}

int module_index(lua_State* L) {
  lua_settop(L, 2);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  if (lua_type(L, 2) == LUA_TSTRING) {
    std::size_t length = 0;
    const char* name = lua_tolstring(L, 2, &length);
    const Member member = member_of(module, {name, length});
    if (member.module != nullptr || member.constant != nullptr || member.function != nullptr)
      return make_member(L, lua_upvalueindex(2), name, member), 1;
  }
  lua_pop(L, 1);
  const int results = [&] {
    static const std::string nothing;
    return guarded(L, nothing, [&]() -> Values {
      const Argument key(L, 2);
      const std::string shown = key.is_text() ? quoted(key.text().substr(0, 40)) : key.describe();
      throw Error(ErrorCode::unknown_name,
                  module.path + " has no field " + shown +
                      (key.is_text() ? did_you_mean(key.text(), names_of_members(module)) : ""),
                  "lab.help \"" + module.path + "\" lists what it has");
    });
  }();
  return results < 0 ? mistaken_field(L) : results;
}

int module_new_index(lua_State* L) {
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  return luaL_error(L, "%s cannot be changed", module.path.c_str());
}

int module_pairs(lua_State* L) {
  lua_settop(L, 1);
  const Module& module = *static_cast<const Module*>(lua_touserdata(L, lua_upvalueindex(1)));
  const int storage = lua_upvalueindex(2);
  make_all(L, storage, module, module.functions);
  make_all(L, storage, module, module.constants);
  for (const Module* inner : modules()) {
    const std::string_view name = name_within(module, *inner);
    if (name.empty()) continue;
    push_proxy(L, *inner);
    lua_setfield(L, storage, name.data());  // the name is the end of the path, so it is null-terminated
  }
  push_ordered_loop(L, storage);  // the loop hides the storage, which a script could change
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

// Stack: [-1] = new metatable, [-2] = storage. The closure has module and storage.
void set_module_method(lua_State* L, const char* name, lua_CFunction function, const Module& module) {
  lua_pushlightuserdata(L, const_cast<Module*>(&module));
  lua_pushvalue(L, -3);
  lua_pushcclosure(L, function, 2);
  lua_setfield(L, -2, name);
}

int module_call(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_replace(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

void push_module(lua_State* L, const Module& module) {
  lua_newtable(L);  // storage
  lua_newtable(L);  // proxy, always empty
  lua_pushvalue(L, -2);
  lua_newtable(L);
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
  lua_remove(L, -2);  // storage
  lua_setmetatable(L, -2);
  lua_remove(L, -2);  // storage
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

void push_proxy(lua_State* L, const Module& module) {
  luaL_checkstack(L, 16, nullptr);
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &module) != LUA_TNIL) return;
  lua_pop(L, 1);
  push_module(L, module);
}

void push_library(lua_State* L) { push_proxy(L, *modules().front()); }

Session& Call::session() const { return Session::of(L); }

}  // namespace asperity::lua
