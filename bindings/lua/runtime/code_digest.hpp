// SPDX-License-Identifier: GPL-3.0-or-later
// What a function of a script does, as a digest: its code as Lua 5.4 dumps it, less the names of files, lines
// and local variables, so that an edit elsewhere in the script does not change it.
#pragma once

#include <string>
#include <string_view>

namespace asperity::lua {

// Of a dump that lua_dump made; with the numbers of its lines if they are `counted`, never with the names of
// files. A dump that is not understood to its last byte is digested as it is.
enum class CodeLines { left_out, counted };
std::string code_digest(std::string_view dump, CodeLines lines = CodeLines::left_out);

}  // namespace asperity::lua
