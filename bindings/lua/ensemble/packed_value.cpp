// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/packed_value.hpp"

#include <algorithm>
#include <cctype>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/registry.hpp"

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

// Any call may raise: nothing here owns memory.
struct PackedValue::Pusher {
  const PackedValue& packed;
  lua_State* L;
  int made;   // list of nodes
  int bases;  // list of values of Lua's library

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
      const Cell& cell = packed.cells_[function.cells[k]];
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
    // First, because the script may have replaced them.
    for (std::size_t k = 0; k < packed.bases_.size(); ++k) {
      push_base(L, packed.bases_[k]);
      lua_rawseti(L, bases, static_cast<lua_Integer>(k) + 1);
    }
    for (std::size_t k = 0; k < packed.nodes_.size(); ++k) {
      std::visit([&](const auto& node) { make(node); }, packed.nodes_[k]);
      lua_rawseti(L, made, static_cast<lua_Integer>(k) + 1);
    }
    for (std::size_t k = 0; k < packed.nodes_.size(); ++k) {
      if (std::holds_alternative<Value>(packed.nodes_[k])) continue;
      lua_rawgeti(L, made, static_cast<lua_Integer>(k) + 1);
      std::visit([&](const auto& node) { fill(node, k); }, packed.nodes_[k]);
      lua_pop(L, 1);
    }
    for (const Addition& addition : packed.additions_) {
      item(addition.table);
      item(addition.entry.key);
      item(addition.entry.value);
      lua_rawset(L, -3);
      lua_pop(L, 1);
    }
  }
};

void PackedValue::push(lua_State* L) const {
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

std::string step_text(std::string_view key) {
  const bool name = !key.empty() && std::isdigit(static_cast<unsigned char>(key[0])) == 0 &&
                    std::all_of(key.begin(), key.end(), [](char c) {
                      return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
                    });
  return name ? "." + std::string(key) : "[\"" + std::string(key.substr(0, 40)) + "\"]";
}

const Value* PackedValue::native() const {
  const auto* id = std::get_if<NodeId>(&root_);
  return id == nullptr ? nullptr : std::get_if<Value>(&nodes_[id->index]);
}

}  // namespace asperity::lua
