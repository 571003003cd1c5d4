// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a dry run. A call that is not made gives a placeholder: of a class, so that fields
// and methods are still checked by name, or of an unknown number, which arithmetic passes on. A
// script whose path depends on one cannot be followed further; it stops there with the message
// `asperity check` knows.
#pragma once

#include <string>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

// Raises on lack of memory: call inside protect().
void push_unknown(lua_State* L);
// The placeholder for a result of this declared type ("Surface", "number", "Profile[]", "Roughness",
// "Profile[] with lines: Traverse[]", …).
Value placeholder_of(const std::string& type);

// Whether a value is a placeholder, or a table that holds one within `depth` levels.
bool holds_unknown(const Argument& value, int depth);

// Begins the message of a dry run that cannot follow the script further.
inline constexpr const char* cannot_follow =
    "the script's path depends on a result that is not known before the run";

// Whether an error message is that of a dry run that met a placeholder where it needed a value.
bool stopped_at_placeholder(const std::string& message);
// Whether it is Lua's own complaint about nil, which after a placeholder may only mean that a result has
// more parts than its placeholder.
bool met_nothing(const std::string& message);
// The line number of "script.lua:12: …", "?" if there is none.
std::string line_of(const std::string& message);
// What follows that place, to the end of the line.
std::string without_place(const std::string& message);

// Replaces the parts of Lua's library that would trip over placeholders. Raises on lack of memory.
void open_dry_run_library(lua_State* L);

}  // namespace asperity::lua
