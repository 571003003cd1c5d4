// SPDX-License-Identifier: GPL-3.0-or-later
// The one way through a value that a binding returned: records, lists and maps with all they hold, depth
// first, each in its own order. What is done on the way (a digest, bytes, a question) is a visitor. These
// values hold no circles: they are made whole and never changed. Tables of a script may hold some; they are
// gone through where they are packed (ensemble/transfer.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>

#include "bindings/lua/registry/value.hpp"

namespace asperity::lua {

// What a visitor may hear of; it hides what it wants to know, and has `leaf` for each alternative of Value
// that holds no other value.
struct ValueVisitor {
  void begin(const Value&) {}  // before each value, and after it
  void end() {}
  void enter(const Record&) {}
  void enter(const List&) {}
  void enter(const Map&) {}
  void leave(const Record&) {}
  void named(std::size_t) {}                       // so many values under names follow, in a list or map
  bool under(const std::string&) { return true; }  // before a value with a name; false passes it by
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
