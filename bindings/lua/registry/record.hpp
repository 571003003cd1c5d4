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

void push_record(lua_State* L, const std::shared_ptr<Record>& record);
void push_iterator(lua_State* L, const std::shared_ptr<Iterator>& iterator);

const RecordType<Cost>& cost_type();
// "table<string, Cost>".
Record cost_by_effect(const std::vector<std::pair<std::string, Cost>>& costs);

std::shared_ptr<Record> record_at(lua_State* L, int index);

}  // namespace asperity::lua
