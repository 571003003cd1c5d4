// SPDX-License-Identifier: GPL-3.0-or-later
// lab.quantity: a quantity with its unit as a number in SI.
#pragma once

#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

Function quantity_function();

}  // namespace asperity::lua
