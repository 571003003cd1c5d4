// SPDX-License-Identifier: GPL-3.0-or-later
// Digests of rows, for journals, and of functions with everything they reach; equal in all processes of this
// build. Nodes are numbered by a traversal with sorted keys, not by addresses.
#include <dlfcn.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/value.hpp"
#include "bindings/lua/runtime/code_digest.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/digest.hpp"

namespace asperity::lua {

namespace {

void add(Digester& digester, const std::optional<double>& value) {
  digester.add(value.has_value() ? 1 : 0);
  if (value) digester.add(*value);
}

void add(Digester& digester, const Material& material) {
  digester.add(material.name).add(material.source).add(material.rigid ? 1 : 0);
  for (const auto& property : {material.young, material.poisson, material.hardness, material.density})
    add(digester, property);
}

// Numbers by first visit.
class MetOrder {
 public:
  explicit MetOrder(std::size_t count) : numbers_(count, -1) {}
  bool knows(std::uint32_t id) const { return numbers_[id] >= 0; }
  std::int64_t number(std::uint32_t id) {
    if (!knows(id)) {
      numbers_[id] = static_cast<std::int64_t>(order_.size());
      order_.push_back(id);
    }
    return numbers_[id];
  }
  std::optional<std::uint32_t> next() {
    return done_ < order_.size() ? std::optional(order_[done_++]) : std::nullopt;
  }

 private:
  std::vector<std::int64_t> numbers_;
  std::vector<std::uint32_t> order_;
  std::size_t done_ = 0;
};

}  // namespace

bool PackedValue::before(const Entry& a, const Entry& b) {
  const auto rank = [](const Item& item) {
    return std::holds_alternative<std::int64_t>(item) || std::holds_alternative<double>(item) ? 0
           : std::holds_alternative<std::string>(item)                                        ? 1
                                                                                              : 2;
  };
  const int rank_a = rank(a.key), rank_b = rank(b.key);
  if (rank_a != rank_b) return rank_a < rank_b;
  if (rank_a == 1) return std::get<std::string>(a.key) < std::get<std::string>(b.key);
  if (rank_a == 2)
    return std::holds_alternative<bool>(a.key) && std::holds_alternative<bool>(b.key) &&
           std::get<bool>(a.key) < std::get<bool>(b.key);
  if (const auto* i = std::get_if<std::int64_t>(&a.key))
    if (const auto* j = std::get_if<std::int64_t>(&b.key)) return *i < *j;
  const auto number_of = [](const Item& item) {
    const auto* whole = std::get_if<std::int64_t>(&item);
    return whole != nullptr ? static_cast<double>(*whole) : std::get<double>(item);
  };
  return number_of(a.key) < number_of(b.key);
}

// Keys without an order keep their order in memory: stored results may be missed.
Array<PackedValue::Entry> PackedValue::in_order(Array<Entry> entries) {
  std::sort(entries.begin(), entries.end(), before);
  return entries;
}

struct PackedValue::ContentDigest : ValueVisitor {
  const PackedValue& packed;
  ScriptSpelling spelling;
  Digester digester{}, lines{};
  bool whole = true;
  MetOrder nodes{packed.nodes_.size()}, cells{packed.cells_.size()};
  std::optional<std::uint32_t> arguments{};  // node of `arg`, if only named
  bool names_arguments = false;

  ContentDigest(const PackedValue& reached, const ScriptSpelling& names) : packed(reached), spelling(names) {}

  // Its offset in the loaded file.
  void add_place(const void* address) {
    Dl_info file{};
    if (address == nullptr || ::dladdr(address, &file) == 0 || file.dli_fbase == nullptr) {
      whole = false;
      return;
    }
    digester.add(static_cast<std::int64_t>(static_cast<const char*>(address) -
                                           static_cast<const char*>(file.dli_fbase)));
  }

  void begin(const Value& value) { digester.add(static_cast<int>(value.data.index())); }
  using ValueVisitor::enter;
  void enter(const Record& record) {
    digester.add(record.name);
    named(record.entries.size());
  }
  void enter(const List& list) { digester.add(static_cast<std::int64_t>(list.items.size())); }
  void named(std::size_t count) { digester.add(static_cast<std::int64_t>(count)); }
  bool under(const std::string& name) {
    digester.add(name);
    return true;
  }
  void leaf(std::monostate) {}
  void leaf(bool truth) { digester.add(truth ? 1 : 0); }
  void leaf(std::int64_t number) { digester.add(number); }
  void leaf(double number) { digester.add(number); }
  void leaf(const std::string& text) { digester.add(text); }
  void leaf(const Value::Numbers& numbers) { digester.add(std::span<const double>(*numbers)); }
  void leaf(const Value::Rows& rows) { digester.add(rows->nx()).add(rows->values()); }
  void leaf(const auto&) { whole = false; }
  void leaf(const Object& object) {
    digester.add(object.type->name);
    if (object.pointer == nullptr) return;
    if (object.type == &class_of<Material>()) {
      asperity::lua::add(digester, *static_cast<const Material*>(object.pointer.get()));
    } else if (object.type == &class_of<Surface>()) {
      const auto& surface = *static_cast<const Surface*>(object.pointer.get());
      digester.add(surface.digest()).add(surface.traits().periodic ? 1 : 0);
      asperity::lua::add(digester, surface.traits().aliased_share);
      digester.add(surface.material() ? 1 : 0);
      if (surface.material()) asperity::lua::add(digester, *surface.material());
      if (surface.recipe() != nullptr) whole = false;  // unknown on other cells
    } else if (object.type == &class_of<Profile>()) {
      digester.add(static_cast<const Profile*>(object.pointer.get())->digest());
    } else {
      whole = false;
      if (object.type->digest != nullptr)
        digester.add(object.type->digest(object.pointer.get()));
      else if (object.type->describe != nullptr)
        digester.add(object.type->describe(object.pointer.get()));
    }
  }
  void add(const Value& value) { visit_value(value, *this); }
  void add(const Item& item) {
    digester.add(static_cast<int>(item.index()));  // distinguishes "1" from 1
    std::visit(
        [&](const auto& held) {
          using Held = std::decay_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, std::monostate>) {
          } else if constexpr (std::is_same_v<Held, bool>) {
            digester.add(held ? 1 : 0);
          } else if constexpr (std::is_same_v<Held, NodeId>) {
            digester.add(nodes.number(held.index));
          } else if constexpr (std::is_same_v<Held, BaseId>) {
            add(packed.bases_[held.index]);
          } else if constexpr (std::is_same_v<Held, const Module*>) {
            digester.add(held->path);
          } else if constexpr (std::is_same_v<Held, lua_CFunction>) {
            if (const BasePath* path = base_function(held); path != nullptr)
              add(*path);
            else
              add_place(reinterpret_cast<const void*>(held));
          } else if constexpr (std::is_same_v<Held, void*>) {
            if (const std::string* name = name_of_entry(held); name != nullptr)
              digester.add(*name);
            else
              add_place(held);
          } else if constexpr (std::is_same_v<Held, Unknown>) {
            whole = false;
          } else {
            digester.add(held);
          }
        },
        item);
  }
  void add(const BasePath& path) { digester.add(path.library).add(path.key); }

