// SPDX-License-Identifier: GPL-3.0-or-later
// lab.table: tables of measured or computed numbers, read from files, made of rows or taken from notebooks.
// An immutable value whose methods return new ones. Methods that notebooks have too are in table_methods();
// they take their table by table_of_self (table_values.hpp).
#pragma once

#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "engine/statistics/table.hpp"

namespace asperity::lua {

template <>
const Class& class_of<asperity::Table>();

const Module& table_module();

// Methods of tables and of notebooks: those that choose and join rows.
std::vector<Function> table_methods();

}  // namespace asperity::lua
