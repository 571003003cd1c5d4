// SPDX-License-Identifier: GPL-3.0-or-later
// Lua's own library by name, so that a value that belongs to it can be found again in another state:
// `math`, `math.random`, `io.stdout`, the table of globals. Functions without upvalues are the same
// pointer in every state and need no name; those that keep something of their state do.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

struct BasePath {
  std::string library;  // "_G", "math"
  std::string key;      // "random"; empty for the table itself
  bool operator==(const BasePath&) const = default;
};

inline constexpr std::array<std::string_view, 10> base_libraries = {
    "_G", "string", "table", "math", "os", "io", "coroutine", "utf8", "debug", "package"};

// What a freshly opened Lua calls a C function; null if it is not one of Lua's. Thread-safe.
const BasePath* base_function(lua_CFunction function);

// The tables and files of the library as one state has them now. Reads without raising.
class BaseLibrary {
 public:
  explicit BaseLibrary(lua_State* L);
  // The path of the table or file at an index; null if it is not of the library.
  const BasePath* find(lua_State* L, int index) const;

 private:
  const BasePath* path_at(const void* table) const;
  std::vector<std::pair<const void*, BasePath>> paths_;  // some twenty
};

// Whether a Lua function came with the program: the reduced library of scripts/sandbox.lua.
bool is_sandbox_function(lua_State* L, int index);

// Pushes what a state has under a path, nil if nothing. Raises on lack of memory.
void push_base(lua_State* L, const BasePath& path);

}  // namespace asperity::lua
