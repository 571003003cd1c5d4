// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a binding: C++ values, converted to Lua in one protected step after the body.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
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

// The binding of T declares make_class(For<T>).
template <class T>
struct For {};
template <class T>
const Class& class_of();

struct KnownBody;
struct RecordInfo;

// Null pointer: a dry run's placeholder, or a closed value.
struct Object {
  const Class* type = nullptr;
  std::shared_ptr<void> pointer;
  bool closed = false;
  std::shared_ptr<const KnownBody> known = nullptr;  // known facts about a placeholder
  bool is_placeholder() const { return pointer == nullptr && !closed; }
};

// A read-only result with ordered fields. print() shows units.
struct Record {
  struct Entry;
  std::string name;  // "roughness"
  std::vector<Entry> entries;
  // With the effects that would provide them.
  std::vector<std::pair<std::string, std::string>> missing_effects{};
  const RecordInfo* type = nullptr;  // null if restored from bytes
  bool placeholder = false;          // fields without values
  Record& add(std::string field, Value value, Dimension dimension = {});
  // Without a value, reading the field is an error that names the effect.
  Record& add_if(std::string effect, std::string field, Value value, Dimension dimension = {});
  const Value* find(std::string_view field) const;
};

// List: a Lua table 1..n with optional named fields. A list of rows has the methods of a Table. Map: text
// keys in order.
struct List {
  Values items;
  std::vector<std::pair<std::string, Value>> named;
  bool rows = false;
  std::vector<std::pair<std::string, std::string>> units{};  // of columns of rows, for display
  std::string unit{};                                        // of numbers in SI, for print
  List();
  List(Values values);
};
struct Map {
  std::vector<std::pair<std::string, Value>> items;
};

// Nothing at the end.
struct Iterator {
  std::function<std::optional<Values>(Call&)> next;
  std::string name = "iterator";  // the creating call, "contact:sweep"
  std::string place{};            // until the first turn
  // For a method :table, which takes all turns; may be null.
  std::function<Value(Call&, const std::function<std::optional<Values>()>& turn)> table = nullptr;
};

struct Unknown {
  const RecordInfo* item = nullptr;  // of a list of records
};

// From a file of scripts/.
struct Script {
  const char* name;
};

// Outside any state, for repeated use.
class StoredValue {
 public:
  virtual ~StoredValue() = default;
  virtual void push(lua_State* L) const = 0;  // raises: call inside protect()
};

class Value {
 public:
  using Numbers = std::shared_ptr<const Array<double>>;  // a table of numbers
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
  // Integer or double.
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
Value::Numbers number_list(std::span<const double> values);

template <class T>
Value object(T value) {
  return Object{&class_of<T>(), std::make_shared<T>(std::move(value)), false};
}
template <class T>
Value object(std::shared_ptr<T> pointer) {
  return Object{&class_of<std::remove_const_t<T>>(),
                std::const_pointer_cast<std::remove_const_t<T>>(std::move(pointer)), false};
}

// Depth-first traversal of a binding's result, each container in its own order. Results are immutable,
// without cycles; tables of a script may have cycles (ensemble/transfer.hpp).

// Derived visitors hide the functions they need, and provide `leaf` for each Value alternative without
// contents.
struct ValueVisitor {
  void begin(const Value&) {}  // before and after each value
  void end() {}
  void enter(const Record&) {}
  void enter(const List&) {}
  void enter(const Map&) {}
  void leave(const Record&) {}
  void named(std::size_t) {}                       // number of named values to come
  bool under(const std::string&) { return true; }  // a named value; false skips it
  void after(const Record::Entry&) {}
};

template <class Visitor>
void visit_value(const Value& value, Visitor& visitor) {
  const auto visit_named = [&](const auto& named) {
    visitor.named(named.size());
    for (const auto& [name, item] : named)
      if (visitor.under(name)) visit_value(item, visitor);
  };
  visitor.begin(value);
  std::visit(
      [&](const auto& held) {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::shared_ptr<Record>>) {
          visitor.enter(*held);
          for (const Record::Entry& entry : held->entries) {
            if (visitor.under(entry.field)) visit_value(entry.value, visitor);
            visitor.after(entry);
          }
          visitor.leave(*held);
        } else if constexpr (std::is_same_v<Held, std::shared_ptr<List>>) {
          visitor.enter(*held);
          for (const Value& item : held->items) visit_value(item, visitor);
          visit_named(held->named);
        } else if constexpr (std::is_same_v<Held, std::shared_ptr<Map>>) {
          visitor.enter(*held);
          visit_named(held->items);
        } else {
          visitor.leaf(held);
        }
      },
      value.data);
  visitor.end();
}

}  // namespace asperity::lua
