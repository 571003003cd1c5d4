// SPDX-License-Identifier: GPL-3.0-or-later
// One value on the Lua stack, read without ever raising a Lua error: no metamethods, no
// conversions that allocate. Elements of a table are visited in place, so a million heights cost no
// C++ tree. Valid while the value stays at its stack index.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

class Argument {
 public:
  Argument(lua_State* state, int index) : L(state), index_(lua_absindex(state, index)) {}

  bool is_nil() const { return lua_isnoneornil(L, index_); }
  bool is_boolean() const { return lua_isboolean(L, index_); }
  bool is_number() const { return lua_type(L, index_) == LUA_TNUMBER; }
  bool is_text() const { return lua_type(L, index_) == LUA_TSTRING; }
  bool is_table() const { return lua_istable(L, index_); }
  bool is_function() const { return lua_isfunction(L, index_); }
  bool is_unknown() const;  // a dry run's placeholder, of whatever kind

  bool boolean() const { return lua_toboolean(L, index_) != 0; }
  double number() const { return lua_tonumber(L, index_); }
  std::optional<std::int64_t> integer() const;  // also of a float with an integer value
  std::string_view text() const;
  // The native value if it is of this class.
  Object* as_object(const Class& type) const;
  Object* as_any_object() const;
  template <class T>
  const T* as() const {
    Object* object = as_object(class_of<T>());
    return object == nullptr ? nullptr : static_cast<const T*>(object->pointer.get());
  }

  // How a person would name it: `a string ("5 um")`, `a table`, `a surface`, `the number 3`, `nothing`.
  std::string describe() const;

  // Number of elements 1..n of a table (raw length).
  std::int64_t length() const { return static_cast<std::int64_t>(lua_rawlen(L, index_)); }
  // Calls visit(Argument) with element k of a table (nil if there is none).
  template <class Visit>
  auto element(std::int64_t k, Visit&& visit) const {
    StackGuard guard(L);
    lua_rawgeti(L, index_, k);
    return visit(Argument(L, -1));
  }
  // Calls visit(key, value) for every entry; the order is Lua's own. Keys are Arguments.
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

  // Restores the stack height; makes room for a few values.
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

// use(value) with the value a table holds under a text key; nil if there is none. Linear in the table.
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

// The registry key of the metatable that placeholders of a dry run share.
const void* unknown_key();

// A Lua function kept alive for the length of a body, to be called from C++.
class Callback {
 public:
  explicit Callback(const Argument& function) : function_(function) {}
  // Calls it with numbers and returns its first result as a number. Throws Error with the function's
  // own message if it failed, or naming what it returned if that is no number.
  double operator()(std::initializer_list<double> arguments, std::string_view key) const;
  double operator()(std::initializer_list<std::int64_t> arguments, std::string_view key) const;
  // The same of a function that answers true or false.
  bool answer(std::initializer_list<double> arguments, std::string_view key) const;

 private:
  Argument called(int arguments, std::string_view key) const;
  double finish(int arguments, std::string_view key) const;
  Argument function_;
};

}  // namespace asperity::lua
