// SPDX-License-Identifier: GPL-3.0-or-later
// A run loaded from its directory, and its differences from another run, except for members "unhashed"
// (dates, seconds, machine, threads).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity {

struct DifferingMember;

// Copy of a file loaded by `require`, `dofile` or `loadfile`.
struct LoadedFile {
  std::string text, digest;
};
using LoadedFiles = std::map<std::string, LoadedFile, std::less<>>;  // by name in the script

struct RecordedRun {
  std::filesystem::path root;
  // "done", "failed", "shard" (ended for lack of other cases), "interrupted", "killed", "running" (crashed).
  std::string status;
  std::string shard, store;  // "1/3" and the shared folder, of a shard; else ""
  std::string script_path;   // as given
  std::string script_text;
  std::vector<std::string> arguments;
  std::int64_t seed = 1;
  GivenKnobs knobs;  // the values given
  bool trusted = false;
  Json versions;
  Json machine = Json::object();  // machine_facts(); may be empty
  std::vector<Json> journal;
  std::string journal_fault;  // a sentence; its replacement
  std::string journal_hint;
  Json manifest;
  Json inputs = Json::List();             // so far
  LoadedFiles loaded;                     // with unaltered copies
  std::vector<std::string> loaded_fault;  // a sentence for each altered copy

  // Journal and list of files are complete.
  bool ended() const { return status == "done" || status == "failed"; }
};

// "0.1.0"; "" if not recorded.
std::string program_version(const RecordedRun& run);

// Throws Error{bad_file} if it is missing or no JSON.
Json read_manifest(const std::filesystem::path& root);

// Throws Error{bad_file} if there is no run, its script was altered, or, unless `journal_may_be_damaged`, a
// journal line is missing or no JSON. Skips a torn last line of an unfinished run.
RecordedRun read_run(const std::filesystem::path& root, bool journal_may_be_damaged = false);

// A sentence per missing or altered output or copy.
std::vector<std::string> altered_outputs(const RecordedRun& run);

// The same for input files, from the working folder; empty for an unfinished run.
std::vector<std::string> altered_inputs(const RecordedRun& run);

// A sentence per loaded file that changed since, from the working folder.
std::vector<std::string> altered_originals(const RecordedRun& run);

struct Difference {
  std::string where;  // "line 4, contact:press, result"
  std::string recorded, again;
};

Difference difference_of(std::string where, const std::vector<DifferingMember>& members);

// Inputs, journal, outputs, expectations. An unfinished run is compared as far as it came.
std::vector<Difference> differences(const RecordedRun& recorded, const RecordedRun& again);

}  // namespace asperity
