// SPDX-License-Identifier: GPL-3.0-or-later
// A run read back from its directory: its script and inputs, its results, and where another run of
// the same script found something else. Members named "unhashed" (dates, seconds, machine, threads) are left
// out: all the rest of two equal runs is equal to the byte. Reads JSON and digests files; runs nothing.
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

// The recorded copy of a script file loaded by `require`, `dofile` or `loadfile`.
struct LoadedFile {
  std::string text, digest;
};
using LoadedFiles = std::map<std::string, LoadedFile, std::less<>>;  // by the name it was loaded under

struct RecordedRun {
  std::filesystem::path root;
  // "done", "failed", "shard" (it ended at an ensemble for lack of the cases of others), "interrupted",
  // "killed", or "running" where it was cut off.
  std::string status;
  std::string shard, store;  // "1/3", of a run that computed a share; and the folder that it shared; else ""
  std::string script_path;   // as it was given
  std::string script_text;
  std::vector<std::string> arguments;
  std::int64_t seed = 1;
  GivenKnobs knobs;  // the values it was made with
  bool trusted = false;
  Json versions;
  Json machine = Json::object();  // machine_facts() of where it ran; empty where they were not noted
  std::vector<Json> journal;      // a line each
  std::string journal_fault;      // a sentence with its fault and its replacement; else ""
  std::string journal_hint;
  Json manifest;
  Json inputs = Json::List();             // as far as the run had come
  LoadedFiles loaded;                     // whose copies are as the run made them
  std::vector<std::string> loaded_fault;  // a sentence for each other copy

  // Whether it came to its own end, so that its journal is whole and its files are listed.
  bool ended() const { return status == "done" || status == "failed"; }
};

// The version of the program that recorded it, "0.1.0"; "" where the record does not say.
std::string program_version(const RecordedRun& run);

// The manifest alone. Throws Error{bad_file} where there is none or it is no JSON.
Json read_manifest(const std::filesystem::path& root);

// Throws Error{bad_file} where there is no run, where its script is no longer the one that ran, or, unless
// `journal_may_be_damaged`, where a line of the journal is no JSON or is missing. The last line of a run that
// was cut off may be torn; it is left out.
RecordedRun read_run(const std::filesystem::path& root, bool journal_may_be_damaged = false);

// A sentence for each output, or copy of a loaded file, that is missing or differs from the manifest.
std::vector<std::string> altered_outputs(const RecordedRun& run);

// The same of the files that it read, as they are found from the working folder; none of a run that did not
// come to its end. O(their bytes).
std::vector<std::string> altered_inputs(const RecordedRun& run);

// A sentence for each loaded file with other content now, as seen from the working folder. Replay and resume
// load the copies.
std::vector<std::string> altered_originals(const RecordedRun& run);

struct Difference {
  std::string where;  // "line 4, contact:press, result"
  std::string recorded, again;
};

// Of members that differ: one by its value, several by their names and values.
Difference difference_of(std::string where, const std::vector<DifferingMember>& members);

// In the order of the journal, then inputs, outputs and expectations. Of a run that did not come to its end
// only the lines it wrote are compared.
std::vector<Difference> differences(const RecordedRun& recorded, const RecordedRun& again);

}  // namespace asperity
