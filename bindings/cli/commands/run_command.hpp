// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "bindings/cli/commands/command.hpp"
#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"

namespace asperity {
class ResultFiles;
class RunDirectory;
}  // namespace asperity

namespace asperity::cli {

class TerminalMonitor;
class Watchdog;

// Executes a command in a confined process: bindings/main.cpp passes it down from
// bindings/web/confined/confined_command.hpp.
template <class Asked>
struct BehindBarriers {
  bool (*wanted)(const Asked& asked);    // by option or record
  int (*carry_out)(const Asked& asked);  // returns the exit status
};

Command run_command(BehindBarriers<RunCommand> barriers);

// Exit status: 0 done; 1 script or expectation failed; 2 bad usage or directory in use; 3 cases missing in
// the store; 130 interrupted; 143 SIGTERM; 129 SIGHUP.
int run(const RunCommand& command);
// Exit status as in run().
int check(const RunCommand& command);
std::string without_calls(const std::string& why);  // names --trace in place of a traceback

struct RunContext {
  const RunCommand& command;
  const std::string& text;  // of the script
  std::shared_ptr<RunDirectory> run;
  TerminalMonitor& monitor;
  Watchdog& watchdog;
  ResultFiles& results;
  std::function<void()> summary;  // how and where the run ended
};

// Makes the run directory, sets limits, watches for stops, calls `work` (returns the reason of a failure, or
// ""), closes the directory. Returns the exit status.
int in_run_directory(const RunCommand& command, const std::function<std::string(RunContext&)>& work);

// Runs the script; returns the reason of a failure, or "". os.exit closes the directory and exits with
// `at_exit` of the script's status.
std::string run_script(RunContext& context, const std::function<int(int)>& at_exit);

// Why a given value set no knob; "" if all did.
std::string unmade_knobs(const lua::Session& session);

lua::State make_state(lua::Session& session, const RunCommand& command);

// Leaves `results` values (LUA_OK), or an error with traceback.
int execute(lua_State* L, const RunCommand& command, const std::string& text, int results);

}  // namespace asperity::cli
