// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs of an ensemble's case besides its arguments: files, knobs and random numbers. A stored result
// requires equal inputs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/recorded_run.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::lua {

// A file that a case read or looked for; no digest if missing. Files found by `require` in the script's
// folder are named relative to it, because runs may have different folders.
struct CaseInput {
  std::string file;
  std::int64_t bytes = 0;
  std::string digest;
  std::string beside_script = {};  // "helper.lua"; else empty
  bool loaded = false;             // by `require`, `dofile` or `loadfile`
};
CaseInput input_of_case(const std::string& file);
// Empty if the file is missing.
std::string present_digest(const std::string& file);
// For replay and resume; null if none.
const LoadedFile* recorded_copy(const std::shared_ptr<const LoadedFiles>& loaded, const std::string& file);

class Session;
// To the run, or to the outer case.
void note_inputs_of_case(const Session& session, const std::vector<CaseInput>& inputs);

struct CaseNotes {
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;
  bool drew = false;  // random numbers, which depend on the seed
};

}  // namespace asperity::lua
