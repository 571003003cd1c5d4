// SPDX-License-Identifier: GPL-3.0-or-later
// Every function with an option table, and a Lua state with values for expressions.
#pragma once

#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "tests/fuzz/target.hpp"

namespace asperity::fuzz {

inline std::vector<const lua::Function*> functions_with_options() {
  std::vector<const lua::Function*> found;
  const auto take = [&](const lua::Function& f) {
    if (f.options != nullptr) found.push_back(&f);
  };
  for (const lua::Module* module : lua::modules()) {
    for (const lua::Function& f : module->functions) take(f);
    if (module->call) take(*module->call);
  }
  for (const lua::Class* type : lua::classes())
    for (const lua::Function& f : type->methods) take(f);
  return found;
}

struct World {
  World() : state(lua::make_state(session, "")) {
    const char* const prelude =
        "local lab = require 'asperity'\n"
        "getmetatable('').__index = nil\n"
        "return { huge = math.huge, nan = 0/0, call = function() return 0.5 end,\n"
        "  flat = lab.surface.flat{ cells = 4, size = 1 }, steel = lab.material{ young = 2e11, poisson = 0.3 "
        "},\n"
        "  law = lab.friction{ tau0 = 1e6, alpha = 0.2 } }";
    require(luaL_dostring(state.get(), prelude) == LUA_OK, "the world is made");
  }
  lua::Session session{Monitor::silent()};
  lua::State state;  // names for expressions on its stack
};

}  // namespace asperity::fuzz
