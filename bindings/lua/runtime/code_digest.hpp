// SPDX-License-Identifier: GPL-3.0-or-later
// Digest of a script function: its Lua 5.4 dump without file names, line numbers and local variables: other
// edits of the script do not matter.
#pragma once

#include <string>
#include <string_view>

namespace asperity::lua {

// Takes a dump of lua_dump; `counted` includes line numbers. An unreadable dump is digested unchanged.
enum class CodeLines { left_out, counted };
std::string code_digest(std::string_view dump, CodeLines lines = CodeLines::left_out);

}  // namespace asperity::lua
