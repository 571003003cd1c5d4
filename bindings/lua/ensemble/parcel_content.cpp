// SPDX-License-Identifier: GPL-3.0-or-later
// What a function and everything it reaches would do, as a digest that other processes of this build come to
// as well: nothing in it depends on addresses or on the order of keys in memory.
#include <dlfcn.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "bindings/lua/ensemble/parcel.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/runtime/code_digest.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/surface/grid_keys.hpp"
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

}  // namespace

// Nodes and cells are numbered in the order in which sorted keys and upvalues lead to them.
struct Parcel::ContentDigest {
  const Parcel& parcel;
  const ScriptSpelling& spelling;
  Digester digester{}, lines{};
  bool whole = true;
  std::vector<std::int64_t> node_number = std::vector<std::int64_t>(parcel.nodes_.size(), -1);
  std::vector<std::int64_t> cell_number = std::vector<std::int64_t>(parcel.cells_.size(), -1);
  std::vector<std::uint32_t> nodes{}, cells{};
  std::size_t node_done = 0, cell_done = 0;
  std::optional<std::uint32_t> arguments{};  // the node of `arg`, where only its name leads there
  bool names_arguments = false;

  static std::int64_t number(std::uint32_t id, std::vector<std::int64_t>& numbers,
                             std::vector<std::uint32_t>& order) {
    if (numbers[id] < 0) {
      numbers[id] = static_cast<std::int64_t>(order.size());
      order.push_back(id);
    }
    return numbers[id];
  }

  // A function of the program: where it lies in the file it was loaded from.
  void add_place(const void* address) {
    Dl_info file{};
    if (address == nullptr || ::dladdr(address, &file) == 0 || file.dli_fbase == nullptr) {
      whole = false;
      return;
    }
    digester.add(static_cast<std::int64_t>(static_cast<const char*>(address) -
                                           static_cast<const char*>(file.dli_fbase)));
  }

