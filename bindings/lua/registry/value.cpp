// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/value.hpp"

#include <algorithm>
#include <new>

#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

Record& Record::add(std::string field, Value value, Dimension dimension) {
  entries.push_back({std::move(field), std::move(value), dimension});
  return *this;
}

Record& Record::add_if(std::string effect, std::string field, Value value, Dimension dimension) {
  if (!value.is_nil()) return add(std::move(field), std::move(value), dimension);
  missing_effects.emplace_back(std::move(field), std::move(effect));
  return *this;
}

const Value* Record::find(std::string_view field) const {
  for (const Entry& entry : entries)
    if (entry.field == field) return &entry.value;
  return nullptr;
}

std::optional<double> Value::number() const {
  if (const auto* real = std::get_if<double>(&data)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&data)) return static_cast<double>(*whole);
  return {};
}

std::string show(const Record::Entry& entry) {
  const auto number = entry.value.number();
  return number && entry.dimension != dimension::number ? format_quantity(*number, entry.dimension)
                                                        : show(entry.value);
}

std::string show(const Value& value) {
  struct Shower {
    std::string operator()(std::monostate) const { return "nil"; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return format_short(v + 0.0); }  // avoids "-0"
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(const Object& v) const {
      return v.pointer == nullptr || v.type->describe == nullptr ? v.type->article_name
                                                                 : v.type->describe(v.pointer.get());
    }
    std::string operator()(const std::shared_ptr<Record>& v) const {
      std::string text;
      for (const Record::Entry& entry : v->entries)
        text += (text.empty() ? "" : ", ") + entry.field + " " + show(entry);
      return "{ " + text + " }";
    }
    std::string operator()(const std::shared_ptr<List>& v) const { return count(v->items.size()); }
    std::string operator()(const std::shared_ptr<Map>& v) const { return count(v->items.size()); }
    std::string operator()(const Value::Numbers& v) const { return count(v->size()); }
    std::string operator()(const Value::Rows& v) const { return count(static_cast<std::size_t>(v->ny())); }
    std::string operator()(const std::shared_ptr<Iterator>&) const { return "an iterator"; }
    std::string operator()(Unknown) const { return "?"; }
    std::string operator()(Value::Function) const { return "a function"; }
    std::string operator()(Script) const { return "a function"; }
    std::string operator()(const std::shared_ptr<const StoredValue>&) const { return "a table"; }
    static std::string count(std::size_t n) { return "a table of " + std::to_string(n); }
  };
  return std::visit(Shower{}, value.data);
}

namespace {

struct Pusher {
  lua_State* L;

  void operator()(std::monostate) const { lua_pushnil(L); }
  void operator()(bool v) const { lua_pushboolean(L, v ? 1 : 0); }
  void operator()(std::int64_t v) const { lua_pushinteger(L, v); }
  void operator()(double v) const { lua_pushnumber(L, v); }
  void operator()(const std::string& v) const { lua_pushlstring(L, v.data(), v.size()); }
  void operator()(Value::Function v) const { lua_pushcfunction(L, v); }
  void operator()(Unknown) const { push_unknown(L); }
  void operator()(Script v) const {
    const std::string_view text = embedded_script(v.name);
    lua_pushfstring(L, "=asperity.%s", v.name);
    load_embedded_text(L, text, lua_tostring(L, -1));
    lua_remove(L, -2);
    lua_call(L, 0, 1);
  }

  void operator()(const std::shared_ptr<const StoredValue>& v) const { v->push(L); }

  void operator()(const Object& v) const {
    void* block = lua_newuserdatauv(L, sizeof(Object), 0);
    new (block) Object{v.type, nullptr, v.closed};
    push_metatable(L, *v.type);
    lua_setmetatable(L, -2);
    static_cast<Object*>(block)->pointer = v.pointer;  // noexcept; __gc owns the value from here on
    static_cast<Object*>(block)->known = v.known;
    if (v.type->native_bytes != nullptr && v.pointer != nullptr)
      Session::of(L).nudge_collector(L, v.type->native_bytes(v.pointer.get()));
  }
  void operator()(const std::shared_ptr<Record>& v) const { push_record(L, v); }
  void operator()(const std::shared_ptr<Iterator>& v) const { push_iterator(L, v); }

  void operator()(const std::shared_ptr<List>& v) const {
    lua_createtable(L, clipped(v->items.size()), clipped(v->named.size()));
    for (std::size_t k = 0; k < v->items.size(); ++k) {
      push(L, v->items[k]);
      lua_rawseti(L, -2, static_cast<lua_Integer>(k) + 1);
    }
    push_fields(v->named);
  }
  void operator()(const std::shared_ptr<Map>& v) const {
    lua_createtable(L, 0, clipped(v->items.size()));
    push_fields(v->items);
  }
  void operator()(const Value::Numbers& v) const {
    lua_createtable(L, clipped(v->size()), 0);
    for (std::size_t k = 0; k < v->size(); ++k) {
      lua_pushnumber(L, (*v)[k]);
      lua_rawseti(L, -2, static_cast<lua_Integer>(k) + 1);
    }
  }
  void operator()(const Value::Rows& v) const {
    lua_createtable(L, v->ny(), 0);
    for (int j = 0; j < v->ny(); ++j) {
      lua_createtable(L, v->nx(), 0);
      for (int i = 0; i < v->nx(); ++i) {
        lua_pushnumber(L, (*v)(i, j));
        lua_rawseti(L, -2, i + 1);
      }
      lua_rawseti(L, -2, j + 1);
    }
  }

  // Into the table on top of the stack.
  void push_fields(const std::vector<std::pair<std::string, Value>>& fields) const {
    for (const auto& [key, item] : fields) {
      lua_pushlstring(L, key.data(), key.size());
      push(L, item);
      lua_rawset(L, -3);
    }
  }

  static int clipped(std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, 1 << 26)); }
};

}  // namespace

void push(lua_State* L, const Value& value) {
  luaL_checkstack(L, 8, "too many nested results");
  std::visit(Pusher{L}, value.data);
}

List text_list(const std::vector<std::string>& items) {
  List list;
  for (const std::string& item : items) list.items.emplace_back(item);
  return list;
}

}  // namespace asperity::lua
