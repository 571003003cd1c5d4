// SPDX-License-Identifier: GPL-3.0-or-later
// `lab` as scripts see it. Each module is an empty, read-only table whose metatable finds members. Unknown
// names are errors with the nearest name.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

// Raises on lack of memory: call inside protect().
void push_function(lua_State* L, const Function& function);
// A C function with the address of a class: makes its metatable (native_class.cpp).
int make_class_metatable(lua_State* L);

const Module* module_at(lua_State* L, int index);
void push_proxy(lua_State* L, const Module& module);

// Same order in every process (fixed_order.cpp): numbers, strings by bytes, booleans, other keys in Lua's
// order, which a dry run notes. A loop visits the keys present at its beginning and not removed since. Both
// are C functions without upvalues.
int ordered_pairs(lua_State* L);
int ordered_next(lua_State* L);
// The iterator function for the table at an index. Raises.
void push_ordered_loop(lua_State* L, int index);

// Raises like any luaopen function.
void push_library(lua_State* L);

}  // namespace asperity::lua
