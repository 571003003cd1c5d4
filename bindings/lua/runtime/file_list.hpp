// SPDX-License-Identifier: GPL-3.0-or-later
// lab.files: the files of a folder whose names match a pattern.
#pragma once

#include <string_view>

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

Function files_function();

// Whether a name matches a pattern in which * stands for any characters and ? for one. O(name × pattern).
bool matches_pattern(std::string_view name, std::string_view pattern);

}  // namespace asperity::lua
