// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/table_values.hpp"

#include <algorithm>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

bool begins_a_number(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return false;
  text.remove_prefix(first);
  if (text.front() == '+' || text.front() == '-') text.remove_prefix(1);
  if (!text.empty() && text.front() == '.') text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

void read_columns(const Argument& value, const OptionInfo& info, TableForm& form, Problems& problems) {
  constexpr const char* wanted =
      "own names with heads of the file, as in { load=\"Kraft\" }, or the heads of a file that has none in a "
      "list";
  if (!value.is_table()) return detail::wrong_type(value, info, wanted, problems);
  if (value.length() > 0) return read_texts(value, info, form.heads, problems);
  read_pairs(value, info, form.names, wanted, problems);
}

}  // namespace

void read_quantity(Entry& entry, const TableColumn& column) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (text == nullptr || !begins_a_number(*text)) return;  // "worn" is text
  if (!column.unit.empty()) {
    try {
      entry.value = parse_quantity_in(*text, column.unit);
    } catch (const Error& error) {
      throw Error(ErrorCode::bad_unit, "column " + quoted(column.name) + ": " + error.sentence(),
                  error.hint());
    }
    return;
  }
  try {
    const Quantity quantity = parse_quantity(*text);
    const bool share = text->ends_with('%');
    if (quantity.dimension == dimension::number && !share) return;
    entry.unit = share ? "%" : si_unit(quantity.dimension);
    entry.value = quantity.value;
  } catch (const Error&) {
    // Remains text.
  }
}

std::optional<Cell> cell_of(const Argument& value) {
  if (value.is_number() && lua_isinteger(value.state(), value.index()) != 0)
    return Cell(static_cast<std::int64_t>(lua_tointeger(value.state(), value.index())));
  if (value.is_number()) return Cell(value.number());
  if (value.is_boolean()) return Cell(value.boolean());
  if (value.is_text()) return Cell(std::string(value.text()));
  return {};
}

Value value_of(const Cell& cell, const TableColumn& column) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell); whole != nullptr && column.unit.empty())
    return *whole;
  if (is_number(cell)) return *number_in(cell);
  if (const auto* truth = std::get_if<bool>(&cell)) return *truth;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

Map row_of(const Table& table, std::size_t row) {
  Map map;
  for (std::size_t k = 0; k < table.columns().size(); ++k)
    if (Value value = value_of(table.cell(row, k), table.columns()[k]); !value.is_nil())
      map.items.emplace_back(table.columns()[k].name, std::move(value));
  return map;
}

List rows_of_table(const Table& table) {
  List list;
  for (std::size_t row = 0; row < table.rows(); ++row) list.items.emplace_back(row_of(table, row));
  return list;
}

Value row_value(const Table& table, std::int64_t k) {
  if (k < 1 || k > static_cast<std::int64_t>(table.rows())) return {};
  return row_of(table, static_cast<std::size_t>(k - 1));
}

std::vector<Entry> entries_of(const Call& call, const Argument& given, const std::string& example) {
  if (!given.is_table()) refuse("a row is a table of columns, and was given as " + given.describe(), example);
  std::vector<Entry> row;
  given.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text())
      refuse("a column is named by " + key.describe(), "columns have names: { N=1, mu=0.4 }");
    if (call.session().dry_run && value.is_unknown()) return;
    const auto cell = cell_of(value);
    if (!cell)
      refuse("column " + quoted(key.text().substr(0, 40)) + " is " + value.describe(),
             "a cell holds a number, a string or a boolean");
    Entry entry{std::string(key.text()), *cell};
    const TableColumn column = split_column_unit(entry.column);
    if (column.unit.empty() && entry.column.ends_with(']') && column.name == entry.column)
      call.session().monitor().warn("the unit of column " + quoted(entry.column) +
                                    " is not known; the brackets stay part of the name");
    read_quantity(entry, column);
    row.push_back(std::move(entry));
  });
  // Lua's key order varies; places of new columns must not.
  std::ranges::sort(row, {}, &Entry::column);
  return row;
}

void refuse_numbers_without_unit(const std::vector<Entry>& row, const Table& table) {
  for (const Entry& entry : row) {
    const auto* text = std::get_if<std::string>(&entry.value);
    const auto k = table.find_column(entry.column);
    if (text == nullptr || !k || table.columns()[*k].unit.empty()) continue;
    Entry read = entry;
    read_quantity(read, table.columns()[*k]);
  }
}

