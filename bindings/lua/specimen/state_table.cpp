// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/state_table.hpp"

#include <algorithm>
#include <utility>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

namespace {

// At `index`: a record or a State.
Cell field_at(lua_State* L, int index, const std::string& field) {
  const Argument::StackGuard guard(L);
  lua_pushvalue(L, index);
  auto read = [&field](lua_State* s) {
    lua_getfield(s, 1, field.c_str());
    return 1;
  };
  if (protect(L, 1, 1, read) != LUA_OK) refuse_name(error_text(L, -1));
  const Argument value(L, -1);
  if (value.is_nil()) return {};
  const auto cell = cell_of(value);
  if (!cell)
    refuse("the field " + quoted(field) + " is " + value.describe(),
           "a column holds numbers, strings or booleans");
  return *cell;
}

// value:roughness(), or value:profile_parameters{ section= }.
void push_roughness(lua_State* L, const Value& value, std::optional<double> section = {}) {
  auto action = [&](lua_State* s) {
    push(s, value);
    lua_getfield(s, -1, section ? "profile_parameters" : "roughness");
    lua_pushvalue(s, -2);
    if (section) {
      lua_createtable(s, 0, 1);
      lua_pushnumber(s, *section);
      lua_setfield(s, -2, "section");
    }
    lua_call(s, section ? 2 : 1, 1);
    return 1;
  };
  if (protect(L, 0, 1, action) == LUA_OK) return;
  stop_flag().check();
  refuse(error_text(L, -1));
}

Dimension declared_dimension(const std::string& owner, const std::string& field, bool in_sections) {
  static const Class& state = class_of<asperity::State>();
  const RecordInfo& roughness = owner != "trace" ? areal_roughness_type
                                : in_sections    ? *find_record_type("ProfileParameters")
                                                 : profile_roughness_type;
  std::vector<std::string> names;
  if (owner.empty()) names = {"event", "kind", "press"};
  if (std::ranges::find(names, field) != names.end()) return dimension::number;
  for (const Getter& getter : owner.empty() ? state.fields : roughness.fields) {
    if (getter.name == field) return getter.dimension;
    names.push_back(getter.name);
  }
  refuse_name((owner.empty() ? std::string(state.article_name) : "a " + roughness.title + " result") +
                  " has no field " + quoted(field) + meant_by(field, names),
              owner.empty()
                  ? ""
                  : "it has " + joined(names, " and ") +
                        (owner == "trace" && !in_sections ? "; trace={ section= } gives more" : ""));
}

StateTable columns_given(const Call& call) {
  std::vector<std::string> names;
  Problems problems;
  static const OptionInfo info{
      .name = "columns", .type = "string[]", .default_text = "", .range_text = "", .sentence = ""};
  read_texts(call.argument(1), info, names, problems);
  if (!problems.empty())
    refuse(joined(problems, "; "), "write it such as :table{ \"pressure [MPa]\", \"area_fraction [%]\" }");
  StateTable::find_mistakes(names, {}, problems);
  if (!problems.empty()) refuse_name(joined(problems, "; "));
  return {names, {}};
}

}  // namespace

StateTable::StateTable(const std::vector<std::string>& names, TraceKeys traces) : traces_(std::move(traces)) {
  for (const std::string& name : names) {
    const TableColumn split = split_column_unit(name);
    Column column{"", split.name, split.name};
    if (const std::size_t dot = split.name.find('.'); dot != std::string::npos) {
      column.owner = split.name.substr(0, dot);
      column.field = split.name.substr(dot + 1);
    }
    static const std::vector<std::string> owners = {"", "lower", "upper", "trace"};
    if (std::ranges::find(owners, column.owner) == owners.end())
      refuse_name("the column " + quoted(name) + " is of " + quoted(column.owner) +
                      did_you_mean(column.owner, owners),
                  "give a quantity of the state, or one of lower, upper or trace, such as \"lower.Ra [um]\"");
    table_.declare_dimension(column.name,
                             declared_dimension(column.owner, column.field, traces_.section.has_value()));
    if (!split.unit.empty()) table_.declare_unit(column.name, split.unit);
    columns_.push_back(std::move(column));
  }
  table_.rename("the table");
}

void StateTable::find_mistakes(const std::vector<std::string>& columns, const TraceKeys& traces,
                               Problems& problems) {
  for (const std::string& name : columns) try {
      StateTable({name}, traces);
    } catch (const Error& error) {
      problems.emplace_back(error.what());
    }
}

bool StateTable::needs(const std::string& owner) const {
  return std::ranges::any_of(columns_, [&](const Column& column) { return column.owner == owner; });
}

void StateTable::add(Call& call, const Turn& turn) {
  lua_State* L = call.L;
  const Argument::StackGuard guard(L);
  const auto pushed = [&](const Value& value) {
    push_checked(L, value, "a row");
    return lua_gettop(L);
  };
  const int state = pushed(turn.state), event = pushed(turn.event);
  std::vector<std::pair<std::string, int>> owners;  // on the stack
  const auto roughness_of = [&](const char* owner, const Surface& body) {
    push_roughness(L, object(Surface(body)));
    owners.emplace_back(owner, lua_gettop(L));
  };
  if (needs("lower")) roughness_of("lower", turn.pair->lower());
  if (needs("upper")) roughness_of("upper", turn.pair->upper());
  if (needs("trace")) {
    if (traces_.stylus == nullptr)
      refuse("a column of `trace` needs a stylus", "give trace={ stylus=stylus, count=5, seed=1 }");
    const StylusScan scan =
        traces_.stylus->scan(turn.pair->lower(), traces_.count, traces_.seed, call.session().monitor());
    for (const Profile& trace : scan.traces) {
      push_roughness(L, object(Profile(trace)), traces_.section);
      owners.emplace_back("trace", lua_gettop(L));
    }
  }
  std::vector<Entry> row;
  for (const Column& column : columns_) {
    Cell found;
    if (!column.owner.empty()) {
      double sum = 0;
      int numbers = 0, records = 0;
      for (const auto& [owner, place] : owners) {
        if (owner != column.owner) continue;
        found = field_at(L, place, column.field);
        ++records;
        if (is_number(found)) sum += *number_in(found), ++numbers;
      }
      if (records > 1) found = numbers == records ? Cell(sum / numbers) : Cell();
    } else if (!turn.event.is_nil() && column.name == "event") {
      found = field_at(L, event, "index");
    } else if (!turn.event.is_nil() && column.name == "kind") {
      found = field_at(L, event, "kind");
    } else if (column.name == "press") {
      if (!turn.state.is_nil()) found = turn.press;
    } else if (!turn.state.is_nil()) {
      found = field_at(L, state, column.field);
    }
    row.push_back({column.name, found});
  }
  table_.append(row);
}

void look_at_columns_of_states(const Call& call) {
  if (!holds_unknown(call.argument(1), 1)) columns_given(call);
}

Value table_of_states(Call& call, const std::shared_ptr<SpecimenPair>& pair,
                      const std::function<std::optional<Values>()>& turn) {
  StateTable table = columns_given(call);
  std::int64_t press = 0;
  while (auto values = turn()) table.add(call, {values->front(), {}, ++press, pair});
  return object(std::move(table).finish());
}

}  // namespace asperity::lua
