// SPDX-License-Identifier: GPL-3.0-or-later
// Records and iterators as Lua values. A record is read-only, names the nearest field in errors, prints with
// units, and supports pairs() in field order. `for ... in` calls an iterator; a script can close it early.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/core/cost.hpp"

namespace asperity::lua {

// Makes the metatables of results and iterators in a new state. Raises on lack of memory.
void open_results(lua_State* L);

const RecordType<Cost>& cost_type();
// "table<string, Cost>".
Record cost_by_effect(const std::vector<std::pair<std::string, Cost>>& costs);

}  // namespace asperity::lua
