// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <optional>
#include <utility>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/files/text_encoding.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/table_operations.hpp"
#include "engine/statistics/table_reader.hpp"
#include "engine/surface/io/foreign_format.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

Values rows_where(Call& call) {
  static const OptionInfo info{"where", "table", {}, "", "", ""};
  TableFilter filter;
  Problems problems;
  read_filter(call.argument(1), info, filter, problems);
  if (!problems.empty()) refuse(joined(problems, "; "), "write it such as t:where{ N=8 }");
  const auto table = table_of_self(call);
  const std::vector<std::size_t> rows = filter.rows(*table);
  if (rows.empty() && table->rows() > 0)
    call.session().monitor().warn("no row of " + table->name() + " has " + filter.text() +
                                  "; numbers are in SI, or in the unit of the column's name");
  return {object(rows_of(*table, rows))};
}

// Numbers with nan, or texts and booleans with "", for empty cells.
Values cells_of_column(Call& call) {
  const auto table = table_of_self(call);
  const std::size_t k = table->column(call.text(1, "column"), "column");
  bool numbers = true, whole = table->columns()[k].unit.empty();
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const Cell& cell = table->cell(row, k);
    numbers = numbers && (is_number(cell) || is_empty(cell));
    whole = whole && std::holds_alternative<std::int64_t>(cell);
  }
  List list;
  if (numbers) list.unit = table->columns()[k].unit;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const Cell& cell = table->cell(row, k);
    if (numbers && !whole) {
      list.items.emplace_back(number_in(cell).value_or(std::numeric_limits<double>::quiet_NaN()));
      continue;
    }
    Value value = value_of(cell, table->columns()[k]);
    list.items.push_back(value.is_nil() ? Value("") : std::move(value));
  }
  return {std::move(list)};
}

const Block<Join> join_block{
    {texts_key("by", "string|string[]",
               "the column, or columns, in which rows that belong together are equal", &Join::by)
         .required(),
     text("suffix", &Join::suffix,
          "behind the names of the other's columns that both tables have, such as \"_predicted\""),
     choice("unmatched", &Join::unmatched,
            {{"error", Unmatched::refuse}, {"leave out", Unmatched::leave_out}, {"keep", Unmatched::keep}},
            "rows without a partner in the other table: an error, nothing, or a row with empty cells for the "
            "other")}};

Rows table_given(const Call& call, int k, const char* name) {
  const Argument value = call.argument(k);
  if (const auto* table = value.as<Rows>()) return *table;
  if (const auto* book = value.as<Notebook>()) return book->table();
  if (value.is_table()) return table_of_rows(call, value);
  refuse(quoted(name) + " is " + value.describe(), "give a table or a notebook");
}

Map units_of(const Rows& table) {
  Map units;
  for (const TableColumn& column : table.columns())
    if (!column.unit.empty()) units.items.emplace_back(column.name, column.unit);
  return units;
}

struct FromKeys {
  std::vector<std::string> columns;
};

const Block<FromKeys> from_block{
    {texts_key("columns", "string[]", "the names of columns in the order in which they stand",
               &FromKeys::columns)
         .defaults_to("in the order of their names, as rows bring them")}};

struct ReadKeys : TableForm {};

const Block<ReadKeys> read_table_block = [] {
  std::vector<Option<ReadKeys>> keys(table_form_keys().begin(), table_form_keys().end());
  append(keys,
         texts_key("text", "string|string[]", "columns that hold texts, whatever their cells look like",
                   &TableForm::texts),
         choice("stamps", &TableForm::stamps_since_1970, {{"first", false}, {"1970", true}},
                "origin of dates and times of day, in seconds: the first one of the column, or the beginning "
                "of 1970"),
         choice("steps_back", &TableForm::steps_back,
                {{"midnight", StepsBack::midnight}, {"winter time", StepsBack::winter_time}},
                "meaning of times that step back: a new day if times of day fall by more than half a "
                "day, or an hour if dates without a zone fall by about an hour")
             .defaults_to("nothing"));
  return Block<ReadKeys>(std::move(keys));
}();

Values read_table_file(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const TableForm form = call.options(read_table_block, 2);
  Monitor& monitor = call.session().monitor();
  const SourceFile file(path, monitor);
  note_input(call, path);
  if (!utf8_of_utf16(file.bytes().substr(0, 64)))
    if (const std::optional<ForeignFormat> foreign = foreign_format(file))
      refuse_file(file, "is not text that can be read: it is " + foreign->what, foreign->cure);
  return {object(read_measured_table(file, form, monitor))};
}

Values table_from(Call& call) {
  const Argument rows = call.argument(1);
  if (!rows.is_table())
    refuse("`rows` is " + rows.describe(), "give a list of rows, as in lab.table.from{ { N=1, mu=0.4 } }");
  const FromKeys keys = call.options(from_block, 2);
  Rows table;
  table.rename("the table");
  for (const std::string& column : keys.columns) {
    const auto [name, unit, mean_of, plain] = split_column_unit(column);
    table.declare_column(name);
    if (!unit.empty()) table.declare_unit(name, unit);
  }
  rows.elements([&](const Argument& row) {
    table.append(entries_of(call, row, "write lab.table.from{ { N=1, mu=0.4 } }"));
  });
  if (table.columns().empty()) refuse("`rows` holds no row", "give at least one, as in { { N=1, mu=0.4 } }");
  return {object(table)};
}

}  // namespace

