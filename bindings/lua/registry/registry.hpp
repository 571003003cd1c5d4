// SPDX-License-Identifier: GPL-3.0-or-later
// Registry of all functions, classes and modules of scripts. The entries drive calls, "did you mean", help(),
// editor types, the reference page and the dry run.
//
// A call has three frames. The outer frame has no destructors and raises. The guard catches C++ exceptions,
// never `catch (...)`, which would swallow Lua's own. The body is ordinary C++; it reads its arguments
// without raising and returns Values.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/value.hpp"

namespace asperity {
class Ledger;
}

namespace asperity::lua {

class Session;

using Body = Values (*)(Call&);

class Call;

struct Parameter {
  std::string name{};
  std::string type{};  // a language type: "number", "Surface", "function"; a trailing "?" means optional
  std::string sentence{};
};

// A table below a function in help and reference; the first cell of a row is its name.
struct Listing {
  std::string title{};
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};
};

struct Function {
  std::string name{};
  Body body = nullptr;
  std::string sentence{};
  std::vector<Parameter> parameters{};
  const BlockInfo* options = nullptr;  // the last argument
  bool options_optional = false;
  // "State", "number", "Profile[]", "Roughness" (a record), "iterator<State>", "number, string", "" for none
  std::string returns{};
  std::string example{};  // required; runs after example_preamble()
  bool heavy = false;     // skipped by `asperity check`
  // Skipped by `asperity check` because the result depends on rows unknown to a dry run. Not in the journal.
  bool unknown_when_dry = false;
  Listing (*listing)() = nullptr;
  // For arguments with placeholders in a dry run, after the options; may be null.
  void (*look)(const Call& call) = nullptr;
};

std::vector<std::string> result_types(const Function& function);
// "Profile[] with tip_effect: TipEffect and lines: Traverse[]".
std::vector<std::pair<std::string_view, std::string_view>> named_fields(std::string_view type);

struct Getter {
  std::string name{};
  std::string type{};
  std::string sentence{};
  Dimension dimension{};
  Body body = nullptr;
};

struct Operator {
  std::string event{};    // "__sub"
  std::string form{};     // "a - b", for errors and help
  std::string operand{};  // type of the other operand, "Surface|number"; "" if unary
  std::string sentence{};
  std::string returns{};
  std::string example{};
  Body body = nullptr;  // both operands in order; a unary operand twice
};

struct Class {
  std::string name{};          // "Surface"
  std::string article_name{};  // "a surface"
  std::string sentence{};
  std::vector<Getter> fields{};
  std::string drawing{};  // text drawing below the fields in the reference
  std::vector<Function> methods{};
  std::vector<Operator> operators{};
  std::vector<const RecordInfo*> results{};
  bool shareable = true;                               // immutable; cases may share the value
  std::int64_t (*length)(const void* self) = nullptr;  // may be null
  std::string (*describe)(const void* self) = nullptr;
  std::size_t (*native_bytes)(const void* self) = nullptr;  // memory invisible to Lua
  bool (*equal)(const void* a, const void* b) = nullptr;
  std::string (*digest)(const void* self) = nullptr;  // of the content, for the journal
  // Adds the cost to the ledger by effect, for results of heavy calls and of iterators' turns. May be null.
  void (*enter)(const void* self, Ledger& ledger) = nullptr;
  void (*closing)(void* self) = nullptr;  // called before :close() and <close>
  // Facts about a result in a dry run; may be null.
  std::shared_ptr<const KnownBody> (*known)(const Call& call, const Function& function) = nullptr;
  std::vector<std::string> names() const;
};

struct Constant {
  std::string name{};
  std::string type{};
  std::string sentence{};
  Value (*value)() = nullptr;
};

struct Module {
  std::string path{};  // "lab.surface"
  std::string sentence{};
  std::vector<Function> functions{};
  std::vector<Constant> constants{};
  std::vector<const RecordInfo*> results{};
  // For calls of the module itself: lab.protocol{...}.
  std::optional<Function> call{};
};

// "lab" first, parents before children.
const std::vector<const Module*>& modules();
const std::vector<const Class*>& classes();
const Class* find_class(std::string_view name);

// Lives on the guard's frame.
class Call {
 public:
  Call(lua_State* state, const std::string& function_name, bool is_method)
      : L(state), function_(function_name), first_(is_method ? 2 : 1) {}

  Session& session() const;
  const std::string& function_name() const { return function_; }
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

  double number(int k, std::string_view name) const;
  double quantity(int k, std::string_view name, Dimension dimension) const;
  std::string text(int k, std::string_view name) const;
  template <class T>
  const T& object(int k, std::string_view name) const {
    return *static_cast<const T*>(object_pointer(k, name, class_of<T>()));
  }

  // From argument k; one Error reports all problems.
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
  const std::string& function_;
  int first_;
  mutable Resolved inputs_;
};

// Writes the journal line of a heavy call or an iterator's turn: object before the colon (may be null),
// inputs, digest of the results.
void record_call(const Session& session, const std::string& function, const Object* self,
                 const Resolved& inputs, const Values& results);

void enter_into_ledger(const Session& session, const Values& results);

// Raises on lack of memory: call inside protect().
void push_function(lua_State* L, const Function& function);
// "lab.surface.sine", "surface:scaled".
const std::string& qualified_name(const Function& function);
// The name of the function whose closures have this upvalue; null if none.
const std::string* name_of_entry(const void* pointer);
// Creates the metatable on first use.
void push_metatable(lua_State* L, const Class& type);
// Raises the error on the stack, or returns a placeholder in a dry run that continues after mistakes.
int mistaken_field(lua_State* L);
// Null if not native.
Object* native_at(lua_State* L, int index);

const Module* module_at(lua_State* L, int index);
void push_proxy(lua_State* L, const Module& module);

// pairs and next in the same order in every process (fixed_order.cpp): numbers, strings by bytes, booleans,
// other keys in Lua's order, which a dry run notes. A loop visits the keys present at its
// beginning and not removed since. Both are C functions without upvalues.
int ordered_pairs(lua_State* L);
int ordered_next(lua_State* L);
// The iterator function for the table at an index. Raises.
void push_ordered_loop(lua_State* L, int index);

// Raises like any luaopen function.
void push_library(lua_State* L);

}  // namespace asperity::lua
