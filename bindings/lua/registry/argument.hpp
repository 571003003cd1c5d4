// SPDX-License-Identifier: GPL-3.0-or-later
// One value on the Lua stack, read without raising: no metamethods, no allocating conversions. Tables are
// visited in place, without a copy. Valid while the value keeps its stack index.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

// Keys of the metatables of placeholders, results and iterators in Lua's registry. `native_key` marks native
// metatables; the registry has their maker there.
inline constexpr char unknown_key = 0, record_key = 0, iterator_key = 0, native_key = 0, list_units_key = 0;

// Null if not native.
Object* native_at(lua_State* L, int index);
// Null if no result.
std::shared_ptr<Record> record_at(lua_State* L, int index);
// The block of a userdata whose metatable has this key in Lua's registry, or null.
void* block_at(lua_State* L, int index, const void* key);

class Argument {
 public:
  Argument(lua_State* state, int index) : L(state), index_(lua_absindex(state, index)) {}

  bool is_nil() const { return lua_isnoneornil(L, index_); }
  bool is_boolean() const { return lua_isboolean(L, index_); }
  bool is_number() const { return lua_type(L, index_) == LUA_TNUMBER; }
  bool is_text() const { return lua_type(L, index_) == LUA_TSTRING; }
  bool is_table() const { return lua_istable(L, index_); }
  bool is_function() const { return lua_isfunction(L, index_); }
  bool is_unknown() const;  // a placeholder

  bool boolean() const { return lua_toboolean(L, index_) != 0; }
  double number() const { return lua_tonumber(L, index_); }
  std::optional<std::int64_t> integer() const;  // also an integral float
  std::string_view text() const;
  // Null for another class.
  Object* as_object(const Class& type) const;
  Object* as_any_object() const;
  template <class T>
  const T* as() const {
    Object* object = as_object(class_of<T>());
    return object == nullptr ? nullptr : static_cast<const T*>(object->pointer.get());
  }

  // `a string ("5 um")`, `a table`, `a surface`, `the number 3`, `nothing`.
  std::string describe() const;

  std::int64_t length() const { return static_cast<std::int64_t>(lua_rawlen(L, index_)); }
  bool is_list() const;  // of a table: no keys but 1 to length()
  // Nil if absent.
  template <class Visit>
  auto element(std::int64_t k, Visit&& visit) const {
    StackGuard guard(L);
    lua_rawgeti(L, index_, k);
    return visit(Argument(L, -1));
  }
  // Calls visit(element) or visit(element, k) for k from 1 to length().
  template <class Visit>
  void elements(Visit&& visit) const {
    for (std::int64_t k = 1, last = length(); k <= last; ++k)
      element(k, [&](const Argument& value) {
        if constexpr (std::invocable<Visit, const Argument&>)
          visit(value);
        else
          visit(value, k);
      });
  }
  // In Lua's own order.
  template <class Visit>
  void each(Visit&& visit) const {
    StackGuard guard(L);
    lua_pushnil(L);
    while (lua_next(L, index_) != 0) {
      visit(Argument(L, -2), Argument(L, -1));
      lua_pop(L, 1);
    }
  }

  lua_State* state() const { return L; }
  int index() const { return index_; }

  class StackGuard {
   public:
    explicit StackGuard(lua_State* state);
    ~StackGuard() { lua_settop(L, top_); }
    StackGuard(const StackGuard&) = delete;
    StackGuard& operator=(const StackGuard&) = delete;

   private:
    lua_State* L;
    int top_;
  };

 private:
  lua_State* L;
  int index_;
};

// Calls use(value) for a text key; nil if absent. Linear in the table.
template <class Use>
auto with_key(const Argument& table, std::string_view key, Use&& use) {
  lua_State* L = table.state();
  const Argument::StackGuard guard(L);
  lua_pushnil(L);
  while (lua_next(L, table.index()) != 0) {
    if (Argument(L, -2).is_text() && Argument(L, -2).text() == key) return use(Argument(L, -1));
    lua_pop(L, 1);
  }
  lua_pushnil(L);
  return use(Argument(L, -1));
}

// A Lua function for C++, valid during a body.
class Callback {
 public:
  explicit Callback(const Argument& function) : function_(function) {}
  // Throws Error with the function's message, or without a number.
  double operator()(std::initializer_list<double> arguments, std::string_view key) const;
  double operator()(std::initializer_list<std::int64_t> arguments, std::string_view key) const;
  bool answer(std::initializer_list<double> arguments, std::string_view key) const;

 private:
  template <class Number>
  Argument called(std::initializer_list<Number> arguments, std::string_view key) const;
  static double number_of(const Argument& result, std::string_view key);
  Argument function_;
};

}  // namespace asperity::lua
