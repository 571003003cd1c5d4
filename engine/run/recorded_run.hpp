// SPDX-License-Identifier: GPL-3.0-or-later
// A run loaded from its directory, and its differences from another run, except for members "unhashed".
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
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
  // "done", "failed", "shard" (lacks other cases), "interrupted", "killed", "running" (crashed).
  std::string status;
  std::string shard, store;  // of a shard: "1/3", shared folder
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
  std::vector<std::string> loaded_fault;  // one per altered copy

  // Under WebAssembly: pictures are events without files.
  bool left_pictures() const { return machine.find("pictures") != nullptr; }
  // Complete journal and list of files.
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

// Loaded script files, from the working folder.
std::vector<std::string> altered_originals(const RecordedRun& run);

struct Difference {
  std::string where;  // "line 4, contact:press, result"
  std::string recorded, again;
};

Difference difference_of(std::string where, const std::vector<DifferingMember>& members);

// Inputs, journal, outputs, expectations. An unfinished run is compared up to its end. Pictures that one of
// the runs did not draw are compared by their events.
std::vector<Difference> differences(const RecordedRun& recorded, const RecordedRun& again);

// Compares the results of a run by another minor version: rows of notebooks and verdicts of expectations.
// Versions may round differently and change laws, so numbers are compared to `digits_kept`; digests, files,
// keys and warnings are not compared.

// Relative. Other last digits of the heights change a solve within its tolerance (1e-6 by default), and a
// derived number by up to ten times as much (tests/contact/half_space/half_space_digits_test.cpp).
inline constexpr double digits_kept = 1e-5;

// "0.2.0" and "0.2.7", not "0.3.0"; also equal texts.
bool same_minor_version(std::string_view one, std::string_view other);

struct AcrossVersions {
  std::vector<Difference> differences;  // in recorded order
  std::int64_t compared = 0;            // recorded values and verdicts
};

// An unfinished run: up to its end. A number below 1e-12 of the greatest of its column is rounding, and is
// not compared.
AcrossVersions compare_across_versions(const RecordedRun& recorded, const RecordedRun& again);

}  // namespace asperity
