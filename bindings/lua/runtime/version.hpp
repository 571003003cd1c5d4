// SPDX-License-Identifier: GPL-3.0-or-later
// Versions of the program and its libraries.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/files/json.hpp"

namespace asperity::lua {

std::string version_text();  // "0.2.0"
// Includes compiler, Lua, libraries and the vector instructions of the loaded numeric code.
std::vector<std::pair<std::string, std::string>> version_facts();
// For the manifest.
Json version_json();

}  // namespace asperity::lua
