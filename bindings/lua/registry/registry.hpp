// SPDX-License-Identifier: GPL-3.0-or-later
// A call of a function of the language, with its declarations and options, in three frames. The outer frame
// has no destructors and raises. The guard (guard.hpp) catches C++ exceptions. The body is ordinary C++; it
// reads its arguments without raising and returns Values.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/declarations.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/options.hpp"

namespace asperity::lua {

class Session;

// Lives on the guard's frame.
class Call {
 public:
  Call(lua_State* state, const std::string& function_name, bool is_method)
      : L(state), function_(function_name), first_(is_method ? 2 : 1) {}

  Session& session() const;
  const std::string& function_name() const { return function_; }
  // With place and function name.
  void warn(const std::string& sentence) const;
  // Arguments after self, from 1.
  int count() const { return lua_gettop(L) - first_ + 1; }
  Argument argument(int k) const { return Argument(L, first_ + k - 1); }
  bool given(int k) const { return k <= count() && !argument(k).is_nil(); }

  // Throws Error if called with a dot.
  template <class T>
  T& self() const {
    return *static_cast<T*>(self_pointer(class_of<T>()));
  }
  template <class T>
  std::shared_ptr<T> shared_self() const {
    self_pointer(class_of<T>());
    return std::static_pointer_cast<T>(Argument(L, 1).as_object(class_of<T>())->pointer);
  }

  double number(int k, StaticText name) const;
  double quantity(int k, StaticText name, Dimension dimension) const;
  std::string text(int k, std::string_view name, const std::string& wanted = "a string") const;
  template <class T>
  const T& object(int k, std::string_view name) const {
    return *static_cast<const T*>(object_pointer(k, name, class_of<T>()));
  }

  // Argument k; one Error reports all problems.
  template <class Options>
  Options options(const Block<Options>& block, int k = 1) const {
    return block.read(argument(k), function_, notes_inputs() ? &inputs_ : nullptr);
  }
  // For the journal; empty in a case.
  const Resolved& inputs() const { return inputs_; }

  lua_State* const L;

 private:
  bool notes_inputs() const;
  void* self_pointer(const Class& type) const;
  void* object_pointer(int k, std::string_view name, const Class& type) const;
  std::string function_;
  int first_;
  mutable Resolved inputs_;
};

}  // namespace asperity::lua
