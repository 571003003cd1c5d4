// SPDX-License-Identifier: GPL-3.0-or-later
// Cells, rows and filters between scripts and tables, for notebooks and tables alike.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_filter.hpp"

namespace asperity::lua {

// A number, a boolean or a text; nothing for any other value. Lua's integers stay whole.
std::optional<Cell> cell_of(const Argument& value);
// What a script gets of a cell: nil for an empty one. Whole numbers stay integers but in a column with a
// unit, where the square of one may be beyond any integer.
Value value_of(const Cell& cell, const TableColumn& column);
// One row under the names of its columns, without its empty cells.
Map row_of(const Table& table, std::size_t row);
// All of them: what rows() gives.
List rows_of_table(const Table& table);

// A row that a script gives, its columns in the order of their names, for Lua keeps none. "Ra [um]" is the
// column Ra with the unit um. "3 um" is a number and kept in the unit of its column, which `unit_of` tells of
// those that are there, in SI where that has none. Cells that a dry run does not know are left out. Throws
// Error{bad_value} for what is no row, with `example` for a hint, and Error{bad_unit} for a quantity of
// another kind than the column's.
std::vector<Entry> entries_of(const Argument& row, bool dry, const std::string& example,
                              const std::function<std::string(const std::string& column)>& unit_of);

// { N=1, D={2, 2.5} }: the rows in which these columns hold these values.
void read_filter(const Argument& value, const OptionInfo& info, TableFilter& filter, Problems& problems);
template <class O>
Option<O> where_key(TableFilter O::*member) {
  return custom<O>("where", "table", "only rows in which these columns hold these values",
                   [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                     read_filter(value, info, options.*member, problems);
                   });
}

// The table that a method was called on: a Table, or the rows of a Notebook as they are now.
std::shared_ptr<const Table> table_of_self(const Call& call);

}  // namespace asperity::lua
