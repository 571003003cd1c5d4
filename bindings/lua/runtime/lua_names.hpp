// SPDX-License-Identifier: GPL-3.0-or-later
// What a script has of Lua's own: the globals and the functions of its libraries as the sandbox leaves them.
#pragma once

#include <string>
#include <vector>

namespace asperity::lua {

struct LuaName {
  std::string library;  // "math"; empty for a global
  std::string name;
  bool is_function;
};

// In the order of the alphabet, by library. Made once, from a state of its own. Thread-safe.
const std::vector<LuaName>& lua_names();

}  // namespace asperity::lua