void read_filter(const Argument& value, const OptionInfo& info, TableFilter& filter, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { N=1 } or { D={2, 2.5} }", problems);
  std::vector<Condition> conditions;
  value.each([&](const Argument& key, const Argument& wanted) {
    if (!key.is_text()) return problems.push_back("`where` names a column by " + key.describe());
    Condition condition{std::string(key.text()), {}};
    auto take = [&](const Argument& part) {
      if (auto cell = cell_of(part))
        condition.accepted.push_back(*cell);
      else if (!part.is_unknown())
        problems.push_back("`where." + condition.column + "` is " + part.describe() +
                           "; give a number, a string, a boolean, or a list of them");
    };
    if (wanted.is_table())
      wanted.elements(take);
    else
      take(wanted);
    conditions.push_back(std::move(condition));
  });
  std::ranges::sort(conditions, {}, &Condition::column);
  filter = TableFilter(std::move(conditions));
}

void read_pairs(const Argument& value, const OptionInfo& info,
                std::vector<std::pair<std::string, std::string>>& pairs, const char* wanted,
                Problems& problems) {
  if (!value.is_table()) return detail::wrong_type(value, info, wanted, problems);
  value.each([&](const Argument& key, const Argument& text) {
    if (!key.is_text() || !text.is_text())
      return detail::wrong_type(key.is_text() ? text : key, info, wanted, problems);
    pairs.emplace_back(key.text(), text.text());
  });
  std::ranges::sort(pairs);
}

void read_texts(const Argument& value, const OptionInfo& info, std::vector<std::string>& texts,
                Problems& problems) {
  const auto take = [&](const Argument& part) {
    if (part.is_text())
      texts.emplace_back(part.text());
    else if (!part.is_unknown())
      detail::wrong_type(part, info, "a column's name", problems);
  };
  if (value.is_text()) return take(value);
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(value, info, "a column's name or a list of them", problems);
  value.elements(take);
}

void read_expected(const Argument& value, const std::string& name, std::optional<ExpectedValue>& expected,
                   Problems& problems) {
  if (value.is_nil() || value.is_unknown()) return;
  if (value.is_number())
    expected = value.number();
  else if (value.is_text())
    detail::collect(
        problems, [&] { expected = ExpectedValue(value.text()); }, name);
  else
    detail::wrong_type(value, name, "a number or a quantity", problems);
}

const std::vector<Option<TableForm>>& table_form_keys() {
  using F = TableForm;
  static const std::vector<Option<F>> keys = {
      custom<F>(
          "columns", "table",
          "own names of columns, each with its head in the file, as in { load=\"Kraft\" }; where two heads "
          "differ in their units alone, with the unit. Or a list: the heads of a file that has none",
          read_columns),
      integer("skip", &F::skip, at_least(0), "lines above the heads that are left out"),
      custom<F>("unit", "table",
                "units of columns that the file says none for, or others than it says: { load=\"kN\" }; "
                "\"1\" for plain numbers, \"date\" for dates that a spreadsheet wrote as numbers of days",
                [](const Argument& value, const OptionInfo& info, F& form, Problems& problems) {
                  read_pairs(value, info, form.units, "units by the names of columns, as in { load=\"kN\" }",
                             problems);
                }),
      choice("dates", &F::dates,
             {{"day first", DateOrder::day_first}, {"month first", DateOrder::month_first}},
             "the order in dates such as 03/04/2026")
          .defaults_to("as a date of the column tells that has a day after the 12th"),
      choice("clock", &F::clock, {{"h:min", ClockForm::hours_minutes}, {"min:s", ClockForm::minutes_seconds}},
             "meaning of times such as 10:30"),
      choice("decimal", &F::decimal, {{".", '.'}, {",", ','}}, "the decimal sign")
          .defaults_to("as the numbers of the file tell together"),
      choice("thousands", &F::thousands, {{",", ','}, {".", '.'}, {" ", ' '}, {"'", '\''}},
             "separator of thousands")
          .defaults_to("nothing"),
      choice("separator", &F::separator,
             {{",", Separator::comma},
              {";", Separator::semicolon},
              {"tab", Separator::tab},
              {"blank", Separator::blank}},
             "separator of cells")
          .defaults_to("as the line of heads tells"),
  };
  return keys;
}

}  // namespace asperity::lua
