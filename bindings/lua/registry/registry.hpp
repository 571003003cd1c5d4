// SPDX-License-Identifier: GPL-3.0-or-later
// Everything a script can see, registered once: functions, classes and modules with their sentence,
// parameters, units, defaults and an example. The same entries drive calls, "did you mean", help(),
// the editor's types, the reference page and the dry run.
//
// A call is three frames. The outer one has no destructors and raises; the guard catches C++
// exceptions (never `catch (...)`: that would swallow Lua's own); the body is ordinary C++ that
// reads its arguments without raising and returns Values.
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
  std::string name{};  // "i"; a trailing "?" in `type` means optional
  std::string type{};  // a type of the language: "number", "string", "Surface", "function"
  std::string sentence{};
};

// A table below a function in help and reference; the first cell of each row is its name.
struct Listing {
  std::string title{};
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};  // as many cells as columns
};

struct Function {
  std::string name{};  // "press"
  Body body = nullptr;
  std::string sentence{};
  std::vector<Parameter> parameters{};  // positional ones
  const BlockInfo* options = nullptr;   // the table of named keys: the last argument
  bool options_optional = false;        // the table may be left out
  // "State", "number", "Profile[]", "Roughness" (a record), "iterator<State>", "number, string", "" for none
  std::string returns{};
  std::string example{};  // required; a line to run after example_preamble()
  bool heavy = false;     // not run by `asperity check`
  // `asperity check` skips the call, because its result follows from rows unknown to a dry run; the journal
  // has no line for the call.
  bool unknown_when_dry = false;
  Listing (*listing)() = nullptr;
  // A dry run calls `look` for arguments with placeholders, after reading the options; null: no action.
  void (*look)(const Call& call) = nullptr;
};

// The types named by `returns`, one for each result.
std::vector<std::string> result_types(const Function& function);
// The named fields of a list, "Profile[] with tip_effect: TipEffect and lines: Traverse[]": names and types.
std::vector<std::pair<std::string_view, std::string_view>> named_fields(std::string_view type);

// A field of a native value, computed when read.
struct Getter {
  std::string name{};
  std::string type{};
  std::string sentence{};
  Dimension dimension{};
  Body body = nullptr;
};

// An operator of Lua with a native value on either side.
struct Operator {
  std::string event{};    // "__sub"
  std::string form{};     // "a - b", as it is written and as errors call it
  std::string operand{};  // the type of the other side, "Surface|number"; "" of one with a single side
  std::string sentence{};
  std::string returns{};  // "Surface"
  std::string example{};  // required, as of a function
  Body body = nullptr;    // its arguments are the two sides in order, the one side twice
};

struct Class {
  std::string name{};          // "Surface"; messages and types
  std::string article_name{};  // "a surface"
  std::string sentence{};
  std::vector<Getter> fields{};
  std::string drawing{};  // of lines, which the reference shows below the fields
  std::vector<Function> methods{};
  std::vector<Operator> operators{};
  std::vector<const RecordInfo*> results{};  // record types returned by its fields and methods
  bool shareable = true;                     // an immutable value, which cases of an ensemble may share
  std::int64_t (*length)(const void* self) = nullptr;       // what # gives; null: nothing
  std::string (*describe)(const void* self) = nullptr;      // one line for print()
  std::size_t (*native_bytes)(const void* self) = nullptr;  // memory Lua cannot see
  bool (*equal)(const void* a, const void* b) = nullptr;
  std::string (*digest)(const void* self) = nullptr;  // of its content, for the journal
  // Adds the cost of this value to the ledger, effect by effect. Called for each result of a heavy call or of
  // a turn of an iterator. Null: nothing to add.
  void (*enter)(const void* self, Ledger& ledger) = nullptr;
  void (*closing)(void* self) = nullptr;  // before it is closed by hand or by <close>
  // Facts known to a dry run about the result of a call; null for classes without such facts.
  std::shared_ptr<const KnownBody> (*known)(const Call& call, const Function& function) = nullptr;
  std::vector<std::string> names() const;  // fields and methods
};

// A constant table entry such as lab.units.deg or lab.rigid.
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
  std::vector<const RecordInfo*> results{};  // record types returned by its functions
  // Called when the module itself is called, as lab.protocol{...} is.
  std::optional<Function> call{};
};

// All modules ("lab" first, parents before children) and classes.
const std::vector<const Module*>& modules();
const std::vector<const Class*>& classes();
const Class* find_class(std::string_view name);

// What a body works with. Lives on the guard's frame.
class Call {
 public:
  Call(lua_State* state, const std::string& function_name, bool is_method)
      : L(state), function_(function_name), first_(is_method ? 2 : 1) {}

  Session& session() const;
  const std::string& function_name() const { return function_; }
  // Positional arguments after self; numbered from 1.
  int count() const { return lua_gettop(L) - first_ + 1; }
  Argument argument(int k) const { return Argument(L, first_ + k - 1); }
  bool given(int k) const { return k <= count() && !argument(k).is_nil(); }

  // The native value the method was called on. Throws Error when called with a dot.
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

  // The options table in argument k, read against its block; every problem in one Error.
  template <class Options>
  Options options(const Block<Options>& block, int k = 1) const {
    return block.read(argument(k), function_, notes_inputs() ? &inputs_ : nullptr);
  }
  // What options() read, for the journal; nothing in a case of an ensemble, which has none.
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

// Writes the journal's line of a heavy call: the native value before the colon (may be null), its inputs, and
// the digest of its results. The registry calls this for every heavy function, an iterator once per turn.
void record_call(const Session& session, const std::string& function, const Object* self,
                 const Resolved& inputs, const Values& results);

// Calls Class::enter for the native values among the results of a heavy call or of an iterator's turn.
void enter_into_ledger(const Session& session, const Values& results);

// Pushes a function or method of the registry; raises on lack of memory (call inside protect).
void push_function(lua_State* L, const Function& function);
// The full name of a function of the registry: "lab.surface.sine", "surface:scaled".
const std::string& qualified_name(const Function& function);
// The full name of the function whose closures hold this pointer as their upvalue; null if none does.
const std::string* name_of_entry(const void* pointer);
// Makes the metatable of a class, if it is not there yet, and pushes it.
void push_metatable(lua_State* L, const Class& type);
// Ends a failed look-up of a field, with its error on the stack: raises the error, or returns a placeholder
// for the field in a dry run that continues after mistakes.
int mistaken_field(lua_State* L);
// The native value at an index if it is one of ours, whatever its class; null otherwise.
Object* native_at(lua_State* L, int index);

// The module whose table is at an index; null if it is none. Does not raise.
const Module* module_at(lua_State* L, int index);
// Pushes this state's table of a module.
void push_proxy(lua_State* L, const Module& module);

// pairs and next in the same order in every process (fixed_order.cpp): numbers, strings by their bytes,
// booleans, then other keys in Lua's own order. A dry run notes a loop over several other keys. A loop visits
// the keys at its beginning, except keys removed since. Both are C functions of Lua without upvalues.
int ordered_pairs(lua_State* L);
int ordered_next(lua_State* L);
// Pushes the iterating function of such a loop over the table at an index. Raises.
void push_ordered_loop(lua_State* L, int index);

// Pushes `lab`, a table of everything. Raises like any luaopen function.
void push_library(lua_State* L);

}  // namespace asperity::lua
