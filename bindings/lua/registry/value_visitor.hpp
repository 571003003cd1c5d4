// SPDX-License-Identifier: GPL-3.0-or-later
// Depth-first traversal of a binding's result, each container in its own order. Results contain no cycles,
// because they are immutable; tables of a script may (ensemble/transfer.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>

#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

// Derived visitors hide the functions they need, and provide `leaf` for each Value alternative without
// contents.
struct ValueVisitor {
  void begin(const Value&) {}  // before and after each value
  void end() {}
  void enter(const Record&) {}
  void enter(const List&) {}
  void enter(const Map&) {}
  void leave(const Record&) {}
  void named(std::size_t) {}                       // named values that follow, in a list or map
  bool under(const std::string&) { return true; }  // before a named value; false skips it
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
