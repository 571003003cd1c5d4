// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/argument.hpp"

#include <algorithm>

#include "bindings/lua/registry/declarations.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

void* block_at(lua_State* L, int index, const void* key) {
  if (lua_type(L, index) != LUA_TUSERDATA || lua_getmetatable(L, index) == 0) return nullptr;
  lua_rawgetp(L, LUA_REGISTRYINDEX, key);
  const bool same = lua_rawequal(L, -1, -2) != 0;
  lua_pop(L, 2);
  return same ? lua_touserdata(L, index) : nullptr;
}

Object* native_at(lua_State* L, int index) {
  void* block = lua_touserdata(L, index);
  if (lua_type(L, index) != LUA_TUSERDATA || lua_getmetatable(L, index) == 0) return nullptr;
  lua_rawgetp(L, -1, &native_key);
  const bool ours = lua_toboolean(L, -1) != 0;
  lua_pop(L, 2);
  return ours ? static_cast<Object*>(block) : nullptr;
}

std::shared_ptr<Record> record_at(lua_State* L, int index) {
  auto* block = static_cast<std::shared_ptr<Record>*>(block_at(L, index, &record_key));
  return block == nullptr ? nullptr : *block;
}

Argument::StackGuard::StackGuard(lua_State* state) : L(state), top_(lua_gettop(state)) {
  if (lua_checkstack(L, 8) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
}

bool Argument::is_unknown() const {
  const Object* object = as_any_object();
  if (object != nullptr) return object->is_placeholder();
  if (const std::shared_ptr<Record> record = record_at(L, index_)) return record->placeholder;
  return block_at(L, index_, &unknown_key) != nullptr;
}

std::optional<std::int64_t> Argument::integer() const {
  int is_integer = 0;
  if (lua_type(L, index_) != LUA_TNUMBER) return {};
  const lua_Integer value = lua_tointegerx(L, index_, &is_integer);
  if (is_integer == 0) return {};
  return value;
}

std::string_view Argument::text() const {
  if (lua_type(L, index_) != LUA_TSTRING) return {};
  std::size_t length = 0;
  const char* data = lua_tolstring(L, index_, &length);
  return {data, length};
}

Object* Argument::as_any_object() const { return native_at(L, index_); }

Object* Argument::as_object(const Class& type) const {
  Object* object = native_at(L, index_);
  return object != nullptr && object->type == &type ? object : nullptr;
}

bool Argument::is_list() const {
  std::int64_t entries = 0, others = 0;
  each([&](const Argument& key, const Argument&) {
    const auto k = key.is_number() ? key.integer() : std::nullopt;
    ++(k && *k >= 1 && *k <= length() ? entries : others);
  });
  return others == 0 && entries == length();
}

std::string Argument::describe() const {
  if (is_nil()) return "nothing (nil)";
  if (is_boolean()) return boolean() ? "the boolean true" : "the boolean false";
  if (is_number()) return "the number " + format_short(number(), 10);
  if (is_text())
    return "the string \"" + std::string(text().substr(0, 40)) + (text().size() > 40 ? "…\"" : "\"");
  if (is_table() && !is_list()) return "a table";
  if (is_table()) return length() == 0 ? "an empty table" : "a list of " + std::to_string(length());
  if (is_function()) return "a function";
  if (lua_isthread(L, index_)) return "a coroutine";
  if (const Object* object = as_any_object()) return object->type->article_name;
  const std::shared_ptr<Record> record = record_at(L, index_);
  return record != nullptr ? "a result (" + record->name + ")" : "a userdata";
}

double Callback::operator()(std::initializer_list<double> arguments, std::string_view key) const {
  const Argument::StackGuard guard(function_.state());
  return number_of(called(arguments, key), key);
}

double Callback::operator()(std::initializer_list<std::int64_t> arguments, std::string_view key) const {
  const Argument::StackGuard guard(function_.state());
  return number_of(called(arguments, key), key);
}

bool Callback::answer(std::initializer_list<double> arguments, std::string_view key) const {
  const Argument::StackGuard guard(function_.state());
  const Argument result = called(arguments, key);
  if (!result.is_boolean())
    refuse("the function " + quoted(key) + " returned " + result.describe(), "it must return true or false");
  return result.boolean();
}

template <class Number>
Argument Callback::called(std::initializer_list<Number> arguments, std::string_view key) const {
  lua_State* L = function_.state();
  lua_pushvalue(L, function_.index());
  for (const Number argument : arguments)
    if constexpr (std::integral<Number>)
      lua_pushinteger(L, argument);
    else
      lua_pushnumber(L, argument);
  if (lua_pcall(L, static_cast<int>(arguments.size()), 1, 0) != LUA_OK) {
    stop_flag().check();
    const Argument error(L, -1);
    std::vector<std::string> fields;
    if (error.is_table())
      error.each([&](const Argument& name, const Argument& value) {
        fields.push_back((name.is_text() ? std::string(name.text()) : "[" + name.describe() + "]") + "=" +
                         value.describe());
      });
    std::ranges::sort(fields);
    refuse("the function " + quoted(key) + " failed: " +
           (error.is_text()  ? std::string(error.text())
            : fields.empty() ? error.describe()
                             : "a table: " + joined(fields, ", ")));
  }
  return Argument(L, -1);
}

double Callback::number_of(const Argument& result, std::string_view key) {
  if (!result.is_number())
    refuse("the function " + quoted(key) + " returned " + result.describe(), "it must return a number");
  return result.number();
}

}  // namespace asperity::lua
