// SPDX-License-Identifier: GPL-3.0-or-later
// What a binding returns: ordinary C++ values that are turned into Lua ones after its body has
// finished, in one protected step. Lists and maps become plain tables; records become read-only
// values that print themselves and complain about unknown fields; objects are native values.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/quantity.hpp"

namespace asperity::lua {

struct Class;
class Call;
class Value;
using Values = std::vector<Value>;

// The native class of T: its name, fields and methods. Specialised beside each binding.
template <class T>
const Class& class_of();

struct KnownBody;
struct RecordInfo;

// A native value. A null pointer is the placeholder of a dry run, unless the value was closed.
struct Object {
  const Class* type = nullptr;
  std::shared_ptr<void> pointer;
  bool closed = false;
  std::shared_ptr<const KnownBody> known = nullptr;  // of the placeholder of a surface, where something is
  bool is_placeholder() const { return pointer == nullptr && !closed; }
};

// A read-only result with named fields in order. print() shows them, `unit` beside the value.
struct Record {
  struct Entry;
  std::string name;  // "roughness"
  std::vector<Entry> entries;
  // Fields that are there only with an effect that the scene did not name: field and effect.
  std::vector<std::pair<std::string, std::string>> missing_effects{};
  const RecordInfo* type = nullptr;  // that describes its fields; null of one that was carried over as bytes
  bool placeholder = false;          // of a dry run, which knows the fields and not their values
  Record& add(std::string field, Value value, Dimension dimension = {});
  // A field that an effect brings: added if it has a value, and otherwise an error that names the effect.
  Record& add_if(std::string effect, std::string field, Value value, Dimension dimension = {});
  const Value* find(std::string_view field) const;
};

// A plain Lua table 1..n, which may carry named fields besides; and one with text keys in order.
struct List {
  Values items;
  std::vector<std::pair<std::string, Value>> named;
  List();
  List(Values values);
};
struct Map {
  std::vector<std::pair<std::string, Value>> items;
};

// What a for loop calls: the next values, or nothing at the end.
struct Iterator {
  std::function<std::optional<Values>(Call&)> next;
  std::string name = "iterator";  // of the call that gave it, "contact:sweep", for errors and the ledger
};

// A value that a dry run cannot know; see placeholder.hpp.
struct Unknown {};

// What a Lua file of scripts/ returns.
struct Script {
  const char* name;
};

// A value kept outside any state, which can be put into one as often as wanted.
class StoredValue {
 public:
  virtual ~StoredValue() = default;
  virtual void push(lua_State* L) const = 0;  // raises on lack of memory: call inside protect()
};

class Value {
 public:
  using Numbers = std::shared_ptr<const Array<double>>;  // a plain table of numbers
  using Rows = std::shared_ptr<const Field>;             // a table of rows, rows[j+1][i+1]
  using Function = lua_CFunction;
  using Variant =
      std::variant<std::monostate, bool, std::int64_t, double, std::string, Object, std::shared_ptr<Record>,
                   std::shared_ptr<List>, std::shared_ptr<Map>, Numbers, Rows, std::shared_ptr<Iterator>,
                   Unknown, Function, Script, std::shared_ptr<const StoredValue>>;

  Value() = default;
  Value(bool v) : data(v) {}
  Value(int v) : data(static_cast<std::int64_t>(v)) {}
  Value(std::int64_t v) : data(v) {}
  Value(double v) : data(v) {}
  Value(const char* v) : data(std::string(v)) {}
  Value(std::string v) : data(std::move(v)) {}
  Value(Object v) : data(std::move(v)) {}
  Value(Record v) : data(std::make_shared<Record>(std::move(v))) {}
  Value(List v) : data(std::make_shared<List>(std::move(v))) {}
  Value(Map v) : data(std::make_shared<Map>(std::move(v))) {}
  Value(Iterator v) : data(std::make_shared<Iterator>(std::move(v))) {}
  Value(Numbers v) : data(std::move(v)) {}
  Value(Rows v) : data(std::move(v)) {}
  Value(Unknown v) : data(v) {}
  Value(Function v) : data(v) {}
  Value(Script v) : data(v) {}
  template <std::derived_from<StoredValue> T>
  Value(std::shared_ptr<const T> v) : data(std::shared_ptr<const StoredValue>(std::move(v))) {}
  template <class T>
  Value(const std::optional<T>& v) {
    if (v) *this = Value(*v);
  }

  bool is_nil() const { return std::holds_alternative<std::monostate>(data); }
  // The number held as integer or double, if it is one.
  std::optional<double> number() const;

  Variant data;
};

struct Record::Entry {
  std::string field;
  Value value;
  Dimension dimension;
};

inline List::List() = default;
inline List::List(Values values) : items(std::move(values)) {}
// A table of texts.
List text_list(const std::vector<std::string>& items);

// A native value for Lua. T needs a class_of<T>.
template <class T>
Value object(T value) {
  return Object{&class_of<T>(), std::make_shared<T>(std::move(value)), false};
}
template <class T>
Value object(std::shared_ptr<T> pointer) {
  return Object{&class_of<std::remove_const_t<T>>(),
                std::const_pointer_cast<std::remove_const_t<T>>(std::move(pointer)), false};
}

// A value as print shows it; a record on one line; the entry of a record with its unit.
std::string show(const Value& value);
std::string show(const Record::Entry& entry);

// Pushes one value. Raises on lack of memory: call inside protect().
void push(lua_State* L, const Value& value);

}  // namespace asperity::lua
