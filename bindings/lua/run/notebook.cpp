// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/notebook.hpp"

#include <algorithm>
#include <map>

#include "bindings/lua/registry/session.hpp"
#include "engine/core/laws_met.hpp"
#include "engine/run/notebook_chart.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

RunDirectory& run_of(const Call& call) {
  const Session& session = call.session();
  if (session.is_case || session.run == nullptr)
    throw Error(ErrorCode::not_permitted, "a case of an ensemble keeps no notebook",
                "return what it found, and write the rows after the loop");
  return *session.run;
}

Values open_notebook(Call& call) { return {object(run_of(call).notebook(call.text(1, "name")))}; }

// --- rows

std::optional<Cell> read_cell(const Argument& value) {
  if (value.is_number()) return Cell(value.number());
  if (value.is_boolean()) return Cell(value.boolean());
  if (value.is_text()) return Cell(std::string(value.text()));
  return {};
}

// "Ra [um]" is the column Ra with the unit um.
Entry named_entry(std::string_view key) {
  Entry entry;
  const std::size_t open = key.rfind(" [");
  if (key.ends_with("]") && open != std::string_view::npos) {
    entry.unit = key.substr(open + 2, key.size() - open - 3);
    key = key.substr(0, open);
  }
  entry.column = key;
  return entry;
}

bool begins_a_number(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return false;
  text.remove_prefix(first);
  if (text.front() == '+' || text.front() == '-') text.remove_prefix(1);
  if (!text.empty() && text.front() == '.') text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

// "3 um" is a number with a unit, and not text: it is kept in the unit of its column, in SI where that has
// none. Throws Error{bad_unit} for a quantity of another kind than the column's.
void keep_quantity(Entry& entry, const std::string& unit) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (text == nullptr) return;
  if (!unit.empty()) {
    if (!begins_a_number(*text)) return;  // "worn" stays text
    try {
      entry.value = parse_quantity_in(*text, unit);
      laws_met().meet(Law::column_units);
    } catch (const Error& error) {
      throw Error(ErrorCode::bad_unit, "column " + quoted(entry.column) + ": " + error.sentence(),
                  error.hint());
    }
    return;
  }
  try {
    const Quantity quantity = parse_quantity(*text);
    if (quantity.dimension == dimension::number) return;
    entry.unit = si_unit(quantity.dimension);
    entry.value = quantity.value;
  } catch (const Error&) {
    // Text that is no quantity stays text.
  }
}

Values write_row(Call& call) {
  const Argument table = call.argument(1);
  if (!table.is_table())
    throw Error(ErrorCode::bad_value, "a row is a table of columns, and was given as " + table.describe(),
                "write book:write{ N=1, mu=0.4 }");
  std::vector<Entry> row;
  const bool dry = call.session().dry_run;
  auto& book = call.self<Notebook>();
  table.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text())
      throw Error(ErrorCode::bad_value, "a column is named by " + key.describe(),
                  "columns have names: { N=1, mu=0.4 }");
    if (dry && value.is_unknown()) return;
    const auto cell = read_cell(value);
    if (!cell)
      throw Error(ErrorCode::bad_value,
                  "column " + quoted(key.text().substr(0, 40)) + " is " + value.describe(),
                  "a cell holds a number, a string or a boolean");
    Entry entry = named_entry(key.text());
    entry.value = *cell;
    if (!entry.unit.empty()) parse_unit(entry.unit);
    keep_quantity(entry, entry.unit.empty() ? book.unit_of(entry.column) : entry.unit);
    row.push_back(std::move(entry));
  });
  if (row.empty() && dry) return {};
  // Lua keeps no order of keys; a new column's place must not depend on chance.
  std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
  book.write(row);
  return {};
}

Values units(Call& call) {
  const Argument table = call.argument(1);
  if (!table.is_table())
    throw Error(ErrorCode::bad_value, "book:units was given " + table.describe(),
                "write book:units{ Ra=\"m\", p=\"Pa\" }");
  std::map<std::string, std::string> declared;  // in the order of the names, as for a row
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

Value cell_value(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* truth = std::get_if<bool>(&cell)) return *truth;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

Values rows_of_notebook(Call& call) {
  const Table table = call.self<Notebook>().table();
  List list;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    Map row;
    for (std::size_t c = 0; c < table.columns().size(); ++c)
      if (Value v = cell_value(table.cell(r, c)); !v.is_nil())
        row.items.emplace_back(table.columns()[c].name, std::move(v));
    list.items.emplace_back(std::move(row));
  }
  return {std::move(list)};
}

// --- filters, expectations, charts

void read_filter(const Argument& value, const OptionInfo& info, TableFilter& filter, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { N=1 } or { D={2, 2.5} }", problems);
  std::vector<Condition> conditions;
  value.each([&](const Argument& key, const Argument& wanted) {
    if (!key.is_text()) return problems.push_back("`where` names a column by " + key.describe());
    Condition condition{std::string(key.text()), {}};
    auto take = [&](const Argument& part) {
      if (auto cell = read_cell(part))
        condition.accepted.push_back(*cell);
      else if (!part.is_unknown())
        problems.push_back("`where." + condition.column + "` is " + part.describe() +
                           "; give a number, a string, a boolean, or a list of them");
    };
    if (wanted.is_table())
      for (std::int64_t k = 1; k <= wanted.length(); ++k) wanted.element(k, take);
    else
      take(wanted);
    conditions.push_back(std::move(condition));
  });
  std::sort(conditions.begin(), conditions.end(),
            [](const Condition& a, const Condition& b) { return a.column < b.column; });
  filter = TableFilter(std::move(conditions));
}