  void add(const Object& object) {
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
      if (surface.recipe() != nullptr) whole = false;  // what it gives on other cells is not known
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
  template <class Named>
  void add_named(const Named& named) {
    digester.add(static_cast<std::int64_t>(named.size()));
    for (const auto& [key, item] : named) {
      digester.add(key);
      add(item);
    }
  }
  void add(const Value& value) {
    digester.add(static_cast<int>(value.data.index()));
    std::visit(
        [&](const auto& held) {
          using Held = std::decay_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, std::monostate>) {
          } else if constexpr (std::is_same_v<Held, bool>) {
            digester.add(held ? 1 : 0);
          } else if constexpr (std::is_same_v<Held, std::int64_t> || std::is_same_v<Held, double> ||
                               std::is_same_v<Held, std::string>) {
            digester.add(held);
          } else if constexpr (std::is_same_v<Held, Object>) {
            add(held);
          } else if constexpr (std::is_same_v<Held, std::shared_ptr<Record>>) {
            digester.add(held->name);
            digester.add(static_cast<std::int64_t>(held->entries.size()));
            for (const Record::Entry& entry : held->entries) {
              digester.add(entry.field);
              add(entry.value);
            }
          } else if constexpr (std::is_same_v<Held, std::shared_ptr<List>>) {
            digester.add(static_cast<std::int64_t>(held->items.size()));
            for (const Value& item : held->items) add(item);
            add_named(held->named);
          } else if constexpr (std::is_same_v<Held, std::shared_ptr<Map>>) {
            add_named(held->items);
          } else if constexpr (std::is_same_v<Held, Value::Numbers>) {
            digester.add(std::span<const double>(*held));
          } else if constexpr (std::is_same_v<Held, Value::Rows>) {
            digester.add(held->nx()).add(held->values());
          } else {
            whole = false;
          }
        },
        value.data);
  }
  void add(const Item& item) {
    digester.add(static_cast<int>(item.index()));  // "1" is not 1
    std::visit(
        [&](const auto& held) {
          using Held = std::decay_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, std::monostate>) {
          } else if constexpr (std::is_same_v<Held, bool>) {
            digester.add(held ? 1 : 0);
          } else if constexpr (std::is_same_v<Held, NodeId>) {
            digester.add(number(held.index, node_number, nodes));
          } else if constexpr (std::is_same_v<Held, BaseId>) {
            add(parcel.bases_[held.index]);
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

  // The script's own name, as it was typed.
  bool is_script_name(const Entry& entry) const {
    const auto* key = std::get_if<std::int64_t>(&entry.key);
    const auto* name = std::get_if<std::string>(&entry.value);
    return key != nullptr && *key == 0 && name != nullptr && *name == spelling.path;
  }
  bool is_arguments(const Addition& addition) const {
    const BasePath& base = parcel.bases_[addition.table.index];
    const auto* key = std::get_if<std::string>(&addition.entry.key);
    return base.library == "_G" && base.key.empty() && key != nullptr && *key == "arg" &&
           std::holds_alternative<NodeId>(addition.entry.value);
  }
  // The path of `require` as a script's state begins with it.
  bool is_path_of_script(const Addition& addition) const {
    const BasePath& base = parcel.bases_[addition.table.index];
    const auto *key = std::get_if<std::string>(&addition.entry.key),
               *path = std::get_if<std::string>(&addition.entry.value);
    return base.library == "package" && base.key.empty() && key != nullptr && *key == "path" &&
           path != nullptr && !spelling.folder.empty() && *path == search_path(spelling.folder);
  }
  // A constant of that text in the code, as Lua dumps it: its length and one, marked, and its bytes.
  static bool names_arg(const ScriptFunction& function) {
    return function.code.find(
               "\x84"
               "arg") != std::string::npos;
  }

  void add(const Table& table, bool without_script_name = false) {
    Array<Entry> entries = table.entries;
    if (without_script_name)
      std::erase_if(entries, [&](const Entry& entry) { return is_script_name(entry); });
    // Keys that have no order of their own keep that of memory: two runs may then differ, and not find.
    std::sort(entries.begin(), entries.end(), before);
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
    for (const std::uint32_t cell : function.cells) digester.add(number(cell, cell_number, cells));
  }
  void add(const HostFunction& function) {
    digester.add("native");
    add(Item(function.function));
    for (const Item& upvalue : function.upvalues) add(upvalue);
  }

  void everything_reached() {
    while (node_done < nodes.size() || cell_done < cells.size()) {
      if (node_done < nodes.size()) {
        const std::uint32_t node = nodes[node_done++];
        const Table* table = std::get_if<Table>(&parcel.nodes_[node]);
        if (table != nullptr && arguments == node && !names_arguments)
          add(*table, true);
        else
          std::visit([&](const auto& held) { add(held); }, parcel.nodes_[node]);
      } else
        add(parcel.cells_[cells[cell_done++]].value);
    }
  }

  Content all() {
    add(parcel.root_);
    everything_reached();
    digester.add(parcel.strict_globals_ ? 1 : 0);
    std::vector<const Addition*> additions;
    for (const Addition& addition : parcel.additions_) additions.push_back(&addition);
    std::ranges::sort(additions, [&](const Addition* a, const Addition* b) {
      const BasePath &first = parcel.bases_[a->table.index], &second = parcel.bases_[b->table.index];
      if (first.library != second.library) return first.library < second.library;
      return before(a->entry, b->entry);
    });
    // Globals may be functions that name `arg`: all of them come before it.
    const Addition* last = nullptr;
    for (const Addition* addition : additions) {
      if (is_path_of_script(*addition)) continue;
      if (is_arguments(*addition)) {
        last = addition;
        continue;
      }
      add(parcel.bases_[addition->table.index]);
      add(addition->entry.key);
      add(addition->entry.value);
    }
    everything_reached();
    if (last == nullptr) return {digester.hex(), lines.hex(), whole};
    const std::uint32_t node = std::get<NodeId>(last->entry.value).index;
    if (node_number[node] < 0) arguments = node;
    add(parcel.bases_[last->table.index]);
    add(last->entry.key);
    add(last->entry.value);
    everything_reached();
    return {digester.hex(), lines.hex(), whole};
  }
};

Parcel::Content Parcel::content(const ScriptSpelling& spelling) const {
  return ContentDigest{*this, spelling}.all();
}

}  // namespace asperity::lua
