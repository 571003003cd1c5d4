// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run`, and shared functions for scripts and run directories.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/commands/command.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity {
class ResultFiles;
class RunDirectory;
class RunLock;
class TemporaryFolder;
}  // namespace asperity

namespace asperity::cli {

class MpiRanks;
class RunObserver;
class TerminalMonitor;
class Watchdog;

struct RunCommand {
  std::string script;
  std::optional<std::string> out;
  int threads = 0;  // 0: one per processor
  std::uint64_t seed = 1;
  bool seed_given = false;
  std::optional<std::int64_t> limit_memory;  // bytes
  std::optional<double> limit_time;          // seconds
  bool trust = false;
  std::vector<std::string> arguments;
  GivenKnobs knobs;
  std::optional<std::string> text;            // script text instead of the file
  std::optional<std::string> resume;          // directory of an unfinished run
  bool anew = false;                          // with another script: old files are moved aside, results stay
  bool journal_lost = false;                  // resumed with a new journal
  std::vector<std::string> damages;           // of the resumed run, one sentence each
  std::shared_ptr<const LoadedFiles> loaded;  // files of the resumed or replayed run
  std::shared_ptr<RunLock> lock;              // of the directory, if held
  std::vector<std::string> reuse;             // runs or result folders
  std::optional<std::string> store;           // shared, instead of the run's own
  std::optional<Shard> shard;                 // of ensemble cases; needs `store`
  std::optional<CaseNumber> one_case;         // only this case, without a directory; needs `store`
  bool merge_only = false;                    // no computation; needs `store`
  std::optional<std::int64_t> store_limit;    // bytes; 0: none
  // In a replay: ignore `reuse` from this journal line on.
  std::optional<std::int64_t> afresh_from;
  std::shared_ptr<lua::Variation> variation;  // of a replay, or null
  RunObserver* observer = nullptr;            // receives messages instead of standard error, or null
  MpiRanks* ranks = nullptr;                  // null for a single process

  std::shared_ptr<const TemporaryFolder> case_folder;  // of `one_case`; deleted at the end

  // Behind the barriers of page runs (bindings/web/confined/confined_command.hpp).
  bool confined = false;
  std::vector<std::string> read;  // further readable folders
  std::string without_barriers;   // not required: "files,network"
  // Bytes of the run directory and of new results in a shared store.
  std::optional<std::int64_t> limit_disk;
  // In the confined process: barriers and readable folders; and whether standard error, a pipe, ends at a
  // terminal.
  Json barriers{};
  bool terminal = false;
};

// Executes a command in a confined process; passed by bindings/main.cpp from the higher layer
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
// `asperity check`. Exit status as in run().
int check(const RunCommand& command);

struct RunContext {
  const RunCommand& command;
  const std::string& text;  // of the script
  std::shared_ptr<RunDirectory> run;
  TerminalMonitor& monitor;
  Watchdog& watchdog;
  ResultFiles& results;
  std::function<void()> summary;  // prints how and where the run ended
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

// Leaves `results` values and returns LUA_OK, or leaves an error with traceback.
int execute(lua_State* L, const RunCommand& command, const std::string& text, int results);

// Throws Error{bad_file}.
std::string read_script(const std::string& path);

}  // namespace asperity::cli
