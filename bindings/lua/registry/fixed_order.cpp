// SPDX-License-Identifier: GPL-3.0-or-later
// pairs and next in the same order in every process. Lua's order depends on a string hash with a seed
// (luai_makeseed) from clock and addresses, which no call of Lua 5.4 sets. A loop therefore sorts the keys
// when it begins.
#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/mistakes.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

namespace {

enum class Kind : std::uint32_t { number, text, boolean, other };

// `head` is compared first: bits of a number, eight bytes of a string, address of a table.
struct Key {
  Kind kind = Kind::other;
  std::uint32_t place = 0;  // index in the list of keys, from 1
  std::uint64_t head = 0;
  std::int64_t rest = 0;       // integer, or length of a string
  const char* text = nullptr;  // valid as long as the list
};

// Sorted keys of a loop, a userdata whose user value is their list.
struct alignas(Key) Walk {
  std::uint32_t count, next;
  Key* keys() { return reinterpret_cast<Key*>(this + 1); }
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

// Pushes the walk over a table and the list of its keys. Raises.
Walk* push_walk(lua_State* L, int table) {
  luaL_checkstack(L, 8, nullptr);
  std::size_t count = 0;
  for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) ++count;
  auto* walk = new (lua_newuserdatauv(L, sizeof(Walk) + count * sizeof(Key), 1)) Walk{0, 0};
  const int at = lua_gettop(L), list = at + 1;
  lua_createtable(L, static_cast<int>(count), 0);
  // A collection may have changed a weak table. Nothing is allocated from here on.
  std::uint32_t found = 0, others = 0;
  for (lua_pushnil(L); found < count && lua_next(L, table) != 0;) {
    lua_pop(L, 1);
    const Key& key = *new (walk->keys() + found) Key(key_at(L, -1, found + 1));
    if (key.kind == Kind::other && !Argument(L, -1).is_unknown()) ++others;
    lua_pushvalue(L, -1);
    lua_rawseti(L, list, ++found);
  }
  lua_settop(L, list);
  lua_pushvalue(L, list);
  lua_setiuservalue(L, at, 1);
  walk->count = found;
  Key* const end = walk->keys() + found;
  if (!std::is_sorted(walk->keys(), end, before)) std::sort(walk->keys(), end, before);
  if (others > 1) note_other_keys(L);
  return walk;
}

// The next key still in the table and its value; nil at the end.
int push_next(lua_State* L, int table, Walk& walk, int list) {
  for (; walk.next < walk.count; lua_pop(L, 2)) {
    lua_rawgeti(L, list, walk.keys()[walk.next++].place);
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

// No sorting: next(t) mostly tests for an empty table.
int push_first(lua_State* L) {
  Key first;
  lua_pushnil(L);  // index 3: the smallest key so far
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
  // Active walks by table, so that a step does not sort again.
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
  if (walk != nullptr && walk->next > 0 && is_at(walk->keys()[walk->next - 1])) {
    lua_getiuservalue(L, 4, 1);
  } else {
    lua_settop(L, 3);
    walk = push_walk(L, 1);
    Key* const keys = walk->keys();
    walk->next = static_cast<std::uint32_t>(std::upper_bound(keys, keys + walk->count, key, before) - keys);
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
