// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/table_values.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "bindings/lua/run/notebook.hpp"
#include "bindings/lua/run/table.hpp"

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

void keep_quantity(Entry& entry, const std::string& unit) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (text == nullptr) return;
  if (!unit.empty()) {
    if (!begins_a_number(*text)) return;  // "worn" is text
    try {
      entry.value = parse_quantity_in(*text, unit);
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
    // Remains text.
  }
}

}  // namespace

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

std::vector<Entry> entries_of(const Argument& given, bool dry, const std::string& example,
                              const std::function<std::string(const std::string& column)>& unit_of) {
  if (!given.is_table())
    throw Error(ErrorCode::bad_value, "a row is a table of columns, and was given as " + given.describe(),
                example);
  std::vector<Entry> row;
  given.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text())
      throw Error(ErrorCode::bad_value, "a column is named by " + key.describe(),
                  "columns have names: { N=1, mu=0.4 }");
    if (dry && value.is_unknown()) return;
    const auto cell = cell_of(value);
    if (!cell)
      throw Error(ErrorCode::bad_value,
                  "column " + quoted(key.text().substr(0, 40)) + " is " + value.describe(),
                  "a cell holds a number, a string or a boolean");
    Entry entry = named_entry(key.text());
    entry.value = *cell;
    if (!entry.unit.empty()) parse_unit(entry.unit);
    keep_quantity(entry, entry.unit.empty() ? unit_of(entry.column) : entry.unit);
    row.push_back(std::move(entry));
  });
  // Lua's key order varies between processes; the place of a new column must not.
  std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
  return row;
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
      for (std::int64_t k = 1; k <= wanted.length(); ++k) wanted.element(k, take);
    else
      take(wanted);
    conditions.push_back(std::move(condition));
  });
  std::sort(conditions.begin(), conditions.end(),
            [](const Condition& a, const Condition& b) { return a.column < b.column; });
  filter = TableFilter(std::move(conditions));
}

std::shared_ptr<const asperity::Table> table_of_self(const Call& call) {
  const Argument self(call.L, 1);
  if (const auto* book = self.as<Notebook>()) return std::make_shared<const asperity::Table>(book->table());
  return call.shared_self<asperity::Table>();
}

}  // namespace asperity::lua
