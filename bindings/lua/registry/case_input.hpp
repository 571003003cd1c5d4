// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs of an ensemble's case besides its arguments: files, knobs and random numbers. A stored result is
// reused only if all inputs are unchanged.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/recorded_run.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::lua {

// A file read or looked for by a case; the digest is empty if the file was missing. A file found by `require`
// in the script's folder is named relative to the folder, because another run may have another folder.
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
// Adds the files to the inputs of the run, or of the outer case.
void note_inputs_of_case(const Session& session, const std::vector<CaseInput>& inputs);

struct CaseNotes {
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;
  bool drew = false;  // random numbers, which depend on the seed
};

}  // namespace asperity::lua
