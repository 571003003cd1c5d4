// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/parcel.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>

#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/core/digest.hpp"

namespace asperity::lua {

namespace {

template <class... Visitors>
struct Overload : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overload(Visitors...) -> Overload<Visitors...>;

struct CodeCursor {
  const std::string* code;
  bool read;
};

const char* read_code(lua_State*, void* data, std::size_t* size) {
  auto& cursor = *static_cast<CodeCursor*>(data);
  *size = cursor.read ? 0 : cursor.code->size();
  cursor.read = true;
  return *size == 0 ? nullptr : cursor.code->data();
}

int clipped(std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, 1 << 26)); }

}  // namespace

// Lua may raise out of any of these calls, so nothing here owns anything.
struct Parcel::Pusher {
  const Parcel& parcel;
  lua_State* L;
  int made;   // list of the nodes
  int bases;  // list of the values of Lua's library that the parcel refers to

  void item(const Item& value) const {
    std::visit(
        Overload{[&](std::monostate) { lua_pushnil(L); }, [&](bool v) { lua_pushboolean(L, v ? 1 : 0); },
                 [&](std::int64_t v) { lua_pushinteger(L, v); }, [&](double v) { lua_pushnumber(L, v); },
                 [&](const std::string& v) { lua_pushlstring(L, v.data(), v.size()); },
                 [&](NodeId v) { lua_rawgeti(L, made, static_cast<lua_Integer>(v.index) + 1); },
                 [&](BaseId v) { lua_rawgeti(L, bases, static_cast<lua_Integer>(v.index) + 1); },
                 [&](const Module* v) { push_proxy(L, *v); },
                 [&](lua_CFunction v) { lua_pushcfunction(L, v); },
                 [&](void* v) { lua_pushlightuserdata(L, v); }, [&](Unknown) { push_unknown(L); }},
        value);
  }

  void make(const Table& table) const {
    lua_createtable(
        L, clipped(table.length),
        clipped(table.entries.size() - std::min<std::size_t>(table.length, table.entries.size())));
  }
  void make(const ScriptFunction& function) const {
    CodeCursor cursor{&function.code, false};
    if (lua_load(L, read_code, &cursor, "=transferred", "b") != LUA_OK) lua_error(L);
  }
  void make(const HostFunction& function) const {
    const int upvalues = static_cast<int>(function.upvalues.size());
    luaL_checkstack(L, upvalues + 4, nullptr);
    for (int k = 0; k < upvalues; ++k) lua_pushnil(L);
    lua_pushcclosure(L, function.function, upvalues);
  }
  void make(const Value& value) const { lua::push(L, value); }

  // Fills what make() left on the stack.
  void fill(const Table& table, std::size_t) const {
    for (const Entry& entry : table.entries) {
      item(entry.key);
      item(entry.value);
      lua_rawset(L, -3);
    }
    if (std::holds_alternative<std::monostate>(table.metatable)) return;
    item(table.metatable);
    lua_setmetatable(L, -2);
  }
  void fill(const ScriptFunction& function, std::size_t node) const {
    for (std::size_t k = 0; k < function.cells.size(); ++k) {
      const Cell& cell = parcel.cells_[function.cells[k]];
      const int upvalue = static_cast<int>(k) + 1;
      if (cell.node == node && cell.upvalue == upvalue) {
        item(cell.value);
        lua_setupvalue(L, -2, upvalue);
      } else {
        item(NodeId{cell.node});
        lua_upvaluejoin(L, -2, upvalue, -1, cell.upvalue);
        lua_pop(L, 1);
      }
    }
  }
  void fill(const HostFunction& function, std::size_t) const {
    for (std::size_t k = 0; k < function.upvalues.size(); ++k) {
      item(function.upvalues[k]);
      lua_setupvalue(L, -2, static_cast<int>(k) + 1);
    }
  }
  void fill(const Value&, std::size_t) const {}

