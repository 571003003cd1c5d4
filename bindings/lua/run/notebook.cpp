// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/notebook.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bindings/lua/registry/mistakes.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table.hpp"
#include "bindings/lua/run/table_keys.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/text.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/sample_mean.hpp"

namespace asperity::lua {

namespace {

struct NotebookKeys {
  std::vector<std::string> columns;
};

const Block<NotebookKeys>& notebook_block() {
  static const Block<NotebookKeys> block{
      "notebook",
      {custom<NotebookKeys>("columns", "string[]",
                            "the names of columns in the order in which they stand, with units or without",
                            [](const Argument& value, const OptionInfo& info, NotebookKeys& keys,
                               Problems& problems) { read_texts(value, info, keys.columns, problems); })
           .defaults_to("in the order of their names, as rows bring them")}};
  return block;
}

Values open_notebook(Call& call) {
  const NotebookKeys keys = call.options(notebook_block(), 2);
  for (const std::string& column : keys.columns) parse_unit(split_column_unit(column).unit);
  RunDirectory& run =
      run_of(call, "keeps no notebook", "return what it found, and write the rows after the loop");
  const std::shared_ptr<Notebook> book = run.notebook(call.text(1, "name"));
  if (!keys.columns.empty()) book->order_columns(keys.columns);
  return {object(book)};
}

// Null in a run.
std::set<std::string>* columns_seen(const Call& call) {
  Mistakes* const mistakes = call.session().mistakes.get();
  const auto* book = call.argument(0).as<Notebook>();
  return mistakes == nullptr || book == nullptr ? nullptr : &mistakes->columns[book->name()];
}

// A name absent from the script's text is computed and may change in the next turn of a loop.
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

// Refuses an unknown column, if all columns are known.
void look_at_columns(const Call& call) {
  const std::set<std::string>* const columns = columns_seen(call);
  if (columns == nullptr || columns->empty() || columns->contains("")) return;
  const auto look = [&](const Argument& column) {
    const std::string name(column.is_text() ? split_column_unit(column.text()).name : *columns->begin());
    if (!columns->contains(name))
      throw Error(ErrorCode::unknown_name,
                  "no row of the notebook has a column " + quoted(name) +
                      did_you_mean(name, std::vector<std::string>(columns->begin(), columns->end())));
  };
  const Argument first = call.argument(1);
  look(first);
  for (const char* key : {"x", "y", "of"})
    if (first.is_table())
      with_key(first, key, [&](const Argument& named) {
        look(named);
        for (std::int64_t k = 1; named.is_table() && k <= named.length(); ++k) named.element(k, look);
      });
}

Values write_row(Call& call) {
  auto& book = call.self<Notebook>();
  const bool dry = call.session().dry_run;
  note_columns(call);
  const std::vector<Entry> row = entries_of(call.argument(1), dry, "write book:write{ N=1, mu=0.4 }",
                                            [&](const std::string& column) { return book.unit_of(column); });
  if (row.empty() && dry) return {};
  book.write(row);
  return {};
}

Values rows_of_notebook(Call& call) { return {rows_of_table(call.self<Notebook>().table())}; }

Values units(Call& call) {
  const Argument table = call.argument(1);
  if (!table.is_table())
    throw Error(ErrorCode::bad_value, "book:units was given " + table.describe(),
                "write book:units{ Ra=\"m\", p=\"Pa\" }");
  std::map<std::string, std::string> declared;  // sorted by name, like a row
  table.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text() || !value.is_text())
      throw Error(ErrorCode::bad_value, "book:units met " + key.describe() + " = " + value.describe(),
                  "write book:units{ Ra=\"m\", p=\"Pa\" }");
    parse_unit(value.text());
    declared.emplace(key.text(), value.text());
  });
  for (const auto& [column, unit] : declared) call.self<Notebook>().declare_unit(column, unit);
  return {};
}

// A plain number in the column's unit, or a quantity of the column's dimension.
Option<Expectation> bound_key(const char* name, std::optional<ExpectedValue> Expectation::*member,
                              const char* sentence) {
  return custom<Expectation>(
      name, "number", sentence,
      [member](const Argument& value, const OptionInfo& info, Expectation& e, Problems& problems) {
        if (value.is_number()) {
          e.*member = value.number();
        } else if (value.is_text()) {
          try {
            e.*member = ExpectedValue(value.text());
          } catch (const Error& error) {
            problems.push_back(quoted(info.name) + ": " + error.what());
          }
        } else {
          detail::wrong_type(value, info, "a number or a quantity", problems);
        }
      });
}

const Block<Expectation>& expect_block() {
  using E = Expectation;
  static const Block<E> block{
      "expect",
      {where_key(&E::where),
       bound_key("near", &E::near,
                 "the value wanted, with `within` or `rel`: a number in the column's unit, or a quantity "
                 "such as \"10 MPa\", which is converted to it"),
       bound_key("within", &E::within, "greatest distance from `near`"),
       number("rel", &E::relative, at_least(0), "greatest distance from `near`, relative to it"),
       bound_key("at_least", &E::at_least, "lowest value accepted"),
       bound_key("at_most", &E::at_most, "highest value accepted"),
       text("increasing_in", &E::increasing_in,
            "a column with which the value must rise; rows that share it are averaged"),
       text("decreasing_in", &E::decreasing_in,
            "a column with which the value must fall; rows that share it are averaged"),
       flag("should_fail", &E::should_fail, "a negative control: the expectation must not hold"),
       text("label", &E::label, "shown with the verdict")}};
  return block;
}

