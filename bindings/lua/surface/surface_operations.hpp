// SPDX-License-Identifier: GPL-3.0-or-later
// The methods of a surface that make other surfaces and profiles of it.
#pragma once

#include <vector>

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

std::vector<Function> surface_operations();

}  // namespace asperity::lua
