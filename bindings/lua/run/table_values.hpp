// SPDX-License-Identifier: GPL-3.0-or-later
// Cells, rows and filters of scripts.
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

// Nothing for other values. Lua integers stay integers.
std::optional<Cell> cell_of(const Argument& value);
// Nil for an empty cell. A column with a unit gives floats, because squares may exceed the integer range.
Value value_of(const Cell& cell, const TableColumn& column);
// Without empty cells.
Map row_of(const Table& table, std::size_t row);
List rows_of_table(const Table& table);

// A row, sorted by column name. "Ra [um]" means column Ra with unit um. "3 um" is converted to the unit that
// `unit_of` returns for the column, or to SI. Cells unknown in a dry run are skipped. Throws Error{bad_value}
// with the hint `example` if the value is no row, and Error{bad_unit} for another dimension than the
// column's.
std::vector<Entry> entries_of(const Argument& row, bool dry, const std::string& example,
                              const std::function<std::string(const std::string& column)>& unit_of);

// { N=1, D={2, 2.5} }: rows whose columns have these values.
void read_filter(const Argument& value, const OptionInfo& info, TableFilter& filter, Problems& problems);
template <class O>
Option<O> where_key(TableFilter O::*member) {
  return custom<O>("where", "table", "only rows in which these columns hold these values",
                   [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                     read_filter(value, info, options.*member, problems);
                   });
}

// The table, or the notebook's present rows.
std::shared_ptr<const Table> table_of_self(const Call& call);

}  // namespace asperity::lua
