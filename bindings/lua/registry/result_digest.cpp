// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/result_digest.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>

#include "bindings/lua/registry/registry.hpp"
#include "engine/core/digest.hpp"

namespace asperity::lua {

namespace {

constexpr std::array<std::string_view, 3> costs = {"cost", "seconds", "bytes"};

class Adder {
 public:
  explicit Adder(Digester& digester) : digester_(digester) {}
  // Numbers, or native values with digests, were among what was added.
  bool anything = false;

  void add(const Value& value) {
    std::visit([this](const auto& held) { add_held(held); }, value.data);
  }
  void add(std::string_view name, const Value& value) {
    if (std::find(costs.begin(), costs.end(), name) != costs.end()) return;
    digester_.add(name);
    add(value);
  }

 private:
  template <class T>
  void add_held(const T& held) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>) {
      digester_.add(held);
      anything = true;
    } else if constexpr (std::is_same_v<T, std::string>) {
      digester_.add(held);
    } else if constexpr (std::is_same_v<T, Object>) {
      const std::string digest = digest_of(held);
      digester_.add(digest);
      anything = anything || !digest.empty();
    } else if constexpr (std::is_same_v<T, Value::Numbers>) {
      digester_.add(std::span<const double>(*held));
      anything = true;
    } else if constexpr (std::is_same_v<T, Value::Rows>) {
      digester_.add(held->nx()).add(held->values());
      anything = true;
    } else if constexpr (std::is_same_v<T, std::shared_ptr<Record>>) {
      digester_.add(held->name);
      for (const Record::Entry& entry : held->entries) add(entry.field, entry.value);
    } else if constexpr (std::is_same_v<T, std::shared_ptr<List>>) {
      digester_.add(static_cast<std::int64_t>(held->items.size()));
      for (const Value& item : held->items) add(item);
      for (const auto& [name, value] : held->named) add(name, value);
    } else if constexpr (std::is_same_v<T, std::shared_ptr<Map>>) {
      for (const auto& [name, value] : held->items) add(name, value);
    }  // iterators, functions and nothing have no content
  }

  Digester& digester_;
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
  Digester digester;
  Adder adder(digester);
  for (const Value& result : results) adder.add(result);
  return adder.anything ? digester.hex() : "";
}

}  // namespace asperity::lua
