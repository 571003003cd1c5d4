// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/run.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/require.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

struct NotebookKeys {
  std::vector<std::string> columns;
  std::vector<std::pair<std::string, std::string>> units;
};

const Block<NotebookKeys> notebook_block{
    {texts_key("columns", "string[]",
               "the names of columns in the order in which they stand, with units or without",
               &NotebookKeys::columns)
         .defaults_to("in the order of the rows that first have them, and by name within a row"),
     custom<NotebookKeys>(
         "units", "table", "display units of columns, as in { p=\"MPa\" }",
         [](const Argument& value, const OptionInfo& info, NotebookKeys& keys, Problems& problems) {
           read_pairs(value, info, keys.units, "units by column, as in { p=\"MPa\" }", problems);
         })}};

Values open_notebook(Call& call) {
  const NotebookKeys keys = call.options(notebook_block, 2);
  RunDirectory& run =
      run_of(call, "keeps no notebook", "return its results, and write the rows after the loop");
  const std::shared_ptr<Notebook> book = run.notebook(call.text(1, "name"));
  if (!keys.columns.empty()) book->order_columns(keys.columns);
  for (const auto& [column, unit] : keys.units) book->declare_unit(column, unit);
  return {object(book)};
}

// Null in a run.
std::set<std::string>* columns_seen(const Call& call) {
  Mistakes* const mistakes = call.session().mistakes.get();
  const auto* book = call.argument(0).as<Notebook>();
  return mistakes == nullptr || book == nullptr ? nullptr : &mistakes->columns[book->name()];
}

// Refuses an unknown column among known ones.
void look_at_columns(const Call& call) {
  const std::set<std::string>* const columns = columns_seen(call);
  if (columns == nullptr || columns->empty() || columns->contains("")) return;
  const auto look = [&](const Argument& column) {
    const std::string name(column.is_text() ? split_column_unit(column.text()).name : *columns->begin());
    if (!columns->contains(name))
      refuse_name("no row of the notebook has a column " + quoted(name) +
                  did_you_mean(name, std::vector<std::string>(columns->begin(), columns->end())));
  };
  const Argument first = call.argument(1);
  if (call.function_name().ends_with(":histogram")) look_at_histogram(call);
  look(first);
  for (const char* key : {"x", "y"})
    if (first.is_table())
      with_key(first, key, [&](const Argument& named) {
        look(named);
        if (named.is_table()) named.elements(look);
      });
}

void look_at_chart(const Call& call) {
  look_at_columns(call);
  const auto* book = Argument(call.L, 1).as<Notebook>();
  if (book != nullptr && call.session().run != nullptr && !call.argument(1).is_unknown())
    note_chart(*call.session().run, book->name(), call.options(notebook_chart_block), {});
}

Values units(Call& call) {
  const Argument table = call.argument(1);
  if (!table.is_table())
    refuse("book:units was given " + table.describe(), "write book:units{ Ra=\"um\", p=\"MPa\" }");
  std::map<std::string, std::string> declared;  // by name, as rows
  table.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text() || !value.is_text())
      refuse("book:units met " + key.describe() + " = " + value.describe(),
             "write book:units{ Ra=\"um\", p=\"MPa\" }");
    declared.emplace(key.text(), value.text());
  });
  for (const auto& [column, unit] : declared) call.self<Notebook>().declare_unit(column, unit);
  return {};
}

}  // namespace

// A name absent from the script's text is computed and may vary.
void note_columns(const Call& call) {
  std::set<std::string>* const columns = columns_seen(call);
  if (columns == nullptr) return;
  const Argument row = call.argument(1);
  if (!row.is_table()) columns->insert("");
  if (row.is_table())
    row.each([&](const Argument& key, const Argument&) {
      const bool literal =
          key.is_text() && call.session().mistakes->script.find(key.text()) != std::string::npos;
      columns->insert(literal ? split_column_unit(key.text()).name : "");
    });
}

std::shared_ptr<const asperity::Table> table_of_self(const Call& call) {
  const Argument self(call.L, 1);
  if (const auto* book = self.as<Notebook>()) return std::make_shared<const asperity::Table>(book->table());
  return call.shared_self<asperity::Table>();
}

Function notebook_function() {
  return {
      .name = "notebook",
      .body = open_notebook,
      .sentence =
          "The notebook of that name: rows stored as <name>.csv in the run directory, written as they come.",
      .parameters = {{"name", "string", "of the notebook and its file"}},
      .options = optional(notebook_block),
      .returns = "Notebook",
      .example = "local book = lab.notebook \"stiffness\""};
}

// data table
Class make_class(For<Notebook>) {
  Class c{"Notebook", "a notebook",
          "A Table to which book:write{…} adds rows; the run records them in a file. Its methods read the "
          "rows written so far."};
  c.shareable = false;
  c.describe = from_value([](const Notebook& book) -> std::string {
    Table table = book.table();
    table.rename("notebook \"" + book.name() + "\"");
    return table_text(table);
  });
  c.fields = {
      getter<&Notebook::name>("name", "string", "of the notebook"),
      getter<Notebook>("file", "string", "where its rows are kept",
                       [](const Notebook& of) { return of.csv().string(); }),
      getter<Notebook>("columns", "string[]", "the names of its columns, in order",
                       [](const Notebook& of) { return of.table().column_names(); }),
  };
  c.length = from_value([](const Notebook& of) {
    return of.read([](const Table& table) { return static_cast<std::int64_t>(table.rows()); });
  });
  c.item = [](const void* self, std::int64_t k) {
    return static_cast<const Notebook*>(self)->read([k](const Table& table) { return row_value(table, k); });
  };
  c.methods = {
      {.name = "units",
       .body = units,
       .sentence = "Gives columns other display units, for the file, charts and print. Stored numbers stay.",
       .parameters = {{"units", "table", "display unit of each column"}},
       .example = "book:units{ Ra=\"um\", pressure=\"MPa\" }"},
      {.name = "table",
       .body = [](Call& call) -> Values { return {object(*table_of_self(call))}; },
       .sentence = "The present rows as a Table; later rows do not change it.",
       .returns = "Table",
       .example = "print(book:table())",
       .unknown_when_dry = true},
  };
  static constexpr std::array<std::string_view, 4> looking = {"expect", "fit", "histogram", "mean"};
  for (Function& method : table_methods()) {
    if (std::ranges::find(looking, method.name) != looking.end()) method.look = look_at_columns;
    if (method.name == "chart") method.look = look_at_chart;
    if (method.name == "write") method.look = note_columns;
    c.methods.push_back(std::move(method));
  }
  c.results = table_results();
  return c;
}

}  // namespace asperity::lua
