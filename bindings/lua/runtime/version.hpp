// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/files/json.hpp"

namespace asperity::lua {

std::string version_text();  // "0.2.0"
// Compiler, Lua, libraries and the loaded vector instructions included.
std::vector<std::pair<std::string, std::string>> version_facts();
// For the manifest.
Json version_json();

}  // namespace asperity::lua
