// SPDX-License-Identifier: GPL-3.0-or-later
// Digest of a script function: its code as dumped by Lua 5.4, without names of files, line numbers and local
// variables. Edits elsewhere in the script do not change the digest.
#pragma once

#include <string>
#include <string_view>

namespace asperity::lua {

// Digest of a lua_dump dump. `counted` includes line numbers, never file names. A dump that cannot be parsed
// to its last byte is digested unchanged.
enum class CodeLines { left_out, counted };
std::string code_digest(std::string_view dump, CodeLines lines = CodeLines::left_out);

}  // namespace asperity::lua
