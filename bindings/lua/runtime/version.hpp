// SPDX-License-Identifier: GPL-3.0-or-later
// The version of the program and of what it is built on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/files/json.hpp"

namespace asperity::lua {

std::string version_text();  // "0.2.0"
// Name and version of the program, its compiler, Lua and the libraries it was built with; and the vectors of
// the numeric code that was loaded, which our own transforms use.
std::vector<std::pair<std::string, std::string>> version_facts();
// For the manifest.
Json version_json();

}  // namespace asperity::lua
