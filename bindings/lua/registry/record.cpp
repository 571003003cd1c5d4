// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/record.hpp"

#include <algorithm>
#include <utility>

#include "bindings/lua/registry/call_record.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/contact/scene/effect.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

using RecordPointer = std::shared_ptr<Record>;
using IteratorPointer = std::shared_ptr<Iterator>;

Record* record_of(lua_State* L) {
  auto* block = static_cast<RecordPointer*>(block_at(L, 1, &record_key));
  return block == nullptr ? nullptr : block->get();
}

void push_text(lua_State* L, const std::string& text) { lua_pushlstring(L, text.data(), text.size()); }

int missing_field(lua_State* L) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    const Record& record = *record_of(L);
    std::vector<std::string> names;
    for (const Record::Entry& entry : record.entries) names.push_back(entry.field);
    const Argument key(L, 2);
    for (const auto& [field, effect] : record.missing_effects)
      if (key.is_text() && key.text() == field)
        refuse_without(quoted(field), quoted(effect), "name it in the effects of the contact");
    refuse_name(
        "a " + record.name + " result has no field " +
            (key.is_text() ? quoted(key.text().substr(0, 40)) + meant_by(key.text(), names) : key.describe()),
        "it has " + joined(names, " and "));
  });
}

int record_index(lua_State* L) {
  const Record* record = record_of(L);
  if (record == nullptr) return luaL_error(L, "this is not a result");
  std::size_t length = 0;
  const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tolstring(L, 2, &length) : nullptr;
  if (key != nullptr) {
    if (const Value* value = record->find(std::string_view(key, length))) {
      push(L, *value);
      return 1;
    }
  }
  missing_field(L);
  return mistaken_field(L);
}

int record_new_index(lua_State* L) {
  return luaL_error(L, "a result cannot be changed; copy its fields into a table");
}

std::string describe(const Record& record) {
  std::size_t width = 0;
  for (const Record::Entry& entry : record.entries)
    if (!entry.value.is_nil()) width = std::max(width, entry.field.size());
  std::string text = record.name;
  for (const Record::Entry& entry : record.entries)
    if (!entry.value.is_nil())
      text += "\n  " + entry.field + std::string(width - entry.field.size() + 2, ' ') + show(entry);
  return text;
}

int describe_record(lua_State* L) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values { return {describe(*record_of(L))}; });
}

int record_to_string(lua_State* L) {
  if (record_of(L) == nullptr) return luaL_error(L, "this is not a result");
  return describe_record(L) < 0 ? lua_error(L) : 1;
}

// next(record, key), in the order of the fields.
int record_next(lua_State* L) {
  const Record* record = record_of(L);
  if (record == nullptr) return luaL_error(L, "this is not a result");
  std::size_t k = 0;
  if (lua_type(L, 2) == LUA_TSTRING) {
    std::size_t length = 0;
    const char* key = lua_tolstring(L, 2, &length);
    while (k < record->entries.size() && record->entries[k].field != std::string_view(key, length)) ++k;
    ++k;
  }
  if (k >= record->entries.size()) return lua_pushnil(L), 1;
  push_text(L, record->entries[k].field);
  push(L, record->entries[k].value);
  return 2;
}

int record_pairs(lua_State* L) {
  lua_pushcfunction(L, record_next);
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

int record_release(lua_State* L) {
  // A second call finds an empty pointer.
  if (auto* block = static_cast<RecordPointer*>(block_at(L, 1, &record_key))) block->reset();
  return 0;
}

// Nothing at the end.
std::optional<Values> turn_of(Call& call, Iterator& iterator) {
  iterator.place.clear();
  LedgerScope scope = call.session().ledger_scope(iterator.name, false);
  // `next` must not advance if memory runs out, because it is called again.
  std::optional<Values> results = with_collection(call.L, [&] { return iterator.next(call); });
  if (!results) return scope.forget(), std::nullopt;  // the end is not a turn
  scope.keep();
  enter_into_ledger(call.session(), *results);
  return results;
}

int next_of(lua_State* L) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    auto* block = static_cast<IteratorPointer*>(block_at(L, 1, &iterator_key));
    if (block == nullptr || *block == nullptr) refuse_state("the iterator is finished");
    const std::shared_ptr<Iterator> iterator = *block;
    Call call(L, iterator->name, true);
    if (auto results = turn_of(call, *iterator)) return *std::move(results);
    block->reset();
    return {Value()};
  });
}

