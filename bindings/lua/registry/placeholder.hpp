// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a dry run. A skipped call returns an object of the declared class, so that fields and methods are
// still checked by name, or an unknown number, which arithmetic passes on. If the script's path depends on
// it, the dry run stops with `cannot_follow`.
#pragma once

#include <string>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

void push_unknown(lua_State* L);
// For a declared type ("Surface", "number", "Profile[]", "Roughness", "Profile[] with lines: Traverse[]").
Value placeholder_of(const std::string& type);

// Searches tables to `depth` levels.
bool holds_unknown(const Argument& value, int depth);

// Prefix of the message that ends a dry run.
inline constexpr const char* cannot_follow =
    "the script's path depends on a result that is not known before the run";

bool stopped_at_placeholder(const std::string& message);
// Lua's complaint about nil; after a placeholder, the real result may have more parts.
bool met_nothing(const std::string& message);
// Line number of "script.lua:12: …"; "?" if none.
std::string line_of(const std::string& message);
// The message after the place, to the end of the line.
std::string without_place(const std::string& message);

// Replaces functions that fail on placeholders. Raises on lack of memory.
void open_dry_run_library(lua_State* L);

}  // namespace asperity::lua
