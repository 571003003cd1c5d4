// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/state_table.hpp"

#include <algorithm>
#include <utility>

#include "bindings/lua/metrology/stylus.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "engine/core/monitor.hpp"
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
  if (protect(L, 1, 1, read) != LUA_OK) throw Error(ErrorCode::unknown_name, error_text(L, -1));
  const Argument value(L, -1);
  if (value.is_nil()) return {};
  const auto cell = cell_of(value);
  if (!cell)
    throw Error(ErrorCode::bad_value, "the field " + quoted(field) + " is " + value.describe(),
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
  throw Error(ErrorCode::bad_value, error_text(L, -1));
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
  throw Error(ErrorCode::unknown_name,
              (owner.empty() ? state.article_name : "a " + roughness.title + " result") + " has no field " +
                  quoted(field) + meant_by(field, names),
              owner.empty()
                  ? ""
                  : "it has " + joined(names, " and ") +
                        (owner == "trace" && !in_sections ? "; trace={ section= } gives more" : ""));
}

// Each column by itself: all mistakes are found.
void find_mistakes(const std::vector<std::string>& columns, const TraceKeys& traces, Problems& problems) {
  for (const std::string& name : columns) try {
      StateTable({name}, traces);
    } catch (const Error& error) {
      problems.emplace_back(error.what());
    }
}

StateTable columns_given(const Call& call) {
  std::vector<std::string> names;
  Problems problems;
  static const OptionInfo info{
      .name = "columns", .type = "string[]", .default_text = "", .range_text = "", .sentence = ""};
  read_texts(call.argument(1), info, names, problems);
  if (!problems.empty())
    throw Error(ErrorCode::bad_value, joined(problems, "; "),
                "write it such as :table{ \"pressure [MPa]\", \"area_fraction [%]\" }");
  find_mistakes(names, {}, problems);
  if (!problems.empty()) throw Error(ErrorCode::unknown_name, joined(problems, "; "));
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
      throw Error(ErrorCode::unknown_name,
                  "the column " + quoted(name) + " is of " + quoted(column.owner) +
                      did_you_mean(column.owner, owners),
                  "give a quantity of the state, or one of lower, upper or trace, such as \"lower.Ra [um]\"");
    table_.declare_dimension(column.name,
                             declared_dimension(column.owner, column.field, traces_.section.has_value()));
    if (!split.unit.empty()) table_.declare_unit(column.name, split.unit);
    columns_.push_back(std::move(column));
  }
  table_.rename("the table");
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
      throw Error(ErrorCode::bad_value, "a column of `trace` needs a stylus",
                  "give trace={ stylus=stylus, count=5, seed=1 }");
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

namespace {

struct ApplyKeys {
  std::vector<std::string> columns;
  TraceKeys trace;
};

void read_trace(const Argument& value, const OptionInfo& info, ApplyKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { stylus=stylus, count=5, seed=1 }", problems);
  value.each([&](const Argument& key, const Argument& given) {
    static const std::vector<std::string> names = {"stylus", "count", "seed", "section"};
    const std::string name(key.is_text() ? key.text() : "");
    const Object* stylus = name == "stylus" ? given.as_object(class_of<Stylus>()) : nullptr;
    const std::int64_t whole = given.is_number() ? given.integer().value_or(-1) : -1;
    if (given.is_unknown()) return;
    if (name == "section") {
      OptionInfo length = info;
      length.name = "trace.section", length.dimension = dimension::length;
      keys.trace.section = detail::read_quantity(given, length, above(0), problems);
      return;
    }
    if (stylus != nullptr)
      keys.trace.stylus = std::static_pointer_cast<Stylus>(stylus->pointer);
    else if (name == "count" && whole >= 1 && whole <= 1'000'000)
      keys.trace.count = static_cast<int>(whole);
    else if (name == "seed" && whole >= 0)
      keys.trace.seed = static_cast<std::uint64_t>(whole);
    else
      problems.push_back(quoted(info.name + "." + name) + " is " + given.describe() +
                         did_you_mean(name, names) + "; give stylus=stylus, count=5, seed=1");
  });
}

const Block<ApplyKeys>& apply_block() {
  using K = ApplyKeys;
  static const Block<K> block{
      {custom<K>(
           "columns", "string[]",
           "`event` (its number), `kind`, `press` (its number), quantities of a State, roughness of the "
           "bodies (\"lower.Ra\") or parameters of the traces (\"trace.Ra\"), with a unit or without",
           [](const Argument& value, const OptionInfo& info, K& keys, Problems& problems) {
             read_texts(value, info, keys.columns, problems);
           })
           .required(),
       custom<K>("trace", "table",
                 "traces on the lower body after each event: { stylus=, count=1, seed=1, section= }; a "
                 "section gives the parameters of ISO 21920-2, such as trace.Rz",
                 read_trace)},
      [](K& keys, Problems& problems) { find_mistakes(keys.columns, keys.trace, problems); }};
  return block;
}

Values apply(Call& call) {
  call.object<SpecimenPair>(1, "contact");  // throws for another type
  auto pair =
      std::static_pointer_cast<SpecimenPair>(call.argument(1).as_object(class_of<SpecimenPair>())->pointer);
  const ApplyKeys keys = call.options(apply_block(), 2);
  StateTable table(keys.columns, keys.trace);
  ProtocolRun run(call.self<Protocol>(), pair);
  std::int64_t presses = 0;
  while (!run.finished()) {
    const std::size_t k = run.next();
    const std::optional<asperity::State> state = run.step(call.session().monitor());
    if (const auto* press = std::get_if<PressRequest>(&run.protocol().events()[k].step)) {
      ++presses;
      record_press(call.session(), pair, *press, *state);
    }
    table.add(call, {state ? object(*state) : Value(), event_of(run.protocol(), k), presses, pair});
  }
  return {object(std::move(table).finish())};
}

}  // namespace

Function apply_method() {
  return {.name = "apply",
          .body = apply,
          .sentence =
              "Does all events to a contact and returns a table with a row for each event. Quantities of "
              "a State are empty except after a press.",
          .parameters = {{"contact", "Contact", "its bodies change"}},
          .options = &apply_block(),
          .returns = "Table",
          .example =
              "print(protocol:apply(c, { columns={ \"press\", \"area_fraction [%]\", \"lower.Ra [um]\" } }))",
          .heavy = true};
}

}  // namespace asperity::lua
