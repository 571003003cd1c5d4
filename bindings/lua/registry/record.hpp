// SPDX-License-Identifier: GPL-3.0-or-later
// Records and iterators as Lua values. A record is read-only, complains about a field it does not
// have with the nearest name, prints itself with units, and goes through pairs() in order. An
// iterator is what `for ... in` calls; it can be closed early.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/core/cost.hpp"

namespace asperity::lua {

// Raise on lack of memory: call inside protect().
void push_record(lua_State* L, const std::shared_ptr<Record>& record);
void push_iterator(lua_State* L, const std::shared_ptr<Iterator>& iterator);

const RecordType<Cost>& cost_type();
// A record of one cost an effect, "table<string, Cost>".
Record cost_by_effect(const std::vector<std::pair<std::string, Cost>>& costs);

// The record at an index, or null.
std::shared_ptr<Record> record_at(lua_State* L, int index);

}  // namespace asperity::lua
