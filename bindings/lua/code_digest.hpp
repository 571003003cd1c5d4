// SPDX-License-Identifier: GPL-3.0-or-later
// What a function of a script does, as a digest: its code as Lua 5.4 dumps it, less the names of files, lines
// and local variables, so that an edit elsewhere in the script does not change it.
#pragma once

#include <string>
#include <string_view>

namespace asperity::lua {

// Of a dump that lua_dump made. A dump that is not understood to its last byte is digested as it is.
std::string code_digest(std::string_view dump);

}  // namespace asperity::lua
