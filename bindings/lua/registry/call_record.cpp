// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/call_record.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>

#include "bindings/lua/registry/declarations.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/digest.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

constexpr std::array<std::string_view, 3> costs = {"cost", "seconds", "bytes"};

struct Adder : ValueVisitor {
  Digester digester{};
  // A number or a native value with a digest was added.
  bool anything = false;

  using ValueVisitor::enter;
  void enter(const Record& record) { digester.add(record.name); }
  void enter(const List& list) { digester.add(static_cast<std::int64_t>(list.items.size())); }
  bool under(const std::string& name) {
    if (std::find(costs.begin(), costs.end(), name) != costs.end()) return false;
    digester.add(name);
    return true;
  }

  template <class T>
  void leaf(const T& held) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>) {
      digester.add(held);
      anything = true;
    } else if constexpr (std::is_same_v<T, std::string>) {
      digester.add(held);
    } else if constexpr (std::is_same_v<T, Object>) {
      const std::string digest = digest_of(held);
      digester.add(digest);
      anything = anything || !digest.empty();
    } else if constexpr (std::is_same_v<T, Value::Numbers>) {
      digester.add(std::span<const double>(*held));
      anything = true;
    } else if constexpr (std::is_same_v<T, Value::Rows>) {
      digester.add(held->nx()).add(held->values());
      anything = true;
    }  // iterators, functions and nil have no content
  }
};

}  // namespace

std::string digest_of(const Object& object) {
  return object.pointer == nullptr || object.type->digest == nullptr
             ? ""
             : object.type->digest(object.pointer.get());
}

std::string digest_of(const Values& results) {
  if (results.size() == 1)
    if (const auto* object = std::get_if<Object>(&results.front().data)) return digest_of(*object);
  Adder adder;
  for (const Value& result : results) visit_value(result, adder);
  return adder.anything ? adder.digester.hex() : "";
}

void record_call(const Session& session, const std::string& function, const Object* self,
                 const Resolved& inputs, const Values& results) {
  if (session.run == nullptr || session.is_case) return;
  Json line = Json::object();
  line.set("function", function);
  if (self != nullptr)
    if (const std::string digest = digest_of(*self); !digest.empty()) line.set("self", digest);
  Json given = Json::object();
  for (const auto& [key, text] : inputs) given.set(key, text);
  line.set("inputs", given);
  if (const std::string digest = digest_of(results); !digest.empty()) line.set("result", digest);
  session.run->journal().write("call", line);
  if (session.onlooker) session.onlooker(function, results);
}

void enter_into_ledger(const Session& session, const Values& results) {
  for (const Value& result : results) {
    const auto* object = std::get_if<Object>(&result.data);
    if (object != nullptr && object->pointer != nullptr && object->type->enter != nullptr)
      object->type->enter(object->pointer.get(), *session.ledger);
  }
}

}  // namespace asperity::lua
