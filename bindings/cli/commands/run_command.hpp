// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run`, and functions for scripts and run directories that other commands share.
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
  std::optional<std::string> text;    // of the script, instead of its file
  std::optional<std::string> resume;  // directory of an unfinished run
  bool anew = false;          // another script in this directory: old files are moved aside, results stay
  bool journal_lost = false;  // the resumed run starts a new journal
  std::vector<std::string> damages;           // of the resumed run, a sentence each
  std::shared_ptr<const LoadedFiles> loaded;  // files of the resumed or replayed run
  std::shared_ptr<RunLock> lock;              // of the directory, if already taken
  std::vector<std::string> reuse;             // runs or result folders to take results from
  std::optional<std::string> store;           // shared folder of results instead of the run's own
  std::optional<Shard> shard;                 // of ensemble cases; needs `store`
  std::optional<CaseNumber> one_case;         // compute only this case; needs `store`, leaves no directory
  bool merge_only = false;                    // compute no case; needs `store`
  std::optional<std::int64_t> store_limit;    // bytes of stored results; 0: none
  // In a replay: no results from `reuse` from this journal line on.
  std::optional<std::int64_t> afresh_from;
  std::shared_ptr<lua::Variation> variation;  // of a replay; may be null
  RunObserver* observer = nullptr;            // receives the messages instead of standard error; may be null
  MpiRanks* ranks = nullptr;                  // the processes of the run; null for a single process

  std::shared_ptr<const TemporaryFolder> case_folder;  // of `one_case`: deleted at the end

  // Behind the barriers of page runs (bindings/web/confined/confined_command.hpp).
  bool confined = false;
  std::vector<std::string> read;  // further readable folders
  std::string without_barriers;   // dispensable barriers: "files,network"
  // Bytes of all files of the run directory and of new results in a shared store.
  std::optional<std::int64_t> limit_disk;
  // In the confined process: barriers and readable folders for the manifest; and whether its standard error,
  // a pipe, is shown on a terminal.
  Json barriers{};
  bool terminal = false;
};

// Executes a command in a confined process. bindings/main.cpp passes this from
// bindings/web/confined/confined_command.hpp, which belongs to a higher layer.
template <class Asked>
struct BehindBarriers {
  bool (*wanted)(const Asked& asked);    // by options, or by the resumed record
  int (*carry_out)(const Asked& asked);  // returns the exit status
};

Command run_command(BehindBarriers<RunCommand> barriers);

// Exit status: 0 done; 1 the script or an expectation failed; 2 bad usage, or another process runs there; 3
// cases are missing in the store; 130 interrupted; 143 SIGTERM; 129 SIGHUP.
int run(const RunCommand& command);
// `asperity check`: a dry run without heavy calls. Exit status as in run().
int check(const RunCommand& command);

struct RunContext {
  const RunCommand& command;
  const std::string& text;  // of the script
  std::shared_ptr<RunDirectory> run;
  TerminalMonitor& monitor;
  Watchdog& watchdog;
  ResultFiles& results;
  std::function<void()> summary;  // prints the end of the run and the place of its results to standard error
};

// Makes the run directory, sets limits, watches for stops, calls `work` (returns the reason of a failure, or
// ""), and closes the directory. Returns the exit status.
int in_run_directory(const RunCommand& command, const std::function<std::string(RunContext&)>& work);

// Runs the script; returns the reason of a failure, or "". os.exit closes the directory and exits with
// `at_exit` of the script's status.
std::string run_script(RunContext& context, const std::function<int(int)>& at_exit);

// Why a given value set no knob of the finished script; "" if all did.
std::string unmade_knobs(const lua::Session& session);

// A Lua state for the script, with the command's settings.
lua::State make_state(lua::Session& session, const RunCommand& command);

// Loads and runs the script. Leaves `results` values and returns LUA_OK, or leaves an error with traceback.
int execute(lua_State* L, const RunCommand& command, const std::string& text, int results);

// Throws Error{bad_file}.
std::string read_script(const std::string& path);

// Counts grids and Lua's heap; the system limits libraries.
void limit_memory(std::int64_t bytes);
// Versions of the program and its libraries, for the manifest.
Json version_json();

}  // namespace asperity::cli
