// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/session.hpp"

#include <algorithm>

#include "engine/core/memory.hpp"

namespace asperity::lua {

namespace {
const char session_key = 0;
}

thread_local const Session::Running* Session::Running::innermost = nullptr;

Session& Session::of(lua_State* L) { return *find(L); }

Session* Session::find(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &session_key);
  auto* session = static_cast<Session*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return session;
}

void Session::attach(lua_State* L, Session& session) {
  lua_pushlightuserdata(L, &session);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &session_key);
}

void Session::nudge_collector(lua_State* L, std::size_t bytes) {
  constexpr std::size_t at_least = std::size_t{64} << 20;
  unseen_bytes_ += bytes;
  std::size_t enough = std::max(at_least, static_cast<std::size_t>(memory::held()) / 2);
  if (memory::limit() > 0) enough = std::min(enough, static_cast<std::size_t>(memory::limit()) / 8);
  if (unseen_bytes_ < enough) return;
  unseen_bytes_ = 0;
  lua_gc(L, LUA_GCCOLLECT);
}

}  // namespace asperity::lua
