// SPDX-License-Identifier: GPL-3.0-or-later
// pairs and next in the same order in every process. Lua's order depends on a hash seed (luai_makeseed) from
// clock and addresses, which no call of Lua 5.4 sets. A loop therefore sorts the keys when it begins.
#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

namespace {

enum class Kind : std::uint32_t { number, text, boolean, other };

// `head` first: bits of a number, eight bytes of a string, address of a table.
struct Key {
  Kind kind = Kind::other;
  std::uint32_t place = 0;  // in the list, from 1
  std::uint64_t head = 0;
  std::int64_t rest = 0;       // integer, or string length
  const char* text = nullptr;  // valid as long as the list
};

// A loop's ordered keys. A userdata whose user value is the list of keys.
struct Walk {
  std::uint32_t count, next;
  std::uint32_t* places() { return reinterpret_cast<std::uint32_t*>(this + 1); }
};

bool before(const Key& a, const Key& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.head != b.head) return a.head < b.head;
  const int order = a.kind == Kind::text
                        ? std::memcmp(a.text, b.text, static_cast<std::size_t>(std::min(a.rest, b.rest)))
                        : 0;
  return order != 0 ? order < 0 : a.rest < b.rest;
}

Key key_at(lua_State* L, int index, std::uint32_t place) {
  Key key{.place = place};
  const int type = lua_type(L, index);
  if (type == LUA_TNUMBER) {
    key.kind = Kind::number;
    const auto bits = std::bit_cast<std::uint64_t>(lua_tonumber(L, index));
    constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    key.head = (bits & sign) != 0 ? ~bits : bits | sign;
    key.rest = lua_tointeger(L, index);
  } else if (type == LUA_TSTRING) {
    key.kind = Kind::text;
    std::size_t length = 0;
    key.text = lua_tolstring(L, index, &length);
    key.rest = static_cast<std::int64_t>(length);
    std::memcpy(&key.head, key.text, std::min(length, sizeof key.head));
    key.head = __builtin_bswap64(key.head);
  } else if (type == LUA_TBOOLEAN) {
    key.kind = Kind::boolean;
    key.head = lua_toboolean(L, index) != 0 ? 1 : 0;
  } else {
    key.head = reinterpret_cast<std::uintptr_t>(lua_topointer(L, index));
  }
  return key;
}

void note_other_keys(lua_State* L) noexcept {
  const Session* session = Session::find(L);
  if (session == nullptr || session->mistakes == nullptr) return;
  session->mistakes->note(where(L) +
                          "several keys of this table are tables, functions or userdata, which come "
                          "in another order in every run; use numbers or strings as keys");
}

// Room for the keys of one walk, reused by the next. Null without memory.
Key* room_for(std::uint32_t count) {
  thread_local std::uint32_t size = 0;
  thread_local std::unique_ptr<Key[]> room;
  if (count <= size) return room.get();
  const std::uint32_t larger = std::max<std::uint32_t>(128, 2 * size);
  std::unique_ptr<Key[]> grown(new (std::nothrow) Key[larger]);
  if (!grown) return nullptr;
  std::copy(room.get(), room.get() + size, grown.get());
  room = std::move(grown);
  size = larger;
  return room.get();
}

// Pushes the walk over a table and the list of its keys. Raises.
Walk* push_walk(lua_State* L, int table) {
  thread_local std::uint32_t expected = 0;  // loops often have as many keys as the last
  luaL_checkstack(L, 8, nullptr);
  lua_createtable(L, static_cast<int>(expected), 0);
  const int list = lua_gettop(L);
  std::uint32_t count = 0, others = 0;
  Key* keys = room_for(0);
  for (lua_pushnil(L); lua_next(L, table) != 0;) {
    lua_pop(L, 1);
    keys = room_for(count + 1);
    if (keys == nullptr) luaL_error(L, "not enough memory");
    keys[count] = key_at(L, -1, count + 1);
    if (keys[count].kind == Kind::other && !Argument(L, -1).is_unknown()) ++others;
    lua_pushvalue(L, -1);
    lua_rawseti(L, list, ++count);
  }
  expected = std::min<std::uint32_t>(count, 1024);
  if (!std::is_sorted(keys, keys + count, before)) std::sort(keys, keys + count, before);
  auto* walk = new (lua_newuserdatauv(L, sizeof(Walk) + count * sizeof(std::uint32_t), 1)) Walk{count, 0};
  for (std::uint32_t k = 0; k < count; ++k) walk->places()[k] = keys[k].place;
  lua_pushvalue(L, list);
  lua_setiuservalue(L, -2, 1);
  lua_rotate(L, list, 1);
  if (others > 1) note_other_keys(L);
  return walk;
}