  void everything() const {
    // Lua's own values first: the script may have put others in their place.
    for (std::size_t k = 0; k < parcel.bases_.size(); ++k) {
      push_base(L, parcel.bases_[k]);
      lua_rawseti(L, bases, static_cast<lua_Integer>(k) + 1);
    }
    for (std::size_t k = 0; k < parcel.nodes_.size(); ++k) {
      std::visit([&](const auto& node) { make(node); }, parcel.nodes_[k]);
      lua_rawseti(L, made, static_cast<lua_Integer>(k) + 1);
    }
    for (std::size_t k = 0; k < parcel.nodes_.size(); ++k) {
      if (std::holds_alternative<Value>(parcel.nodes_[k])) continue;
      lua_rawgeti(L, made, static_cast<lua_Integer>(k) + 1);
      std::visit([&](const auto& node) { fill(node, k); }, parcel.nodes_[k]);
      lua_pop(L, 1);
    }
    for (const Addition& addition : parcel.additions_) {
      item(addition.table);
      item(addition.entry.key);
      item(addition.entry.value);
      lua_rawset(L, -3);
      lua_pop(L, 1);
    }
  }
};

void Parcel::push(lua_State* L) const {
  luaL_checkstack(L, 16, "a value is too large");
  if (!strict_globals_) {
    lua_pushglobaltable(L);
    lua_pushnil(L);
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
  }
  lua_createtable(L, clipped(nodes_.size()), 0);
  lua_createtable(L, clipped(bases_.size()), 0);
  const int top = lua_gettop(L);
  const Pusher pusher{*this, L, top - 1, top};
  pusher.everything();
  pusher.item(root_);
  lua_replace(L, top - 1);
  lua_settop(L, top - 1);
}

bool Parcel::before(const Entry& a, const Entry& b) {
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

// Tables are numbered in the order in which the sorted keys lead to them.
struct Parcel::Digest {
  const Parcel& parcel;
  Digester digester{};
  std::vector<std::int64_t> number = std::vector<std::int64_t>(parcel.nodes_.size(), -1);
  std::vector<std::uint32_t> order{};

  void add(const Object& object) {
    digester.add(object.type->name);
    if (object.pointer == nullptr)
      digester.add("");
    else if (object.type->digest != nullptr)
      digester.add(object.type->digest(object.pointer.get()));
    else
      digester.add(object.type->describe != nullptr ? object.type->describe(object.pointer.get()) : "");
  }
  void add(const Value& value) {
    std::visit(Overload{[&](bool v) { digester.add(v ? "true" : "false"); },
                        [&](std::int64_t v) { digester.add(v); }, [&](double v) { digester.add(v); },
                        [&](const std::string& v) { digester.add(v); }, [&](const Object& v) { add(v); },
                        [&](const std::shared_ptr<Record>& v) {
                          digester.add(v->name);
                          for (const Record::Entry& entry : v->entries) {
                            digester.add(entry.field);
                            add(entry.value);
                          }
                        },
                        [&](const std::shared_ptr<List>& v) {
                          digester.add(static_cast<std::int64_t>(v->items.size()));
                          for (const Value& item : v->items) add(item);
                          for (const auto& [key, item] : v->named) {
                            digester.add(key);
                            add(item);
                          }
                        },
                        [&](const std::shared_ptr<Map>& v) {
                          for (const auto& [key, item] : v->items) {
                            digester.add(key);
                            add(item);
                          }
                        },
                        [&](const Value::Numbers& v) { digester.add(std::span<const double>(*v)); },
                        [&](const Value::Rows& v) { digester.add(v->values()); },
                        [&](const auto&) { digester.add(show(value)); }},
               value.data);
  }
  void add(const Item& item) {
    digester.add(static_cast<int>(item.index()));  // "1" is not 1
    std::visit(Overload{[&](bool v) { digester.add(v ? 1 : 0); }, [&](std::int64_t v) { digester.add(v); },
                        [&](double v) { digester.add(v); }, [&](const std::string& v) { digester.add(v); },
                        [&](NodeId v) {
                          if (const Value* value = std::get_if<Value>(&parcel.nodes_[v.index]))
                            return add(*value);
                          if (number[v.index] < 0) {
                            number[v.index] = static_cast<std::int64_t>(order.size());
                            order.push_back(v.index);
                          }
                          digester.add(number[v.index]);
                        },
                        [&](const auto&) { digester.add("?"); }},
               item);
  }

  std::string all() {
    add(parcel.root_);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Table* table = std::get_if<Table>(&parcel.nodes_[order[k]]);
      if (table == nullptr) continue;
      Array<Entry> entries = table->entries;
      std::sort(entries.begin(), entries.end(), before);
      digester.add(static_cast<std::int64_t>(entries.size()));
      for (const Entry& entry : entries) {
        add(entry.key);
        add(entry.value);
      }
    }
    return digester.hex();
  }
};

std::string Parcel::digest() const { return Digest{*this}.all(); }

}  // namespace asperity::lua
