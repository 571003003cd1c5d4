// SPDX-License-Identifier: GPL-3.0-or-later
// Results of earlier runs: `--resume`, `--reuse` and `--store-limit` of `asperity run`, `--from` of `asperity
// replay`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bindings/cli/commands/shared_options.hpp"
#include "engine/run/journal.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/result_files.hpp"

namespace asperity::cli {

// The command that continues the run in `command.resume` with its script, arguments, seed, store and share.
// Without a manifest, a new run. None if the run is done and undamaged; a damaged run is repeated, with its
// damages named. `leads`: takes the directory's lock, unless held. Throws Error for
// - another script, arguments or seed, without `reuse`;
// - an unfinished or damaged run by another version, without `reuse`;
// - another share of the cases, or another `trust`;
// - a directory without a run, or links in place of a run's files;
// - a lock held by another process.
std::optional<RunCommand> taken_up(RunCommand command, bool leads = true);

// Throws Error{bad_value} for a prompt session, and for a trusted record unless the command trusts it: a
// foreign directory must not grant itself all of Lua. `purpose` as in "go on with".
void require_repeatable(const RunCommand& command, const RecordedRun& recorded, const char* purpose);

// Loads script files from the record's copies; names originals with other content.
void load_as_recorded(RunCommand& command, const RecordedRun& recorded, bool tell);

// Where a run stores and finds results; the folder stays empty. Throws Error{bad_value} for a `reuse` that is
// no folder, or a run whose store is a link.
ResultFilesSetup result_files(const RunCommand& command);

// A store without results from a journal line on.
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
