// SPDX-License-Identifier: GPL-3.0-or-later
// What one Lua state works for: its monitor, seed and limits, and the run that keeps its results.
// Every state has exactly one, held in the registry; the states of an ensemble's cases have one
// each, with no run of their own.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/lua_api.hpp"
#include "bindings/lua/value.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {
class RunDirectory;
}

namespace asperity::lua {

class Session {
 public:
  explicit Session(Monitor& monitor) : monitor_(&monitor) {}

  Monitor& monitor() const { return *monitor_; }

  std::uint64_t seed = 1;              // of math.random and of anything a script leaves to the run
  bool dry_run = false;                // asperity check: heavy calls give placeholders
  bool gave_placeholders = false;      // a dry run has met a call it did not make
  bool trusted = false;                // the whole of Lua, and files anywhere
  int depth = 0;                       // ensembles this state stands inside
  bool is_case = false;                // a case of an ensemble: cannot record
  std::shared_ptr<RunDirectory> run;   // null when nothing is recorded
  std::function<void(int)> exit_hook;  // what os.exit(code) does before the process ends
  std::FILE* output = stdout;          // where print goes; a buffer in a case
  // Of a case: the script's globals that could not come along, and why.
  const std::map<std::string, std::string>* left_behind = nullptr;

  // Tells Lua's collector about memory it cannot see; collects when enough has piled up.
  void nudge_collector(lua_State* L, std::size_t bytes);

  static Session& of(lua_State* L);
  // Binds a session to a state; the session must outlive it. Raises on lack of memory.
  static void attach(lua_State* L, Session& session);

 private:
  Monitor* monitor_;
  std::size_t unseen_bytes_ = 0;
};

}  // namespace asperity::lua
