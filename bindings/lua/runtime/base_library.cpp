// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/base_library.hpp"

#include <algorithm>
#include <unordered_map>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/error.hpp"

namespace asperity::lua {

namespace {

using FunctionPaths = std::unordered_map<lua_CFunction, BasePath>;

template <class Use>
void with_base_table(lua_State* L, std::string_view library, Use&& use) {
  with_key(Argument(L, LUA_REGISTRYINDEX), LUA_LOADED_TABLE, [&](const Argument& loaded) {
    if (!loaded.is_table()) return;
    with_key(loaded, library, [&](const Argument& table) {
      if (table.is_table()) use(table);
    });
  });
}

FunctionPaths read_function_paths() {
  const State state(luaL_newstate());
  auto open = [](lua_State* L) {
    luaL_openlibs(L);
    return 0;
  };
  if (state == nullptr || protect(state.get(), 0, 0, open) != LUA_OK)
    throw Error(ErrorCode::out_of_memory, "there is no memory for a Lua state");
  FunctionPaths paths;
  for (const std::string_view library : base_libraries)
    with_base_table(state.get(), library, [&](const Argument& table) {
      table.each([&](const Argument& key, const Argument& value) {
        lua_CFunction function = lua_tocfunction(value.state(), value.index());
        if (function == nullptr || !key.is_text()) return;
        const auto [path, is_new] =
            paths.try_emplace(function, BasePath{std::string(library), std::string(key.text())});
        // Aliases (math.atan2 is math.atan): the alphabetically first counts.
        if (!is_new && path->second.library == library && key.text() < path->second.key)
          path->second.key = key.text();
      });
    });
  paths.try_emplace(print_values, BasePath{"_G", "print"});
  paths.try_emplace(ordered_pairs, BasePath{"_G", "pairs"});
  paths.try_emplace(ordered_next, BasePath{"_G", "next"});
  return paths;
}

}  // namespace

const BasePath* base_function(lua_CFunction function) {
  static const FunctionPaths paths = read_function_paths();
  const auto found = paths.find(function);
  return found == paths.end() ? nullptr : &found->second;
}

BaseLibrary::BaseLibrary(lua_State* L) {
  const Argument::StackGuard guard(L);
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  paths_.reserve(32);
  paths_.emplace_back(lua_topointer(L, -1), BasePath{"_G", ""});
  // One pass, for every case of an ensemble. If two paths share a table, the first library by name counts.
  struct Library {
    const void* table = nullptr;
    std::vector<std::pair<const void*, std::string>> parts;
  };
  std::array<Library, base_libraries.size()> found;
  with_key(Argument(L, LUA_REGISTRYINDEX), LUA_LOADED_TABLE, [&](const Argument& loaded) {
    if (!loaded.is_table()) return;
    loaded.each([&](const Argument& name, const Argument& table) {
      if (!name.is_text() || !table.is_table()) return;
      const auto* const at = std::ranges::find(base_libraries, name.text());
      if (at == base_libraries.end()) return;
      Library& library = found[static_cast<std::size_t>(at - base_libraries.begin())];
      library.table = lua_topointer(L, table.index());
      if (*at != "io" && *at != "package") return;
      table.each([&](const Argument& key, const Argument& value) {
        const int kind = lua_type(L, value.index());
        const bool part = *at == "io" ? kind == LUA_TUSERDATA : kind == LUA_TTABLE;
        if (part && key.is_text())
          library.parts.emplace_back(lua_topointer(L, value.index()), std::string(key.text()));
      });
    });
  });
  const auto add = [&](const void* table, std::string_view library, std::string key) {
    if (table != nullptr && path_at(table) == nullptr)
      paths_.emplace_back(table, BasePath{std::string(library), std::move(key)});
  };
  for (std::size_t k = 0; k < found.size(); ++k) {
    add(found[k].table, base_libraries[k], "");
    for (auto& [pointer, key] : found[k].parts) add(pointer, base_libraries[k], std::move(key));
  }
}

const BasePath* BaseLibrary::path_at(const void* table) const {
  for (const auto& [known, path] : paths_)
    if (known == table) return &path;
  return nullptr;
}

const BasePath* BaseLibrary::find(lua_State* L, int index) const { return path_at(lua_topointer(L, index)); }

bool is_sandbox_function(lua_State* L, int index) {
  if (!lua_isfunction(L, index) || lua_iscfunction(L, index)) return false;
  const Argument::StackGuard guard(L);
  lua_Debug facts;
  lua_pushvalue(L, index);
  lua_getinfo(L, ">S", &facts);
  return std::string_view(facts.source) == "=sandbox";
}

void push_base(lua_State* L, const BasePath& path) {
  luaL_checkstack(L, 4, nullptr);
  if (path.library == "_G") {
    lua_pushglobaltable(L);
  } else {
    lua_getfield(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_getfield(L, -1, path.library.c_str());
    lua_remove(L, -2);
  }
  if (path.key.empty()) return;
  if (lua_istable(L, -1)) {
    lua_pushlstring(L, path.key.data(), path.key.size());
    lua_rawget(L, -2);
  } else {
    lua_pushnil(L);
  }
  lua_remove(L, -2);
}

}  // namespace asperity::lua
