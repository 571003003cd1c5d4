// SPDX-License-Identifier: GPL-3.0-or-later
// lab.table: constructors of tables.
#include <optional>
#include <utility>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/run/table_keys.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/files/text_encoding.hpp"
#include "engine/statistics/table_operations.hpp"
#include "engine/statistics/table_reader.hpp"
#include "engine/surface/io/foreign_format.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

struct FromKeys {
  std::vector<std::string> columns;
};

const Block<FromKeys>& from_block() {
  static const Block<FromKeys> block{
      "from",
      {custom<FromKeys>("columns", "string[]", "the names of columns in the order in which they stand",
                        [](const Argument& value, const OptionInfo& info, FromKeys& keys,
                           Problems& problems) { read_texts(value, info, keys.columns, problems); })
           .defaults_to("in the order of their names, as rows bring them")}};
  return block;
}

struct ReadKeys : TableForm {};

const Block<ReadKeys>& read_table_block() {
  static const Block<ReadKeys> block = [] {
    std::vector<Option<ReadKeys>> keys(table_form_keys().begin(), table_form_keys().end());
    keys.push_back(custom<TableForm>(
        "text", "string|string[]", "columns that hold texts, whatever their cells look like",
        [](const Argument& value, const OptionInfo& info, TableForm& form, Problems& problems) {
          read_texts(value, info, form.texts, problems);
        }));
    keys.push_back(choice("stamps", &TableForm::stamps_since_1970, {{"first", false}, {"1970", true}},
                          "what dates and times of day are counted from, in seconds: the first one of their "
                          "column, or the beginning of 1970"));
    keys.push_back(choice("steps_back", &TableForm::steps_back,
                          {{"midnight", StepsBack::midnight}, {"winter time", StepsBack::winter_time}},
                          "meaning of times that step back: a new day if times of day fall by more than half "
                          "a day, or an hour if dates without a zone fall by about an hour")
                       .defaults_to("nothing"));
    return Block<ReadKeys>("read", std::move(keys));
  }();
  return block;
}

Values read_table_file(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const TableForm form = call.options(read_table_block(), 2);
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
    throw Error(ErrorCode::bad_value, "`rows` is " + rows.describe(),
                "give a list of rows, as in lab.table.from{ { N=1, mu=0.4 } }");
  const FromKeys keys = call.options(from_block(), 2);
  Rows table;
  table.rename("the table");
  for (const std::string& column : keys.columns) table.declare_column(column);
  const bool dry = call.session().dry_run;
  for (std::int64_t k = 1; k <= rows.length(); ++k)
    rows.element(k, [&](const Argument& row) {
      std::vector<Entry> entries =
          entries_of(row, dry, "write lab.table.from{ { N=1, mu=0.4 } }", [&](const std::string& column) {
            const auto place = table.find_column(column);
            return place ? table.columns()[*place].unit : std::string();
          });
      table.append(entries);
    });
  if (table.columns().empty())
    throw Error(ErrorCode::bad_value, "`rows` holds no row", "give at least one, as in { { N=1, mu=0.4 } }");
  return {object(in_si(table))};
}

}  // namespace

const Module& table_module() {
  static const Module module = [] {
    Module m;
    m.path = "lab.table";
    m.sentence = "Tables of measured or computed numbers under named columns with units.";
    m.functions = {
        {.name = "read",
         .body = read_table_file,
         .sentence =
             "A table that a logger or a spreadsheet wrote as text (UTF-8, UTF-16, Windows-1252): a line of "
             "heads, then rows, parted by commas, semicolons, tabs or blanks, with decimal points or commas. "
             "Units stand in the heads, load [N], load (N), load / N, or in the line below, or in the cells; "
             "numbers with a unit come in SI. Dates and times of day become seconds, ISO 8601 and local "
             "forms; columns of words are texts. An ambiguous value is an error with the key to give.",
         .parameters = {{"path", "string", "the file"}},
         .options = &read_table_block(),
         .options_optional = true,
         .returns = "Table",
         .example = "local t = lab.table.read(\"mu.csv\", { unit={ force=\"N\" } })",
         .heavy = true},
        {.name = "from",
         .body = table_from,
         .sentence = "A table of rows that a script has. A column may carry its unit in its name, and a cell "
                     "may be a quantity.",
         .parameters = {{"rows", "table[]", "rows, each a table of columns and their values"}},
         .options = &from_block(),
         .options_optional = true,
         .returns = "Table",
         .example =
             "print(lab.table.from({ { N=1, mu=0.42 }, { N=2, mu=0.44 } }, { columns={ \"N\", \"mu\" } }))"},
    };
    return m;
  }();
  return module;
}

}  // namespace asperity::lua
