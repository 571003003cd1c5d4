// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

using Rows = asperity::Table;

Values each_row(Call& call) {
  const auto table = table_of_self(call);
  auto next = std::make_shared<std::size_t>(0);
  return {Iterator{[table, next](Call&) -> std::optional<Values> {
                     if (*next == table->rows()) return std::nullopt;
                     return Values{row_of(*table, (*next)++)};
                   },
                   call.function_name()}};
}

struct SortKeys {
  std::vector<std::string> by;
  bool descending = false;
};

const Block<SortKeys> sort_block{
    {texts_key("by", "string|string[]", "the column, or columns, the first one first", &SortKeys::by)
         .required(),
     flag("descending", &SortKeys::descending, "largest first")}};

Values sort_rows(Call& call) {
  const SortKeys keys = call.options(sort_block);
  const auto table = table_of_self(call);
  std::vector<std::size_t> columns, order(table->rows());
  for (const std::string& name : keys.by) columns.push_back(table->column(name, "by"));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    for (const std::size_t k : columns) {
      const Cell &one = table->cell(a, k), &other = table->cell(b, k);
      if (comes_before(one, other)) return !keys.descending;
      if (comes_before(other, one)) return keys.descending;
    }
    return false;
  });
  return {object(rows_of(*table, order))};
}

Cell computed_cell(const Call& call, const Argument& function, const std::string& column, const Map& row,
                   std::size_t number) {
  lua_State* L = call.L;
  const Argument::StackGuard guard(L);
  const auto failed = [&](const std::string& why) {
    return Error(ErrorCode::bad_value, "the function of " + quoted(column) + " failed in row " +
                                           std::to_string(number) + ": " + why);
  };
  if (const auto failure = failure_of_call(function, {row})) throw failed(*failure);
  const Argument answer(L, -1);
  if (answer.is_nil()) return {};
  const auto cell = cell_of(answer);
  if (!cell) throw failed("it returned " + answer.describe());
  return *cell;
}

Values with_columns(Call& call) {
  const Argument given = call.argument(1);
  if (!given.is_table())
    refuse("t:with was given " + given.describe(),
           "give functions by column, as in t:with{ [\"F [N]\"]=function(row) return row.p * 1e-6 end }");
  std::vector<std::string> names;
  given.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text() || !value.is_function())
      refuse("t:with met " + key.describe() + " = " + value.describe(),
             "give a function of the row under the name of its column");
    names.emplace_back(key.text());
  });
  std::ranges::sort(names);
  const auto table = table_of_self(call);
  Rows wider(table->columns(), {});
  wider.rename(table->name());
  for (const std::string& name : names) {
    const TableColumn column = split_column_unit(name);
    wider.declare_column(column.name);
    if (!column.unit.empty()) wider.declare_unit(column.name, column.unit);
  }
  for (std::size_t row = 0; row < table->rows(); ++row) {
    std::vector<Entry> entries;
    for (std::size_t k = 0; k < table->columns().size(); ++k)
      entries.push_back({table->columns()[k].name, table->cell(row, k)});
    for (const std::string& name : names)
      with_key(given, name, [&](const Argument& function) {
        Entry entry{name, computed_cell(call, function, name, row_of(*table, row), row + 1)};
        const std::string plain = split_column_unit(name).name;
        std::erase_if(entries, [&](const Entry& other) { return other.column == plain; });
        entries.push_back(std::move(entry));
      });
    wider.append(entries);
  }
  return {object(std::move(wider))};
}

enum class Reduction { least, greatest, sum };

template <Reduction reduction>
Values reduced(Call& call) {
  const auto table = table_of_self(call);
  const std::string name = call.text(1, "column");
  const std::vector<double> values = number_columns(*table, {{"column", name}}).values[0];
  if (reduction == Reduction::sum) return {std::accumulate(values.begin(), values.end(), 0.0)};
  if (values.empty()) refuse("column " + quoted(name) + " has no number");
  const auto ends = std::ranges::minmax(values);
  return {reduction == Reduction::least ? ends.min : ends.max};
}

Values write_table(Call& call) {
  const Argument given = call.argument(1);
  if (given.is_table()) {
    note_columns(call);
    const bool is_book = Argument(call.L, 1).as<Notebook>() != nullptr;
    if (!is_book)
      refuse("a table takes no rows",
             "a notebook does: lab.notebook \"events\":write{…}; t:write \"x.csv\" writes a file");
    const std::vector<Entry> row = entries_of(call, given, "write book:write{ N=1, mu=0.4 }");
    if (!row.empty() || !call.session().dry_run) {
      auto& book = call.self<Notebook>();
      book.read([&](const Table& table) { refuse_numbers_without_unit(row, table); });
      book.write(row);
    }
    return {};
  }
  if (!given.is_text()) entries_of(call, given, "write book:write{ N=1, mu=0.4 }");  // refuses
  const std::string name = call.text(1, "path");
  if (const std::string ending = file_extension(name); ending != "csv" && ending != "txt")
    refuse("a table is written as CSV, and the file is " + quoted(name),
           "give it a name such as \"angles.csv\"");
  if (call.session().dry_run) return {name};
  const std::string path = writable_path(call, name);
  write_atomically(path, table_of_self(call)->csv());
  return {path};
}