// Key k of a walk.
Key key_of(lua_State* L, Walk& walk, int list, std::uint32_t k) {
  lua_rawgeti(L, list, walk.places()[k]);
  const Key key = key_at(L, -1, 0);
  lua_pop(L, 1);
  return key;
}

// The next key still in the table and its value; nil at the end.
int push_next(lua_State* L, int table, Walk& walk, int list) {
  for (; walk.next < walk.count; lua_pop(L, 2)) {
    lua_rawgeti(L, list, walk.places()[walk.next++]);
    lua_pushvalue(L, -1);
    if (lua_rawget(L, table) != LUA_TNIL) return 2;
  }
  lua_pushnil(L);
  return 1;
}

int step_of_loop(lua_State* L) {
  Walk& walk = *static_cast<Walk*>(lua_touserdata(L, lua_upvalueindex(2)));
  if (lua_isnoneornil(L, 2)) walk.next = 0;
  return push_next(L, lua_upvalueindex(1), walk, lua_upvalueindex(3));
}

// Without sorting: next(t) mostly tests for an empty table.
int push_first(lua_State* L) {
  Key first;
  lua_pushnil(L);  // index 3: smallest key
  for (lua_pushnil(L); lua_next(L, 1) != 0;) {
    lua_pop(L, 1);
    const Key key = key_at(L, -1, 0);
    if (!lua_isnil(L, 3) && !before(key, first)) continue;
    first = key;
    lua_copy(L, -1, 3);
  }
  if (lua_isnil(L, 3)) return 1;
  lua_pushvalue(L, 3);
  lua_rawget(L, 1);
  return 2;
}

}  // namespace

void push_ordered_loop(lua_State* L, int index) {
  lua_pushvalue(L, index);
  push_walk(L, lua_gettop(L));
  lua_pushcclosure(L, step_of_loop, 3);
}

int ordered_pairs(lua_State* L) {
  luaL_checkany(L, 1);
  if (luaL_getmetafield(L, 1, "__pairs") != LUA_TNIL) {
    lua_pushvalue(L, 1);
    lua_callk(L, 1, 3, 0, [](lua_State*, int, lua_KContext) { return 3; });
    return 3;
  }
  if (lua_istable(L, 1))
    push_ordered_loop(L, 1);
  else
    lua_pushcfunction(L, ordered_next);  // raises in the loop
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

int ordered_next(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 2);
  if (lua_isnil(L, 2)) return push_first(L);
  // Active walks by table: no sorting per step.
  if (luaL_getsubtable(L, LUA_REGISTRYINDEX, "asperity.walks") == 0) {
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, 3);
  }
  lua_pushvalue(L, 1);
  lua_rawget(L, 3);
  auto* walk = static_cast<Walk*>(lua_touserdata(L, 4));
  const Key key = key_at(L, 2, 0);
  const auto is_at = [&](const Key& last) { return !before(last, key) && !before(key, last); };
  if (walk != nullptr) lua_getiuservalue(L, 4, 1);
  if (walk == nullptr || walk->next == 0 || !is_at(key_of(L, *walk, 5, walk->next - 1))) {
    lua_settop(L, 3);
    walk = push_walk(L, 1);
    std::uint32_t below = 0, above = walk->count;  // first key after `key`
    while (below < above) {
      const std::uint32_t middle = (below + above) / 2;
      if (before(key, key_of(L, *walk, 5, middle)))
        above = middle;
      else
        below = middle + 1;
    }
    walk->next = below;
  }
  const int results = push_next(L, 1, *walk, 5);
  lua_pushvalue(L, 1);
  if (results == 2)
    lua_pushvalue(L, 4);
  else
    lua_pushnil(L);
  lua_rawset(L, 3);
  return results;
}

}  // namespace asperity::lua
