// SPDX-License-Identifier: GPL-3.0-or-later
// The Lua files of scripts/, compiled in; `require "asperity.NAME"` loads the public ones.
#pragma once

#include <span>
#include <string_view>

#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

struct EmbeddedScript {
  std::string_view name;  // without ending
  std::string_view text;
};

std::span<const EmbeddedScript> embedded_scripts();
std::span<const EmbeddedScript> embedded_lessons();
std::span<const EmbeddedScript> embedded_lesson_texts();  // "de/06_tilt"
std::string_view embedded_script(std::string_view name);
// As luaL_loadbufferx named `chunk` ("=sandbox"). `text` must live as long as the program; states and threads
// share the compiled code. Raises on an error.
void load_embedded_text(lua_State* L, std::string_view text, const char* chunk);
// For lua_dump; `code` is a std::string.
int append_code(lua_State* L, const void* bytes, std::size_t size, void* code);
// For `require`. Raises on lack of memory.
void preload_embedded_scripts(lua_State* L);

}  // namespace asperity::lua
