// SPDX-License-Identifier: GPL-3.0-or-later
// The Lua files of scripts/, built into the program so that it needs no files beside it. A script
// reaches those that are meant for it as `require "asperity.NAME"`.
#pragma once

#include <span>
#include <string_view>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

struct EmbeddedScript {
  std::string_view name;  // file name without .lua
  std::string_view text;
};

std::span<const EmbeddedScript> embedded_scripts();
// Those of scripts/lessons, by name; bindings/lua/editor/lessons.hpp knows what they say.
std::span<const EmbeddedScript> embedded_lessons();
// Empty if there is none of this name.
std::string_view embedded_script(std::string_view name);
// As luaL_loadbufferx, of a text that lives as long as the program, under the name `chunk` ("=sandbox"): it
// is compiled once, and every further state of this thread or another loads what came of it. Raises on an
// error.
void load_embedded_text(lua_State* L, std::string_view text, const char* chunk);
// Makes `require "asperity.NAME"` find every embedded script. Raises on lack of memory.
void preload_embedded_scripts(lua_State* L);

}  // namespace asperity::lua
