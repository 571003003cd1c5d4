// SPDX-License-Identifier: GPL-3.0-or-later
// Fields and methods of a table; methods shared with notebooks are in table_methods().
#include <limits>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/run/notebook.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/run/table_keys.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

// --- methods that notebooks have too

Values rows_where(Call& call) {
  static const OptionInfo info{
      .name = "where", .type = "table", .default_text = "", .range_text = "", .sentence = ""};
  TableFilter filter;
  Problems problems;
  read_filter(call.argument(1), info, filter, problems);
  if (!problems.empty())
    throw Error(ErrorCode::bad_value, joined(problems, "; "), "write it such as t:where{ N=8 }");
  const auto table = table_of_self(call);
  return {object(rows_of(*table, filter.rows(*table)))};
}

// Numbers with nan for an empty cell, or texts and booleans with "".
Values cells_of_column(Call& call) {
  const auto table = table_of_self(call);
  const std::size_t k = table->column(call.text(1, "column"), "column");
  bool numbers = true, whole = table->columns()[k].unit.empty();
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const Cell& cell = table->cell(row, k);
    numbers = numbers && (is_number(cell) || is_empty(cell));
    whole = whole && std::holds_alternative<std::int64_t>(cell);
  }
  if (numbers && !whole) {
    auto values = std::make_shared<Array<double>>();
    for (std::size_t row = 0; row < table->rows(); ++row)
      values->push_back(number_in(table->cell(row, k)).value_or(std::numeric_limits<double>::quiet_NaN()));
    return {Value::Numbers(std::move(values))};
  }
  List list;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    Value value = value_of(table->cell(row, k), table->columns()[k]);
    list.items.push_back(value.is_nil() ? Value("") : std::move(value));
  }
  return {std::move(list)};
}

const Block<Join>& join_block() {
  static const Block<Join> block{
      "joined",
      {custom<Join>("by", "string|string[]",
                    "the column, or columns, in which rows that belong together are equal",
                    [](const Argument& value, const OptionInfo& info, Join& join, Problems& problems) {
                      read_texts(value, info, join.by, problems);
                    })
           .required(),
       text("suffix", &Join::suffix,
            "behind the names of the other's columns that both tables have, such as \"_predicted\""),
       choice("unmatched", &Join::unmatched,
              {{"error", Unmatched::refuse}, {"leave out", Unmatched::leave_out}, {"keep", Unmatched::keep}},
              "what becomes of rows that find none in the other table: an error, nothing, or a row in which "
              "the other's cells are empty")}};
  return block;
}

Rows table_given(const Call& call, int k, const char* name) {
  const Argument value = call.argument(k);
  if (const auto* table = value.as<Rows>()) return *table;
  if (const auto* book = value.as<Notebook>()) return book->table();
  throw Error(ErrorCode::bad_value, quoted(name) + " is " + value.describe(), "give a table or a notebook");
}

Values join_tables(Call& call) {
  const Join join = call.options(join_block(), 2);
  return {object(joined(*table_of_self(call), table_given(call, 1, "other"), join))};
}

// --- files, and what else only a table has

Values write_table(Call& call) {
  const std::string name = call.text(1, "path");
  if (const std::string ending = file_extension(name); ending != "csv" && ending != "txt")
    throw Error(ErrorCode::bad_value, "a table is written as CSV, and the file is " + quoted(name),
                "give it a name such as \"angles.csv\"");
  const std::string path = writable_path(call, name);
  write_atomically(path, call.self<Rows>().csv());
  return {path};
}

Map units_of(const Rows& table) {
  Map units;
  for (const TableColumn& column : table.columns())
    if (!column.unit.empty()) units.items.emplace_back(column.name, column.unit);
  return units;
}

}  // namespace

std::vector<Function> table_methods() {
  return {
      {.name = "where",
       .body = rows_where,
       .sentence =
           "The rows in which these columns hold these values, as a table: numbers, strings, booleans, or "
           "lists of them, any of which may stand there. A quantity is counted in the unit of its column.",
       .parameters = {{"filter", "table", "values by the names of their columns"}},
       .returns = "Table",
       .example = "print(#book:where{ N={ 1, 2 } })",
       .unknown_when_dry = true},
      {.name = "column",
       .body = cells_of_column,
       .sentence = "The cells of a column as a list: numbers, nan where a cell is empty; or texts, \"\" "
                   "where one is.",
       .parameters = {{"column", "string", "its name"}},
       .returns = "any[]",
       .example = "local mu = book:column \"mu\"",
       .unknown_when_dry = true},
      {.name = "joined",
       .body = join_tables,
       .sentence = "Each row beside the rows of another table, or notebook, that are equal to it in the "
                   "columns `by`: as measured numbers stand beside computed ones.",
       .parameters = {{"other", "Table|Notebook", "the other table"}},
       .options = &join_block(),
       .returns = "Table",
       .example = "print(book:joined(lab.table.from{ { N=1, measured=0.42 } }, { by=\"N\", unmatched=\"leave "
                  "out\" }))",
       .unknown_when_dry = true},
  };
}

template <>
const Class& class_of<asperity::Table>() {
  static const Class type = [] {
    Class c;
    c.name = "Table";
    c.article_name = "a table of columns";
    c.sentence =
        "Rows under named columns with units, read from a file, made of rows or taken from a notebook; an "
        "immutable value whose methods return new ones. Its numbers are in SI; those of a notebook stay in "
        "the units of its columns.";
    c.describe = [](const void* self) { return table_text(*static_cast<const Rows*>(self)); };
    c.native_bytes = [](const void* self) {
      const auto& table = *static_cast<const Rows*>(self);
      return table.rows() * table.columns().size() * sizeof(Cell);
    };
    c.length = [](const void* self) {
      return static_cast<std::int64_t>(static_cast<const Rows*>(self)->rows());
    };
    c.equal = have_one_digest<Rows>;
    c.digest = text_of<&Rows::digest>;
    c.fields = {
        getter<Rows>("columns", "string[]", "the names of its columns, in order",
                     [](const Rows& of) { return text_list(of.column_names()); }),
        getter<Rows>("units", "table<string, string>", "the unit of each column that has one",
                     [](const Rows& of) { return units_of(of); }),
        getter<&Rows::name>("name", "string", "where it came from, as errors call it"),
        getter<&Rows::digest>("digest", "string",
                              "of columns, units and cells: equal tables have equal digests"),
    };
    c.methods = {
        {.name = "rows",
         .body = [](Call& call) -> Values { return {rows_of_table(call.self<Rows>())}; },
         .sentence = "All rows as tables, numbers in SI; an empty cell is nil.",
         .returns = "table[]",
         .example = "for _, row in ipairs(t:rows()) do print(row.N, row.mu) end"},
        {.name = "write",
         .body = write_table,
         .sentence = "Writes it as CSV, with units in the heads; lab.table.read gives it back to the bit.",
         .parameters = {{"path", "string", "a .csv under the run directory"}},
         .returns = "string",
         .example = "t:write \"angles.csv\"",
         .heavy = true},
    };
    for (auto* methods : {table_methods, table_analysis_methods})
      for (Function& method : methods()) c.methods.push_back(std::move(method));
    c.results = table_analysis_results();
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
