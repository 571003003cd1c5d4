// SPDX-License-Identifier: GPL-3.0-or-later
// The request of a run, and options of several commands that fill it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/session.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/case_scheduler.hpp"
#include "engine/run/run_knobs.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace asperity {
class RunLock;
class TemporaryFolder;
}  // namespace asperity

namespace asperity::cli {

class MpiRanks;
class RunObserver;

struct RunCommand {
  std::string script;
  std::optional<std::string> out;
  int threads = 0;  // 0: one per processor
  std::uint64_t seed = 1;
  bool seed_given = false;
  std::optional<std::int64_t> limit_memory;  // bytes
  std::optional<double> limit_time;          // seconds
  bool trust = false;
  bool trace = false;  // errors with tracebacks
  std::vector<std::string> arguments;
  GivenKnobs knobs;
  std::optional<std::string> text;            // instead of the file
  std::optional<std::string> resume;          // an unfinished run
  bool anew = false;                          // another script: moves old files aside, keeps results
  bool journal_lost = false;                  // resume with a new journal
  std::vector<std::string> damages;           // one sentence each
  std::shared_ptr<const LoadedFiles> loaded;  // of the recorded run
  std::shared_ptr<RunLock> lock;              // of the directory, if held
  std::vector<std::string> reuse;             // runs or result folders
  std::optional<std::string> store;           // shared, instead of the run's own
  std::optional<Shard> shard;                 // of ensemble cases; needs `store`
  std::optional<CaseNumber> one_case;         // without a directory; needs `store`
  bool merge_only = false;                    // no computation; needs `store`
  std::optional<std::int64_t> store_limit;    // bytes; 0: none
  // In a replay: no `reuse` from this journal line on.
  std::optional<std::int64_t> afresh_from;
  std::shared_ptr<lua::Variation> variation;  // of a replay, or null
  RunObserver* observer = nullptr;            // instead of standard error, or null
  MpiRanks* ranks = nullptr;                  // null: single process

  std::shared_ptr<const TemporaryFolder> case_folder;  // deleted at the end

  // Behind the barriers of page runs (bindings/web/confined/confined_command.hpp).
  bool confined = false;
  std::vector<std::string> read;  // further readable folders
  std::string without_barriers;   // not required: "files,network"
  // Bytes of the run directory and of new results in a shared store.
  std::optional<std::int64_t> limit_disk;
  // In the confined process: barriers and readable folders; whether standard error, a pipe, ends at a
  // terminal.
  Json barriers{};
  bool terminal = false;
};

// All throw Error{bad_value} for a wrong value. The variables must outlive the parsing.

void add_seed(CLI::App& options, std::uint64_t& seed);
// Script (required), seed, --limit-time and arguments. Returns the script's option.
CLI::Option* add_script_options(CLI::App& options, RunCommand& run);
// "pressure=50 MPa", repeatable.
void add_knobs(CLI::App& options, GivenKnobs& knobs);
// "60s", "2 min", or positive seconds; none for "".
void add_seconds(CLI::App& options, const std::string& name, std::optional<double>& seconds,
                 const std::string& help);
// "4G", "512M", "64KiB", "1000000"; none for "".
void add_bytes(CLI::App& options, const std::string& name, std::optional<std::int64_t>& bytes,
               const std::string& limit, const std::string& help);
// --threads and --limit-memory.
void add_machine_options(CLI::App& options, int& threads, std::optional<std::int64_t>& memory);
// --out and the machine options.
void add_run_options(CLI::App& options, RunCommand& run);
void add_trust(CLI::App& options, bool& trust);
// --confined and its options.
void add_confinement(CLI::App& options, RunCommand& run);
// --resume, --reuse, --store and their options.
void add_store_options(CLI::App& options, RunCommand& run);

// Throws Error{bad_value} for its options in another run.
void check_confinement(const RunCommand& run);

// "2/3"; "slurm" reads SLURM_ARRAY_TASK_ID, _MIN and _COUNT of a job array with consecutive numbers. Throws
// Error{bad_value}.
Shard parse_shard(const std::string& text);

// Throws Error{bad_file}.
std::string read_script(const std::string& path);

}  // namespace asperity::cli