// Raises the error of a guarded function.
template <int (*guarded_function)(lua_State*)>
int raising(lua_State* L) {
  const int results = guarded_function(L);
  return results < 0 ? lua_error(L) : results;
}

// it:table{…}
int guarded_table(lua_State* L) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    auto* block = static_cast<IteratorPointer*>(block_at(L, 1, &iterator_key));
    if (block == nullptr || *block == nullptr)
      refuse_state("the iterator is finished", "write c:sweep{…}:table{…}");
    const std::shared_ptr<Iterator> iterator = std::exchange(*block, nullptr);
    const std::string name = iterator->name + ":table";
    Call call(L, name, true);
    return {iterator->table(call, [&] { return turn_of(call, *iterator); })};
  });
}

int table_of(lua_State* L) {
  const int results = guarded_table(L);
  return results < 0 ? mistaken_field(L) : results;
}

int guarded_iterator_index(lua_State* L) {
  static const std::string nothing;
  return guarded(L, nothing, [&]() -> Values {
    const auto* block = static_cast<IteratorPointer*>(block_at(L, 1, &iterator_key));
    const Argument key(L, 2);
    const bool known = block != nullptr && *block != nullptr;
    if (known && key.is_text() && key.text() == "table" && (*block)->table)
      return {Value(Value::Function(table_of))};
    const std::string name = known ? (*block)->name : "an iterator";
    refuse_name(name + " gives an iterator, and " + (key.is_text() ? quoted(key.text()) : key.describe()) +
                    " was read from it",
                "write for ... in " + name + "(...) do");
  });
}

// Warns of an iterator without a loop; ignores errors of the warning.
int iterator_release(lua_State* L) {
  static const std::string nothing;
  auto* block = static_cast<IteratorPointer*>(block_at(L, 1, &iterator_key));
  if (block == nullptr || *block == nullptr) return 0;
  if (!(*block)->place.empty())
    guarded(L, nothing, [&]() -> Values {
      const Iterator& iterator = **block;
      if (const Session* session = Session::find(L))
        session->monitor().warn(iterator.place + iterator.name +
                                " does nothing without a loop; write for ... in " + iterator.name +
                                "(...) do");
      return {};
    });
  block->reset();
  return 0;
}

void make_metatable(lua_State* L, const void* key, const char* name, const luaL_Reg* methods) {
  lua_newtable(L);
  luaL_setfuncs(L, methods, 0);
  lua_pushstring(L, name);
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, name);
  lua_setfield(L, -2, "__metatable");
  lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

}  // namespace

void open_results(lua_State* L) {
  static const luaL_Reg of_record[] = {{"__index", record_index},        {"__newindex", record_new_index},
                                       {"__tostring", record_to_string}, {"__pairs", record_pairs},
                                       {"__gc", record_release},         {nullptr, nullptr}};
  static const luaL_Reg of_iterator[] = {{"__call", raising<next_of>},
                                         {"__index", raising<guarded_iterator_index>},
                                         {"__gc", iterator_release},
                                         {"__close", iterator_release},
                                         {nullptr, nullptr}};
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &record_key) != LUA_TTABLE) {
    make_metatable(L, &record_key, "result", of_record);
    make_metatable(L, &iterator_key, "iterator", of_iterator);
  }
  lua_pop(L, 1);
}

const RecordType<Cost>& cost_type() {
  static const RecordType<Cost> type{
      "Cost",
      "cost",
      "Computing cost.",
      {{"seconds", &Cost::seconds, dimension::time, "by the clock"},
       {"transforms", &Cost::transforms, "Fourier transforms, in equivalents of the finest grid"},
       {"bytes", &Cost::bytes, "greatest memory beyond the memory held before"}}};
  return type;
}

Record cost_by_effect(const std::vector<std::pair<std::string, Cost>>& costs) {
  Record record;
  record.name = "cost by effect";
  for (const auto& [effect, cost] : costs) {
    Record of_effect = cost_type()(cost);
    of_effect.name = effect;
    record.add(effect, std::move(of_effect));
  }
  return record;
}

}  // namespace asperity::lua
