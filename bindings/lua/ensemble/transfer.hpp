// SPDX-License-Identifier: GPL-3.0-or-later
// Packs a value of a Lua state for other states. Data are copied; immutable native values are shared; script
// functions are packed with code, upvalues, globals, and additions to Lua's own tables. Functions and tables
// of Lua's library and of the laboratory are found by name. Other values (coroutines, open files, iterators,
// mutable native values) are errors that name the path to the value.
#pragma once

#include <memory>
#include <string>

#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

enum class Cargo {
  data,       // nil, booleans, numbers, strings, plain tables of these, native values, results
  functions,  // also functions, metatables, and the globals
};

// Packs the value at an index; messages call it `name` and end with `hint`. Raises nothing and runs no Lua
// code. Cost: linear, any depth. Throws Error{not_permitted} for unpackable values, Error{out_of_memory}.
std::shared_ptr<const PackedValue> pack(lua_State* L, int index, Cargo cargo, const std::string& name,
                                        const std::string& hint);

}  // namespace asperity::lua
