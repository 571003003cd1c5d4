// SPDX-License-Identifier: GPL-3.0-or-later
// Names of Lua's own library values (`math`, `math.random`, `io.stdout`, the globals), to find them in
// another state. C functions without upvalues are the same pointer in every state.
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

// In a fresh Lua; null if not Lua's own. Thread-safe.
const BasePath* base_function(lua_CFunction function);

// One state's library. Reads without raising.
class BaseLibrary {
 public:
  explicit BaseLibrary(lua_State* L);
  // Null if outside the library.
  const BasePath* find(lua_State* L, int index) const;

 private:
  const BasePath* path_at(const void* table) const;
  std::vector<std::pair<const void*, BasePath>> paths_;
};

// From scripts/sandbox.lua.
bool is_sandbox_function(lua_State* L, int index);

// Pushes nil if absent. Raises on lack of memory.
void push_base(lua_State* L, const BasePath& path);

}  // namespace asperity::lua
