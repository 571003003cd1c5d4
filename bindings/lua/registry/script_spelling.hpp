// SPDX-License-Identifier: GPL-3.0-or-later
// How a script was named on the command line. Nothing that its functions do depends on it: what they find
// beside the script is known by content.
#pragma once

#include <string>

namespace asperity::lua {

struct ScriptSpelling {
  std::string path;    // "ens.lua", "/home/me/ens.lua"
  std::string folder;  // where `require` looks: "."; "" for a state without a script
};

}  // namespace asperity::lua
