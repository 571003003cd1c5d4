// SPDX-License-Identifier: GPL-3.0-or-later
// Packs a Lua value for other states. Data are copied; immutable native values are shared; functions include
// code, upvalues, globals, and additions to Lua's own tables. Lua's library and the laboratory are found by
// name. Other values (coroutines, open files, iterators, mutable native values) are errors with their path.
#pragma once

#include <memory>
#include <string>

#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

enum class Cargo {
  data,       // nil, booleans, numbers, strings, plain tables, native values, results
  functions,  // also functions, metatables, globals
};

// Messages call the value `name` and end with `hint`. Raises nothing and runs no Lua code. Linear, any depth.
// Throws Error{not_permitted}, Error{out_of_memory}.
std::shared_ptr<const PackedValue> pack(lua_State* L, int index, Cargo cargo, const std::string& name,
                                        const std::string& hint);

}  // namespace asperity::lua
