// SPDX-License-Identifier: GPL-3.0-or-later
// Cells, rows and filters of scripts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/run/expectation.hpp"
#include "engine/statistics/table.hpp"
#include "engine/statistics/table_form.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

// Nothing for other values. Integers stay integers.
std::optional<Cell> cell_of(const Argument& value);
// Nil for an empty cell. Floats under a unit: squares may exceed the integer range.
Value value_of(const Cell& cell, const TableColumn& column);
// Without empty cells; numbers in SI.
Map row_of(const Table& table, std::size_t row);
List rows_of_table(const Table& table);

// Row k from 1; nil beyond the ends.
Value row_value(const Table& table, std::int64_t k);

// A row, sorted by column name, with quantities such as "3 um" in SI. Cells unknown in a dry run are skipped.
// Throws Error{bad_value} with the hint `example` if the value is no row, and Error{bad_unit} for a quantity
// of another dimension than the unit in its column's name. Warns of unknown units in names.
std::vector<Entry> entries_of(const Call& call, const Argument& row, const std::string& example);

// A list of records or of tables, without cells other than numbers, strings and booleans. Throws
// Error{bad_value} for other values and without a row.
Table table_of_rows(const Call& call, const Argument& rows);

// "3 um" becomes a number in the unit of the column's name, or in SI with a display unit. Throws
// Error{bad_unit} for another dimension.
void read_quantity(Entry& entry, const TableColumn& column);

// Throws Error{bad_unit} for "5" in a column with a unit.
void refuse_numbers_without_unit(const std::vector<Entry>& row, const Table& table);

// { N=1, D={2, 2.5} }: rows whose columns have these values.
void read_filter(const Argument& value, const OptionInfo& info, TableFilter& filter, Problems& problems);
template <class O>
Option<O> where_key(TableFilter O::*member) {
  return custom("where", "table", "only rows in which these columns hold these values", member, read_filter);
}

// Keys for lab.table.read and lab.protocol.read.

// For structs that extend TableForm.
const std::vector<Option<TableForm>>& table_form_keys();

// { load="Wert" }, sorted by key.
void read_pairs(const Argument& value, const OptionInfo& info,
                std::vector<std::pair<std::string, std::string>>& pairs, const char* wanted,
                Problems& problems);
void read_texts(const Argument& value, const OptionInfo& info, std::vector<std::string>& texts,
                Problems& problems);
template <class O, class M>
Option<O> texts_key(const char* name, const char* type, const char* sentence, M O::*member) {
  return custom(name, type, sentence, member, read_texts);
}

// A number or a quantity.
void read_expected(const Argument& value, const std::string& name, std::optional<ExpectedValue>& expected,
                   Problems& problems);

}  // namespace asperity::lua
