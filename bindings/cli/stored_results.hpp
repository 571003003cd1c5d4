// SPDX-License-Identifier: GPL-3.0-or-later
// What a run keeps of its heavy calls, and what it takes from runs before it: `--resume`, `--reuse` and
// `--store-limit` of `asperity run`, `--from` of `asperity replay`.
#pragma once

#include <cstdint>
#include <optional>

#include "bindings/cli/commands/run_command.hpp"
#include "engine/run/journal.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/result_files.hpp"

namespace asperity::cli {

// The command that continues the run in `command.resume`, with its script, arguments, seed, store and share.
// A directory without a manifest begins a new run. The result is empty if the run is done and its journal and
// outputs have the digests of the manifest; otherwise the command names the damages and makes the run again.
// `leads`: takes the lock of the directory, unless the command has it already. Throws Error for
// - another script, other arguments or another seed, unless `reuse` is given;
// - an unfinished or damaged run by another version, unless `reuse` is given;
// - another share of the cases, or a run with another `trust`;
// - a directory without a run, and a run with links in place of its files;
// - a lock held by another process.
std::optional<RunCommand> taken_up(RunCommand command, bool leads = true);

// Throws Error{bad_value} for a session of the prompt, and unless the command trusts its script as the
// recorded run did: a directory from elsewhere shall not give itself the whole of Lua. `purpose` as in "go on
// with".
void require_repeatable(const RunCommand& command, const RecordedRun& recorded, const char* purpose);

// Loads script files from the copies in the recorded run, and names originals with other content.
void load_as_recorded(RunCommand& command, const RecordedRun& recorded, bool tell);

// How results of a run are kept, and where else they are looked for; the folder is left open. Throws
// Error{bad_value} for a `reuse` that is no folder, or a run whose store is a link.
ResultFilesSetup result_files(const RunCommand& command);

// A store from which nothing is taken from a line of the journal on.
class UntilLine final : public ResultStore {
 public:
  UntilLine(ResultStore& store, const Journal& journal, std::int64_t line)
      : store_(store), journal_(journal), line_(line) {}
  std::optional<FoundResult> find(const std::string& key) override {
    if (journal_.count() + 1 >= line_) return {};
    return store_.find(key);
  }
  void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
            const KeptFields& fields) override {
    store_.keep(key, call, facts, fields);
  }

 private:
  ResultStore& store_;
  const Journal& journal_;
  std::int64_t line_;
};

}  // namespace asperity::cli
