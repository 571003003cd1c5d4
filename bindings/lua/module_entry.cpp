// SPDX-License-Identifier: GPL-3.0-or-later
// The loadable module: `require "asperity"` from any Lua 5.4, without a Lua library of its own and without
// recorded runs.
#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/run/run_directory.hpp"

extern "C" __attribute__((visibility("default"))) int luaopen_asperity(lua_State* L) {
  using namespace asperity;
  static lua::Session session(Monitor::silent());
  session.trusted = true;
  if (session.run == nullptr)
    session.run = std::make_shared<RunDirectory>(RunDirectory::Without::loose, true);
  lua::Session::attach(L, session);
  lua::preload_embedded_scripts(L);
  lua::push_library(L);
  return 1;
}
