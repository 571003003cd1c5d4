// SPDX-License-Identifier: GPL-3.0-or-later
// Completion in an unfinished script: names, fields, missing keys, accepted words, units, materials,
// keywords, from the registry and the text (script_types.hpp). Runs no code. Linear in the length of the
// text; thread-safe.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/editor/script_types.hpp"

namespace asperity::lua {

struct Candidate {
  std::string text;
  // "module"; "method" (also functions); "key"; "value" (words, constants, fields); "keyword"; "global".
  std::string kind;
  std::string detail;  // signature, or type, unit, default
  std::string help;    // may be empty
};

struct Completion {
  std::size_t from = 0;  // of the replaced word, up to `position`
  std::vector<Candidate> candidates;
};

// `position` in bytes, clamped. Ignores case if nothing matches. `live`: globals of a prompt.
Completion complete(std::string_view text, std::size_t position, const std::vector<LiveGlobal>& live = {});

// Lua's names in the sandbox.
struct LuaName {
  std::string library;  // "math"; empty for a global
  std::string name;
  bool is_function;
};

// Sorted by library, then name. Thread-safe.
const std::vector<LuaName>& lua_names();

}  // namespace asperity::lua