template <class O>
Option<O> where_key(TableFilter O::*member) {
  return custom<O>("where", "table", "only rows in which these columns hold these values",
                   [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                     read_filter(value, info, options.*member, problems);
                   });
}

// A plain number, in the column's unit, or a quantity of any dimension, which the column's unit must share.
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
       bound_key(
           "near", &E::near,
           "the value wanted, with `within` or `rel`: a number in the column's unit, or a quantity such as "
           "\"10 MPa\", which is converted to it"),
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

Values chart_rows(Call& call) {
  const NotebookChart options = call.options(notebook_chart_block());
  const DrawnChart drawn = draw_chart(run_of(call), call.self<Notebook>(), options);
  for (const std::string& warning : drawn.warnings) call.session().monitor().warn(warning);
  return {drawn.file.string()};
}

std::string describe_notebook(const void* self) {
  const auto& book = *static_cast<const Notebook*>(self);
  const Table table = book.table();
  return "notebook \"" + book.name() + "\": " + std::to_string(table.rows()) + " rows of " +
         std::to_string(table.columns().size()) + " columns";
}

}  // namespace

const Block<NotebookChart>& notebook_chart_block() {
  using C = NotebookChart;
  static const Block<C> block{
      "chart",
      {text("x", &C::x, "the column along").required(),
       custom<C>("y", "string|string[]", "the column, or columns of one unit, up",
                 [](const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
                   if (value.is_text()) return c.y.push_back(std::string(value.text()));
                   if (!value.is_table() || value.length() == 0)
                     return detail::wrong_type(value, info, "a column's name or a list of them", problems);
                   for (std::int64_t k = 1; k <= value.length(); ++k)
                     value.element(k, [&](const Argument& part) {
                       if (part.is_text())
                         c.y.emplace_back(part.text());
                       else
                         detail::wrong_type(part, info, "a column's name", problems);
                     });
                 })
           .required(),
       text("one_line_per", &C::one_line_per, "a column; one line for each of its values"),
       custom<C>("spread", "boolean|string",
                 "error bars: true for the scatter of rows that share x, or a column that holds them",
                 [](const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
                   if (value.is_boolean())
                     c.spread = value.boolean();
                   else if (value.is_text())
                     c.spread_column = std::string(value.text());
                   else
                     detail::wrong_type(value, info, "true or a column's name", problems);
                 }),
       where_key(&C::where), flag("log_x", &C::log_x, "logarithmic axis along"),
       flag("log_y", &C::log_y, "logarithmic axis up"),
       flag("in_order", &C::in_order, "join rows as they were written, for loops that come back"),
       flag("lines", &C::lines, "join the points"), flag("points", &C::points, "mark the points"),
       text("title", &C::title, "above the chart"),
       text("x_label", &C::x_label, "instead of the column's name"),
       text("y_label", &C::y_label, "instead of the column's name"),
       text("file", &C::file, "an .svg or .png under the run directory; default <notebook>-<y>-<x>.svg")}};
  return block;
}

Function notebook_function() {
  return {
      .name = "notebook",
      .body = open_notebook,
      .sentence =
          "The notebook of that name: rows kept as <name>.csv in the run directory, written as they come.",
      .parameters = {{"name", "string", "of the notebook and its file"}},
      .returns = "Notebook",
      .example = "local book = lab.notebook \"stiffness\""};
}

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
        {"name",
         "string",
         "of the notebook",
         {},
         [](Call& call) -> Values { return {call.self<Notebook>().name()}; }},
        {"file",
         "string",
         "where its rows are kept",
         {},
         [](Call& call) -> Values { return {call.self<Notebook>().csv().string()}; }},
    };
    c.methods = {
        {.name = "write",
         .body = write_row,
         .sentence = "Adds a row. A column may carry its unit in its name: [\"Ra [m]\"] = s:roughness().Ra.",
         .parameters = {{"row", "table", "columns and their values: numbers, strings, booleans"}},
         .example = "book:write{ N=1, mu=0.4 }"},
        {.name = "units",
         .body = units,
         .sentence = "Gives columns their units, for the table's header and the charts.",
         .parameters = {{"units", "table", "unit of each column"}},
         .example = "book:units{ Ra=\"m\", pressure=\"Pa\" }"},
        {.name = "rows",
         .body = rows_of_notebook,
         .sentence = "All rows as tables.",
         .returns = "table[]",
         .example = "for _, row in ipairs(book:rows()) do print(row.N, row.mu) end"},
        {.name = "expect",
         .body = expect,
         .sentence = "States what a column should show; returns whether it does. A failed expectation makes "
                     "the run exit 1 after "
                     "everything is recorded.",
         .parameters = {{"column", "string", "the column"}},
         .options = &expect_block(),
         .returns = "boolean",
         .example = "book:expect(\"mu\", { where={N=1}, near=0.4, within=0.05 })",
         .heavy = true},
        {.name = "chart",
         .body = chart_rows,
         .sentence = "Draws columns against a column; returns the file.",
         .options = &notebook_chart_block(),
         .returns = "string",
         .example = "book:chart{ x=\"D\", y=\"mu\", one_line_per=\"r\" }",
         .heavy = true},
    };
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