std::vector<Function> table_methods() {
  std::vector<Function> methods = row_methods();
  const std::vector<Function> others = {
      {.name = "where",
       .body = rows_where,
       .sentence = "A table of the rows whose columns hold these values. A value is a number, a string, a "
                   "boolean, or a list of alternatives. A number is in SI, or in the unit of the column's "
                   "name; a quantity such as \"10 MPa\" has its own.",
       .parameters = {{"filter", "table", "values by the names of their columns"}},
       .returns = "Table",
       .example = "print(#book:where{ N={ 1, 2 } })",
       .unknown_when_dry = true},
      {.name = "column",
       .body = cells_of_column,
       .sentence = "The cells of a column as a list: numbers in SI, nan where a cell is empty; or texts, "
                   "\"\" where one is. print shows the numbers in the column's unit.",
       .parameters = {{"column", "string", "its name"}},
       .returns = "any[]",
       .example = "local mu = book:column \"mu\"",
       .unknown_when_dry = true},
      {.name = "joined",
       .body = [](Call& call) -> Values {
         const Join join = call.options(join_block, 2);
         return {object(joined(*table_of_self(call), table_given(call, 1, "other"), join))};
       },
       .sentence = "Joins each row to the rows of another table or notebook with equal values in the columns "
                   "`by`: for example, measured numbers to computed ones.",
       .parameters = {{"other", "Table|Notebook", "the other table"}},
       .options = &join_block,
       .returns = "Table",
       .example = "print(book:joined(lab.table.from{ { N=1, measured=0.42 } }, { by=\"N\", unmatched=\"leave "
                  "out\" }))",
       .unknown_when_dry = true},
      mean_method(),
      fit_method(),
      histogram_method(),
      chart_method(),
      show_method(),
  };
  methods.insert(methods.end(), others.begin(), others.end());
  return methods;
}

std::vector<const RecordInfo*> table_results() { return {&histogram_type()}; }

Class make_class(For<asperity::Table>) {
  Class c{"Table", "a table of columns",
          "Rows under named columns with units, read from a file, made of rows or taken from a notebook; an "
          "immutable value whose methods return new ones. Its numbers are in SI; print, files and charts "
          "show them in the units of the columns."};
  c.describe = [](const void* self) { return table_text(*static_cast<const Rows*>(self)); };
  c.native_bytes = from_value([](const Rows& of) { return of.rows() * of.columns().size() * sizeof(Cell); });
  c.length = from_value([](const Rows& of) { return static_cast<std::int64_t>(of.rows()); });
  c.equal = have_one_digest<Rows>;
  c.digest = text_of<&Rows::digest>;
  c.fields = {
      getter<Rows>("columns", "string[]", "the names of its columns, in order",
                   [](const Rows& of) { return of.column_names(); }),
      getter<Rows>("units", "table<string, string>", "the display unit of each column that has one",
                   [](const Rows& of) { return units_of(of); }),
      getter<&Rows::name>("name", "string", "where it came from, as errors call it"),
      getter<&Rows::digest>("digest", "string",
                            "of columns, units and cells: equal tables have equal digests"),
  };
  c.item = [](const void* self, std::int64_t k) { return row_value(*static_cast<const Rows*>(self), k); };
  c.methods = table_methods();
  c.results = table_results();
  return c;
}

Module table_module() {
  Module m{"lab.table", "Tables of measured or computed numbers under named columns with units."};
  m.functions = {
      {.name = "read",
       .body = read_table_file,
       .sentence =
           "A table that a logger or a spreadsheet wrote as text (UTF-8, UTF-16, Windows-1252): a line of "
           "heads, then rows, parted by commas, semicolons, tabs or blanks, with decimal points or commas. "
           "Units stand in the heads, load [N], load (N), load / N, or in the line below, or in the cells; "
           "numbers with a unit come in SI. Dates and times of day become seconds, ISO 8601 and local forms; "
           "columns of words are texts. An ambiguous value is an error with the key to give.",
       .parameters = {{"path", "string", "the file"}},
       .options = optional(read_table_block),
       .returns = "Table",
       .example = "local t = lab.table.read(\"mu.csv\", { unit={ force=\"N\" } })",
       .heavy = true},
      {.name = "from",
       .body = table_from,
       .sentence = "A table of rows that a script has. A column may carry its unit in its name, and a cell "
                   "may be a quantity.",
       .parameters = {{"rows", "table[]", "rows, each a table of columns and their values"}},
       .options = optional(from_block),
       .returns = "Table",
       .example =
           "print(lab.table.from({ { N=1, mu=0.42 }, { N=2, mu=0.44 } }, { columns={ \"N\", \"mu\" } }))"},
  };
  return m;
}

}  // namespace asperity::lua