// In SI, in the unit of the column's name, or a quantity.
Option<Expectation> bound_key(const char* name, std::optional<ExpectedValue> Expectation::*member,
                              const char* sentence) {
  return custom<Expectation>(
      name, "number", sentence,
      [member](const Argument& value, const OptionInfo& info, Expectation& e, Problems& problems) {
        read_expected(value, info.name, e.*member, problems);
      });
}

const Block<Expectation> expect_block{
    {where_key(&Expectation::where),
     bound_key("near", &Expectation::near,
               "the value wanted, with `within` or `rel`: a quantity such as \"10 MPa\", or a number in SI "
               "or in the unit of the column's name"),
     bound_key("within", &Expectation::within, "greatest distance from `near`"),
     number("rel", &Expectation::relative, at_least(0), "greatest distance from `near`, relative to it"),
     bound_key("at_least", &Expectation::at_least, "lowest value accepted"),
     bound_key("at_most", &Expectation::at_most, "highest value accepted"),
     text("increasing_in", &Expectation::increasing_in,
          "a column with which the value must rise; rows that share it are averaged"),
     text("decreasing_in", &Expectation::decreasing_in,
          "a column with which the value must fall; rows that share it are averaged"),
     flag("should_fail", &Expectation::should_fail, "a negative control: the expectation must not hold"),
     text("label", &Expectation::label, "shown with the verdict")}};

Values expect(Call& call) {
  Expectation expectation = call.options(expect_block, 2);
  expectation.column = call.text(1, "column");
  RunDirectory& run =
      run_of(call, "states no expectations", "return its results, and expect it after the loop");
  const auto table = table_of_self(call);
  const auto* book = Argument(call.L, 1).as<Notebook>();
  return {run.expect(expectation, *table, book != nullptr ? book->name() : table->name()).passed};
}

Function reduction(StaticText name, Body body, StaticText sentence) {
  return {.name = name,
          .body = body,
          .sentence = sentence,
          .parameters = {{"column", "string", "its name"}},
          .returns = "number",
          .example = "print(book:" + name + " \"mu\")",
          .unknown_when_dry = true};
}

}  // namespace

std::vector<Function> row_methods() {
  return {
      {.name = "rows",
       .body = [](Call& call) -> Values { return {rows_of_table(*table_of_self(call))}; },
       .sentence = "All rows as tables, numbers in SI; an empty cell is nil.",
       .returns = "table[]",
       .example = "for _, row in ipairs(book:rows()) do print(row.N, row.mu) end"},
      {.name = "each",
       .body = each_row,
       .sentence = "The rows one after the other, numbers in SI.",
       .returns = "iterator<table>",
       .example = "for row in book:each() do print(row.N, row.mu) end",
       .unknown_when_dry = true},
      {.name = "sorted",
       .body = sort_rows,
       .sentence = "The rows in ascending order of a column. Equal rows keep their order.",
       .options = &sort_block,
       .returns = "Table",
       .example = "print(book:sorted{ by=\"mu\", descending=true })",
       .unknown_when_dry = true},
      {.name = "with",
       .body = with_columns,
       .sentence = "The rows with computed columns: functions of the row by column. With a unit in the name, "
                   "the function returns a number in this unit, else in SI.",
       .parameters = {{"columns", "table<string, function>", "functions of the row, numbers in SI"}},
       .returns = "Table",
       .example = "print(book:with{ twice=function(row) return 2 * row.mu end })",
       .unknown_when_dry = true},
      reduction("min", reduced<Reduction::least>, "The least number of a column, in SI."),
      reduction("max", reduced<Reduction::greatest>, "The greatest number of a column, in SI."),
      reduction("sum", reduced<Reduction::sum>, "The sum of a column, in SI."),
      {.name = "write",
       .body = write_table,
       .sentence =
           "On a notebook, book:write{…} adds a row. A unit in a column's name holds for its number: [\"Ra "
           "[um]\"]=2.8; other numbers are in SI, and \"3 um\" is a quantity. t:write \"x.csv\" writes all "
           "rows as CSV with units in the heads; lab.table.read gives them back to the bit.",
       .parameters = {{"row", "table|string", "columns and their values, or a .csv under the run directory"}},
       .returns = "string?",
       .example = "book:write{ N=1, mu=0.4, [\"Ra [um]\"]=2.8 }"},
      {.name = "expect",
       .body = expect,
       .sentence = "States an expectation of a column; returns whether it holds. A failed expectation makes "
                   "the run exit 1 after everything is recorded.",
       .parameters = {{"column", "string", "the column; a unit in its name holds for the numbers given"}},
       .options = &expect_block,
       .returns = "boolean",
       .example = "book:expect(\"mu\", { where={N=1}, near=0.4, within=0.05 })",
       .heavy = true},
  };
}

}  // namespace asperity::lua
