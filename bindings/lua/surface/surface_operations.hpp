// SPDX-License-Identifier: GPL-3.0-or-later
// The methods of a surface that make other surfaces and profiles of it.
#pragma once

#include <vector>

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

std::vector<Function> surface_operations();
// a + b, a - b, -a, 2 * a, a / 2.
std::vector<Operator> surface_operators();

}  // namespace asperity::lua
