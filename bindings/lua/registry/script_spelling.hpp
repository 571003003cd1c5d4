// SPDX-License-Identifier: GPL-3.0-or-later
// The script's name on the command line. Results must not depend on it.
#pragma once

#include <string>

namespace asperity::lua {

struct ScriptSpelling {
  std::string path;
  std::string folder;  // search folder of `require`: "."; "" without a script
};

}  // namespace asperity::lua
