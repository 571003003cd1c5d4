// SPDX-License-Identifier: GPL-3.0-or-later
// Input: a call on the first line ("lab.surface.sine"), then a Lua expression for its option block; nothing
// is computed. Values: `huge`, `nan`, `flat`, `steel`, `law`, `call`.
#include <functional>

#include "tests/fuzz/option_world.hpp"

namespace {

using namespace asperity;

constexpr std::int64_t room = std::int64_t{1} << 24;

void stop(lua_State* L, lua_Debug*) { luaL_error(L, "too long"); }

}  // namespace

static void fuzz_options(const std::uint8_t* data, std::size_t size) {
  static fuzz::World world;
  static const std::vector<const lua::Function*> functions = fuzz::functions_with_options();
  lua_State* const L = world.state.get();
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = std::min(input.find('\n'), size);
  // Unknown names also select a function, so that changed letters are useful.
  const lua::Function* function =
      functions[std::hash<std::string_view>()(input.substr(0, line)) % functions.size()];
  for (const lua::Function* one : functions)
    if (lua::qualified_name(*one) == input.substr(0, line)) function = one;

  const std::string code = "return " + std::string(input.substr(line));
  if (luaL_loadbufferx(L, code.data(), code.size(), "=input", "t") == LUA_OK) {
    lua_pushvalue(L, 1);
    lua_setupvalue(L, -2, 1);
    lua_sethook(L, stop, LUA_MASKCOUNT, 10000);
    memory::set_limit(memory::held() + room);
    const bool made = lua_pcall(L, 0, 1, 0) == LUA_OK;
    memory::set_limit(0);
    lua_sethook(L, nullptr, 0, 0);
    const std::string& caller = lua::qualified_name(*function);
    if (made)  // its stack may grow
      fuzz::refused(
          room, [&] { function->options->check(lua::Argument(L, -1), caller); }, 1 << 16);
  }
  lua_settop(L, 1);
  lua_gc(L, LUA_GCCOLLECT);
}

static const asperity::fuzz::Target options_target{"options", fuzz_options};