  bool is_script_name(const Entry& entry) const {
    const auto* key = std::get_if<std::int64_t>(&entry.key);
    const auto* name = std::get_if<std::string>(&entry.value);
    return key != nullptr && *key == 0 && name != nullptr && *name == spelling.path;
  }
  bool is_arguments(const Addition& addition) const {
    const BasePath& base = packed.bases_[addition.table.index];
    const auto* key = std::get_if<std::string>(&addition.entry.key);
    return base.library == "_G" && base.key.empty() && key != nullptr && *key == "arg" &&
           std::holds_alternative<NodeId>(addition.entry.value);
  }
  // The initial path of `require`.
  bool is_path_of_script(const Addition& addition) const {
    const BasePath& base = packed.bases_[addition.table.index];
    const auto *key = std::get_if<std::string>(&addition.entry.key),
               *path = std::get_if<std::string>(&addition.entry.value);
    return base.library == "package" && base.key.empty() && key != nullptr && *key == "path" &&
           path != nullptr && !spelling.folder.empty() && *path == search_path(spelling.folder);
  }
  // "arg" as a constant in dumped code: marked length plus one, then bytes.
  static bool names_arg(const ScriptFunction& function) {
    return function.code.find(
               "\x84"
               "arg") != std::string::npos;
  }

  void add(const Table& table, bool without_script_name = false) {
    Array<Entry> entries = in_order(table.entries);
    if (without_script_name)
      std::erase_if(entries, [&](const Entry& entry) { return is_script_name(entry); });
    digester.add("table").add(static_cast<std::int64_t>(entries.size()));
    for (const Entry& entry : entries) {
      add(entry.key);
      add(entry.value);
    }
    add(table.metatable);
  }
  void add(const ScriptFunction& function) {
    digester.add("function").add(code_digest(function.code));
    lines.add(code_digest(function.code, CodeLines::counted));
    names_arguments = names_arguments || names_arg(function);
    for (const std::uint32_t cell : function.cells) digester.add(cells.number(cell));
  }
  void add(const HostFunction& function) {
    digester.add("native");
    add(Item(function.function));
    for (const Item& upvalue : function.upvalues) add(upvalue);
  }

  void everything_reached() {
    for (;;) {
      if (const auto node = nodes.next()) {
        const Table* table = std::get_if<Table>(&packed.nodes_[*node]);
        if (table != nullptr && arguments == *node && !names_arguments)
          add(*table, true);
        else
          std::visit([&](const auto& held) { add(held); }, packed.nodes_[*node]);
      } else if (const auto cell = cells.next()) {
        add(packed.cells_[*cell].value);
      } else {
        return;
      }
    }
  }

  std::string of_data() {
    add(packed.root_);
    everything_reached();
    return digester.hex();
  }

  Content all() {
    of_data();
    digester.add(packed.strict_globals_ ? 1 : 0);
    std::vector<const Addition*> additions;
    for (const Addition& addition : packed.additions_) additions.push_back(&addition);
    std::ranges::sort(additions, [&](const Addition* a, const Addition* b) {
      const BasePath &first = packed.bases_[a->table.index], &second = packed.bases_[b->table.index];
      if (first.library != second.library) return first.library < second.library;
      return before(a->entry, b->entry);
    });
    // Last, because other globals may use `arg`.
    const Addition* last = nullptr;
    for (const Addition* addition : additions) {
      if (is_path_of_script(*addition)) continue;
      if (is_arguments(*addition)) {
        last = addition;
        continue;
      }
      add(packed.bases_[addition->table.index]);
      add(addition->entry.key);
      add(addition->entry.value);
    }
    everything_reached();
    if (last == nullptr) return {digester.hex(), lines.hex(), whole};
    const std::uint32_t node = std::get<NodeId>(last->entry.value).index;
    if (!nodes.knows(node)) arguments = node;
    add(packed.bases_[last->table.index]);
    add(last->entry.key);
    add(last->entry.value);
    everything_reached();
    return {digester.hex(), lines.hex(), whole};
  }
};

std::string PackedValue::digest() const { return ContentDigest(*this, {}).of_data(); }

PackedValue::Content PackedValue::content(const ScriptSpelling& spelling) const {
  return ContentDigest(*this, spelling).all();
}

}  // namespace asperity::lua
