// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run`: a script from file to exit status; and functions shared with other commands for scripts and
// run directories.
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
  int threads = 0;  // 0: one a processor
  std::uint64_t seed = 1;
  bool seed_given = false;
  std::optional<std::int64_t> limit_memory;  // bytes
  std::optional<double> limit_time;          // seconds
  bool trust = false;
  std::vector<std::string> arguments;
  GivenKnobs knobs;
  std::optional<std::string> text;    // of the script, where it is not read from its file
  std::optional<std::string> resume;  // directory of a run that was cut off
  bool anew = false;                  // of another script: its files are moved aside, its results stay
  bool journal_lost = false;          // the resumed run begins its journal again
  std::vector<std::string> damages;   // of the resumed run, a sentence each
  std::shared_ptr<const LoadedFiles> loaded;  // by the resumed or replayed run
  std::shared_ptr<RunLock> lock;              // of the directory, where it was taken already
  std::vector<std::string> reuse;             // runs, or folders of results, to take results from
  std::optional<std::string> store;           // shared folder of results instead of the run's
  std::optional<Shard> shard;                 // of the cases of ensembles; needs `store`
  std::optional<CaseNumber> one_case;  // computes this case alone; needs `store`, and leaves no directory
  bool merge_only = false;             // computes no case; needs `store`
  std::optional<std::int64_t> store_limit;  // bytes of results to keep; 0: none
  // A replay takes nothing from `reuse` from this line of the journal on.
  std::optional<std::int64_t> afresh_from;
  std::shared_ptr<lua::Variation> variation;  // of a replay; may be null
  RunObserver* observer = nullptr;            // gets the messages instead of standard error; may be null
  MpiRanks* ranks = nullptr;                  // the processes of the run; null where it is the only one

  std::shared_ptr<const TemporaryFolder> case_folder;  // of `one_case`: removed at the end

  // Behind the barriers of the page's runs (bindings/web/confined/confined_command.hpp).
  bool confined = false;
  std::vector<std::string> read;  // folders that it reads besides the script's own
  std::string without_barriers;   // which need not stand: "files,network"
  // Limit of bytes for all files of the run directory and for new results in a shared store.
  std::optional<std::int64_t> limit_disk;
  // In the confined process: its barriers and readable folders, for the manifest; and whether its standard
  // error, a pipe, ends at a terminal.
  Json barriers{};
  bool terminal = false;
};

// The other way to carry a command out: behind barriers of the operating system, by a process that is
// confined. bindings/main.cpp hands it down from bindings/web/confined/confined_command.hpp, which stands
// above.
template <class Asked>
struct BehindBarriers {
  bool (*wanted)(const Asked& asked);    // by its options, or by the record that it goes on with
  int (*carry_out)(const Asked& asked);  // the exit status
};

Command run_command(BehindBarriers<RunCommand> barriers);

// Exit status: 0 done, 1 the script or an expectation failed, 2 bad usage or another process runs there, 3
// cases are missing in the store, 130 interrupted, 143 asked to end (TERM), 129 the terminal was closed
// (HUP).
int run(const RunCommand& command);
// `asperity check`: the script is followed without its heavy calls. Exit statuses are those of run().
int check(const RunCommand& command);

// Objects for the work of a run.
struct RunContext {
  const RunCommand& command;
  const std::string& text;  // of the script
  std::shared_ptr<RunDirectory> run;
  TerminalMonitor& monitor;
  Watchdog& watchdog;
  ResultFiles& results;
  std::function<void()> summary;  // says on standard error how the run ended, and where its results are
};

// Makes the run directory, sets the limits and watches for stops; then `work`, which returns why the run
// failed, "" if it did not; and closes the directory. Returns the exit status.
int in_run_directory(const RunCommand& command, const std::function<std::string(RunContext&)>& work);

// Runs the script to its end, or to its os.exit: then the directory is closed, `at_exit` is asked for the
// exit status, given that of the script, and the program ends there. Returns why it failed, "" if it did not.
std::string run_script(RunContext& context, const std::function<int(int)>& at_exit);

// Why a value that was given set no knob of the script that has ended; "" where each did.
std::string unmade_knobs(const lua::Session& session);

// A Lua state for the command's script, whose session is given what the command says.
lua::State make_state(lua::Session& session, const RunCommand& command);

// Loads and runs the script. Leaves `results` values and returns LUA_OK, or leaves an error message with
// its traceback.
int execute(lua_State* L, const RunCommand& command, const std::string& text, int results);

// The text of a script. Throws Error{bad_file}.
std::string read_script(const std::string& path);

// Holds the process to so much memory: grids and Lua's heap by count, what libraries take by the system.
void limit_memory(std::int64_t bytes);
// Versions of the program and what it is made of, for the manifest.
Json version_json();

}  // namespace asperity::cli