Values expect(Call& call) {
  Expectation expectation = call.options(expect_block(), 2);
  expectation.column = call.text(1, "column");
  return {call.self<Notebook>().expect(expectation).passed};
}

// Means and standard errors of the non-constant numeric columns.
std::string describe_notebook(const void* self) {
  constexpr std::size_t most_means = 12;
  const auto& book = *static_cast<const Notebook*>(self);
  const Table table = book.table();
  std::string result = "notebook \"" + book.name() + "\": " + std::to_string(table.rows()) + " rows of " +
                       std::to_string(table.columns().size()) + " columns";
  std::size_t shown = 0;
  for (std::size_t c = 0; c < table.columns().size() && shown < most_means; ++c) {
    std::vector<double> values;
    for (std::size_t r = 0; r < table.rows(); ++r)
      if (const Cell& cell = table.cell(r, c); is_number(cell) && std::isfinite(*number_in(cell)))
        values.push_back(*number_in(cell));
    if (values.size() < 2 || std::ranges::minmax(values).min == std::ranges::minmax(values).max) continue;
    // Seeds and row numbers have no mean.
    if (table.columns()[c].name == "seed" ||
        std::ranges::adjacent_find(values, [](double a, double b) { return b != a + 1; }) == values.end())
      continue;
    const SampleMean mean = sample_mean(values);
    const TableColumn& column = table.columns()[c];
    result += "\n  " + column.name + ": " + format_short(mean.mean, 4) + " ± " +
              format_short(*mean.standard_error, 2) + (column.unit.empty() ? "" : " " + column.unit) +
              (shown++ == 0 ? " (mean ± standard error, n = " : " (n = ") + std::to_string(mean.count) + ")";
  }
  return result;
}

}  // namespace

Function notebook_function() {
  return {
      .name = "notebook",
      .body = open_notebook,
      .sentence =
          "The notebook of that name: rows kept as <name>.csv in the run directory, written as they come.",
      .parameters = {{"name", "string", "of the notebook and its file"}},
      .options = &notebook_block(),
      .options_optional = true,
      .returns = "Notebook",
      .example = "local book = lab.notebook \"stiffness\""};
}

// data table
template <>
const Class& class_of<Notebook>() {
  static const Class type = [] {
    Class c;
    c.name = "Notebook";
    c.article_name = "a notebook";
    c.sentence = "Rows of free columns, with expectations about them and charts of them.";
    c.shareable = false;
    c.describe = describe_notebook;
    c.fields = {
        getter<&Notebook::name>("name", "string", "of the notebook"),
        getter<Notebook>("file", "string", "where its rows are kept",
                         [](const Notebook& of) { return of.csv().string(); }),
    };
    c.methods = {
        {.name = "write",
         .body = write_row,
         .sentence =
             "Adds a row. A column may carry its unit in its name: [\"Ra [m]\"] = s:roughness().Ra. A number "
             "is kept as it is, in that unit; a quantity such as \"3 um\" is converted to it.",
         .parameters = {{"row", "table", "columns and their values: numbers, strings, booleans"}},
         .example = "book:write{ N=1, mu=0.4 }",
         .look = note_columns},
        {.name = "units",
         .body = units,
         .sentence = "Gives columns their units, for the table's header and the charts. Numbers are kept as "
                     "they are, "
                     "those written before too: in { z=\"um\" } a length in metres is written as z * 1e6.",
         .parameters = {{"units", "table", "unit of each column"}},
         .example = "book:units{ Ra=\"m\", pressure=\"Pa\" }"},
        {.name = "table",
         .body = [](Call& call) -> Values { return {object(*table_of_self(call))}; },
         .sentence = "The rows written so far as a table, a value that later rows do not change.",
         .returns = "Table",
         .example = "print(book:table())",
         .unknown_when_dry = true},
        {.name = "rows",
         .body = rows_of_notebook,
         .sentence = "All rows as tables.",
         .returns = "table[]",
         .example = "for _, row in ipairs(book:rows()) do print(row.N, row.mu) end"},
        {.name = "expect",
         .body = expect,
         .sentence = "States what a column should show; returns whether it does. A failed expectation makes "
                     "the run exit 1 after everything is recorded.",
         .parameters = {{"column", "string", "the column"}},
         .options = &expect_block(),
         .returns = "boolean",
         .example = "book:expect(\"mu\", { where={N=1}, near=0.4, within=0.05 })",
         .heavy = true,
         .look = look_at_columns},
    };
    static constexpr std::array<std::string_view, 4> looking = {"chart", "fit", "histogram", "mean"};
    for (auto* methods : {table_methods, table_analysis_methods})
      for (Function& method : methods()) {
        if (std::ranges::find(looking, method.name) != looking.end()) method.look = look_at_columns;
        c.methods.push_back(std::move(method));
      }
    c.results = table_analysis_results();
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
