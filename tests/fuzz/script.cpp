// SPDX-License-Identifier: GPL-3.0-or-later
// Checks and runs a script in a sandbox: at most 30000 instructions, 64 MiB and a fifth of a second. All
// memory is released.
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/parallel.hpp"
#include "engine/run/run_directory.hpp"
#include "tests/fuzz/script_limits.hpp"
#include "tests/fuzz/target.hpp"

namespace {

using namespace asperity;

void run(std::string_view script, bool dry) {
  static std::FILE* const nowhere = std::fopen("/dev/null", "w");
  lua::Session session(Monitor::silent());
  session.is_case = true;  // no records, no files, no exit
  session.dry_run = dry;
  session.output = nowhere;
  session.run = std::make_shared<RunDirectory>(RunDirectory::Without::dry);
  const lua::State state = lua::make_state(session, "");
  lua_State* const L = state.get();
  fuzz::require(luaL_dostring(L, fuzz::prelude) == LUA_OK, "the prelude runs");
  const fuzz::TimeLimit limit(std::chrono::milliseconds(200));
  fuzz::count_instructions(L);
  lua_pushcfunction(L, lua::traceback_handler);
  int status = luaL_loadbufferx(L, script.data(), script.size(), "@script.lua", "t");
  if (status == LUA_OK) status = lua_pcall(L, 0, 0, 1);
  if (status == LUA_OK) return;
  const std::string message = lua::error_text(L, -1);
  fuzz::require(
      script.find("internal") != std::string_view::npos || message.find("internal") == std::string::npos,
      "no internal error: " + message);
}

}  // namespace

static void fuzz_script(const std::uint8_t* data, std::size_t size) {
  set_thread_count(1);
  for (const bool dry : {true, false}) {
    const std::int64_t before = memory::held();
    memory::set_limit(before + (std::int64_t{64} << 20));
    run({reinterpret_cast<const char*>(data), size}, dry);
    memory::set_limit(0);
    stop_flag().clear();
    fuzz::require(memory::held() == before, "all memory is given back");
  }
}

static const asperity::fuzz::Target script_target{"script", fuzz_script};
