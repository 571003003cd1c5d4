// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/guard.hpp"

#include <algorithm>
#include <string_view>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/declarations.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

struct Pusher {
  lua_State* L;

  void operator()(std::monostate) const { lua_pushnil(L); }
  void operator()(bool v) const { lua_pushboolean(L, v ? 1 : 0); }
  void operator()(std::int64_t v) const { lua_pushinteger(L, v); }
  void operator()(double v) const { lua_pushnumber(L, v); }
  void operator()(const std::string& v) const { lua_pushlstring(L, v.data(), v.size()); }
  void operator()(Value::Function v) const { lua_pushcfunction(L, v); }
  void operator()(Unknown v) const { push_unknown(L, v.item); }
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
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, v.type) != LUA_TTABLE) {
      lua_pop(L, 1);
      lua_rawgetp(L, LUA_REGISTRYINDEX, &native_key);
      lua_pushlightuserdata(L, const_cast<Class*>(v.type));
      lua_call(L, 1, 1);
    }
    lua_setmetatable(L, -2);
    static_cast<Object*>(block)->pointer = v.pointer;  // noexcept; then __gc owns it
    static_cast<Object*>(block)->known = v.known;
    if (v.type->native_bytes != nullptr && v.pointer != nullptr)
      Session::of(L).nudge_collector(L, v.type->native_bytes(v.pointer.get()));
  }
  void operator()(const std::shared_ptr<Record>& v) const { push_block(v, &record_key); }
  void operator()(const std::shared_ptr<Iterator>& v) const { push_block(v, &iterator_key); }

  void operator()(const std::shared_ptr<List>& v) const {
    lua_createtable(L, clipped(v->items.size()), clipped(v->named.size()));
    for (std::size_t k = 0; k < v->items.size(); ++k) {
      push(L, v->items[k]);
      lua_rawseti(L, -2, static_cast<lua_Integer>(k) + 1);
    }
    push_fields(v->named);
    if (v->rows) set_row_methods(L, v->units);
    if (!v->unit.empty()) set_list_unit(L, v->unit);
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

  // Copied last, without an exception: __gc then owns it.
  template <class T>
  void push_block(const std::shared_ptr<T>& v, const void* key) const {
    auto* block = ::new (lua_newuserdatauv(L, sizeof(std::shared_ptr<T>), 0)) std::shared_ptr<T>();
    lua_rawgetp(L, LUA_REGISTRYINDEX, key);
    lua_setmetatable(L, -2);
    *block = v;
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

// Units of lists stand in a table with weak keys: a metatable would keep the list out of ensembles.
void set_list_unit(lua_State* L, const std::string& unit) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &list_units_key) == LUA_TNIL) {
    lua_pop(L, 1);
    lua_newtable(L);
    lua_newtable(L);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &list_units_key);
  }
  lua_pushvalue(L, -2);
  lua_pushlstring(L, unit.data(), unit.size());
  lua_rawset(L, -3);
  lua_pop(L, 1);
}

std::string list_unit(lua_State* L, int index) {
  const Argument::StackGuard guard(L);
  index = lua_absindex(L, index);
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &list_units_key) != LUA_TTABLE) return {};
  lua_pushvalue(L, index);
  return lua_rawget(L, -2) == LUA_TSTRING ? lua_tostring(L, -1) : "";
}

void push_checked(lua_State* L, const Value& value, const std::string& what) {
  auto action = [&value](lua_State* state) {
    push(state, value);
    return 1;
  };
  if (protect(L, 0, 1, action) != LUA_OK)
    throw Error(ErrorCode::out_of_memory, "there is no memory for " + what);
}

std::string where(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; level < 16 && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    // Functions of the sandbox have no line in the script.
    if (frame.currentline > 0 && std::string_view(frame.source) != "=sandbox")
      return std::string(frame.short_src) + ":" + std::to_string(frame.currentline) + ": ";
  }
  return "";
}

std::string message_of(lua_State* L, const std::string& name, const Error& error) {
  if (error.code() == ErrorCode::interrupted) return where(L) + "interrupted";
  std::string text = error.what();
  // Files of the run as the script names them.
  if (const Session* session = Session::find(L); session != nullptr && session->run != nullptr)
    if (const std::string folder = session->run->path().string() + "/"; folder.size() > 1)
      for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
        text.erase(at, folder.size());
  return where(L) + (text.starts_with(name) || name.empty() ? text : name + ": " + text);
}

int fail(lua_State* L, const std::string& message) {
  auto action = [&message](lua_State* state) {
    lua_pushlstring(state, message.data(), message.size());
    return 1;
  };
  protect(L, 0, 1, action);  // on failure with Lua's memory error
  return -1;
}

int deliver(lua_State* L, const Values& results) {
  const int count = static_cast<int>(results.size());
  auto action = [&results](lua_State* state) {
    luaL_checkstack(state, static_cast<int>(results.size()) + 8, "too many results");
    for (const Value& value : results) push(state, value);
    return static_cast<int>(results.size());
  };
  return protect(L, 0, count, action) == LUA_OK ? count : -1;
}

}  // namespace asperity::lua
