// SPDX-License-Identifier: GPL-3.0-or-later
// Lua lists with the methods of a Table.
#include <algorithm>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/table_operations.hpp"

namespace asperity::lua {

namespace {

bool is_method(std::string_view name) {
  return std::ranges::any_of(class_of<asperity::Table>().methods,
                             [&](const Function& method) { return method.name == name; });
}

int guarded_conversion(lua_State* L) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    const Call call(L, nothing, false);
    if (call.session().dry_run) return {placeholder_of("Table")};
    return {object(table_of_rows(call, Argument(L, 1)))};
  });
}

// Upvalue: name of a table's method.
int call_method(lua_State* L) {
  if (guarded_conversion(L) < 0) return lua_error(L);
  lua_replace(L, 1);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_gettable(L, 1);
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

int rows_index(lua_State* L) {
  std::size_t length = 0;
  const char* name = lua_type(L, 2) == LUA_TSTRING ? lua_tolstring(L, 2, &length) : nullptr;
  if (name == nullptr || !is_method({name, length})) return lua_pushnil(L), 1;
  lua_pushvalue(L, 2);
  lua_pushcclosure(L, call_method, 1);
  return 1;
}

int rows_to_string(lua_State* L) {
  if (guarded_conversion(L) < 0) return lua_error(L);
  luaL_tolstring(L, -1, nullptr);
  return 1;
}

void add_cells(std::vector<Entry>& row, const Argument& given) {
  given.each([&](const Argument& key, const Argument& value) {
    if (!key.is_text()) return;
    const auto cell = cell_of(value);
    if (!cell) return;
    row.push_back({std::string(key.text()), *cell});
    read_quantity(row.back(), split_column_unit(row.back().column));
  });
  std::ranges::sort(row, {}, &Entry::column);
}

void add_cells(std::vector<Entry>& row, lua_State* L, const Record& record, Table& table) {
  for (const Record::Entry& entry : record.entries) {
    const Argument::StackGuard guard(L);
    push_checked(L, entry.value, "a table");
    const auto cell = cell_of(Argument(L, -1));
    if (!cell) continue;
    if (is_number(*cell) && !table.find_column(entry.field))
      table.declare_dimension(entry.field, entry.dimension);
    row.push_back({entry.field, *cell, is_number(*cell) ? si_unit(entry.dimension) : ""});
  }
}

struct NumberWithUnit {
  std::int64_t row;
  std::string key, name, unit;
  double value;  // in SI
};

std::vector<NumberWithUnit> numbers_with_units(const Argument& rows) {
  std::vector<NumberWithUnit> found;
  rows.elements([&](const Argument& row, std::int64_t k) {
    if (!row.is_table()) return;
    row.each([&](const Argument& key, const Argument& value) {
      if (!key.is_text() || !value.is_number()) return;
      const TableColumn column = split_column_unit(key.text());
      if (!column.unit.empty())
        found.push_back(
            {k, std::string(key.text()), column.name, column.unit, from_unit(value.number(), column.unit)});
    });
  });
  return found;
}

constexpr const char* units_key = "units";

}  // namespace

Table table_of_rows(const Call& call, const Argument& rows) {
  Table table;
  table.rename("the table");
  if (rows.is_table())
    rows.elements([&](const Argument& given, std::int64_t k) {
      std::vector<Entry> row;
      if (const auto record = record_at(call.L, given.index()))
        add_cells(row, call.L, *record, table);
      else if (given.is_table())
        add_cells(row, given);
      else
        refuse("row " + std::to_string(k) + " is " + given.describe(),
               "a row is a table of columns, such as { N=1, mu=0.4 }");
      if (!row.empty()) table.append(row);
    });
  const Argument::StackGuard guard(rows.state());
  if (luaL_getmetafield(rows.state(), rows.index(), units_key) == LUA_TTABLE)
    Argument(rows.state(), -1).each([&](const Argument& name, const Argument& unit) {
      if (table.find_column(name.text())) table.declare_unit(name.text(), unit.text());
    });
  if (table.columns().empty())
    refuse("the list holds no row with a number, a string or a boolean",
           "give a table or a notebook, or a list of rows such as { { N=1, mu=0.4 } }");
  return table;
}

void set_row_methods(lua_State* L, const std::vector<std::pair<std::string, std::string>>& units) {
  static const luaL_Reg methods[] = {
      {"__index", rows_index}, {"__tostring", rows_to_string}, {nullptr, nullptr}};
  int status = LUA_ERRRUN;
  try {
    const std::vector<NumberWithUnit> moved = numbers_with_units(Argument(L, -1));
    Table declared;
    for (const auto& [name, unit] : units) declared.declare_unit(name, unit);
    for (const NumberWithUnit& number : moved) declared.declare_unit(number.name, number.unit);
    auto action = [&](lua_State* state) {
      lua_createtable(state, 0, 4);
      luaL_setfuncs(state, methods, 0);
      lua_pushliteral(state, "rows");
      lua_setfield(state, -2, "__name");
      lua_newtable(state);
      const auto declare = [&](const std::string& name, const std::string& unit) {
        lua_pushlstring(state, unit.data(), unit.size());
        lua_setfield(state, -2, name.c_str());
      };
      for (const TableColumn& column : declared.columns()) declare(column.name, column.unit);
      for (const NumberWithUnit& number : moved) {
        lua_rawgeti(state, 1, number.row);
        lua_pushnil(state);
        lua_setfield(state, -2, number.key.c_str());
        lua_pushnumber(state, number.value);
        lua_setfield(state, -2, number.name.c_str());
        lua_pop(state, 1);
      }
      lua_setfield(state, -2, units_key);
      lua_setmetatable(state, 1);
      return 0;
    };
    lua_pushvalue(L, -1);
    status = protect(L, 1, 0, action);
  } catch (const Error& error) {
    fail(L, message_of(L, "lab.ensemble", error));
  }
  if (status != LUA_OK) lua_error(L);
}

}  // namespace asperity::lua
