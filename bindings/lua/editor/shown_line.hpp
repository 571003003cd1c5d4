// SPDX-License-Identifier: GPL-3.0-or-later
// A Lua value as a prompt shows it: on one line, tables with what they hold as far as it fits, results with
// their units, native values as they describe themselves. What describes itself as a text of several lines
// (a ledger, a plan) is shown so.
#pragma once

#include <string>

#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/quantity.hpp"

namespace asperity::lua {

// Never raises; what cannot be shown says why.
std::string shown_line(lua_State* L, int index);
// A number with its unit, readable and as it is: "814.7 pm (8.147e-10 m)".
std::string shown_quantity(double value, Dimension dimension);

}  // namespace asperity::lua
