// SPDX-License-Identifier: GPL-3.0-or-later
// Taking a value out of a Lua state, to be put into another. Data travels by copy, immutable native
// values are shared, and functions of the script travel with everything they reach: their code, their
// upvalues, the globals, and what the script added to Lua's own tables. Functions and tables of Lua's
// library and of the laboratory are found again by name. What cannot travel (a coroutine, an open
// file, an iterator, a native value that changes) is an error that says how the function reaches it.
#pragma once

#include <memory>
#include <string>

#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

enum class Cargo {
  data,       // nil, booleans, numbers, strings, plain tables of these, native values, results
  functions,  // these, functions and metatables, and the globals with them
};

// Packs the value at an index, which the messages call `name`; `hint` ends them. Reads without raising
// and runs no Lua code. Cost: linear in what is reached, with no limit on depth. Throws
// Error{not_permitted} for what cannot travel, Error{out_of_memory}.
std::shared_ptr<const PackedValue> pack(lua_State* L, int index, Cargo cargo, const std::string& name,
                                        const std::string& hint);

}  // namespace asperity::lua
