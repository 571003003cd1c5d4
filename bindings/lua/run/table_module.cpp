// SPDX-License-Identifier: GPL-3.0-or-later
// lab.table: how tables come to be.
#include <algorithm>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

struct FromKeys {
  std::vector<std::string> columns;
};

void read_columns(const Argument& value, const OptionInfo& info, std::vector<std::string>& columns,
                  Problems& problems) {
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(value, info, "a list of names", problems);
  for (std::int64_t k = 1; k <= value.length(); ++k)
    value.element(k, [&](const Argument& part) {
      if (part.is_text())
        columns.emplace_back(part.text());
      else
        detail::wrong_type(part, info, "a column's name", problems);
    });
}

const Block<FromKeys>& from_block() {
  static const Block<FromKeys> block{
      "from",
      {custom<FromKeys>("columns", "string[]", "the names of columns in the order in which they stand",
                        [](const Argument& value, const OptionInfo& info, FromKeys& keys,
                           Problems& problems) { read_columns(value, info, keys.columns, problems); })
           .defaults_to("in the order of their names, as rows bring them")}};
  return block;
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
        {.name = "from",
         .body = table_from,
         .sentence =
             "A table of rows that a script has. A column may carry its unit in its name, and a cell may "
             "be a quantity.",
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
