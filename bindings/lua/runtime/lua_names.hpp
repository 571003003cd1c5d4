// SPDX-License-Identifier: GPL-3.0-or-later
// Globals and library functions of Lua that the sandbox leaves to a script.
#pragma once

#include <string>
#include <vector>

namespace asperity::lua {

struct LuaName {
  std::string library;  // "math"; empty for a global
  std::string name;
  bool is_function;
};

// Sorted by library, then name. Thread-safe.
const std::vector<LuaName>& lua_names();

}  // namespace asperity::lua
