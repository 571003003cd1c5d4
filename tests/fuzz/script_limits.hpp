// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of fuzzed scripts: a prelude without files and without long library functions (the program kills
// the process for these), a clock and an instruction count. Limits raise the stop flag.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::fuzz {

inline constexpr const char* prelude = R"(
io, dofile, loadfile, os.remove, os.rename, os.exit, package.path = nil, nil, nil, nil, nil, nil, ""
string.find, string.match, string.gmatch, string.gsub, table.move = nil, nil, nil, nil, nil
local set, rawset = setmetatable, rawset
function setmetatable(t, meta)
  if type(meta) == "table" then rawset(meta, "__gc", nil) rawset(meta, "__len", nil) end
  return set(t, meta)
end)";

class TimeLimit {
 public:
  explicit TimeLimit(std::chrono::milliseconds limit)
      : thread_([this, limit](const std::stop_token& over) {
          std::unique_lock lock(mutex_);
          changed_.wait_for(lock, over, limit, [] { return false; });
          if (!over.stop_requested()) stop_flag().raise(StopReason::time_limit);
        }) {}

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::jthread thread_;
};

inline int turns = 0;

inline void look(lua_State* L, lua_Debug*) {
  if (++turns > 30) stop_flag().raise(StopReason::time_limit);
  if (stop_flag().reason() != StopReason::none) lua::interrupt(L);
}

inline void count_instructions(lua_State* L) {
  turns = 0;
  lua_sethook(L, look, LUA_MASKCOUNT, 1000);
}

}  // namespace asperity::fuzz
