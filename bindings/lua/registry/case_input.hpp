// SPDX-License-Identifier: GPL-3.0-or-later
// What a case of an ensemble depends on beside its arguments: the files it looked at, the knobs it asked for,
// and whether it drew random numbers. The stored result of a case is used again only where all of these are
// as they were.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/recorded_run.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::lua {

// A file that a case looked at; no digest where there was none. One that `require` found in the folder of the
// script is known by its name there: another run looks in the folder of its own script.
struct CaseInput {
  std::string file;
  std::int64_t bytes = 0;
  std::string digest;
  std::string beside_script = {};  // "helper.lua"; else empty
  bool loaded = false;             // by `require`, `dofile` or `loadfile`
};
CaseInput input_of_case(const std::string& file);
// Of a file as it is now; empty where there is none.
std::string present_digest(const std::string& file);
// The recorded copy of a loaded file, for replay and resume; null without one.
const LoadedFile* recorded_copy(const std::shared_ptr<const LoadedFiles>& loaded, const std::string& file);

class Session;
// Adds the files of a case to the inputs of the run, or of the outer case.
void note_inputs_of_case(const Session& session, const std::vector<CaseInput>& inputs);

struct CaseNotes {
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;
  bool drew = false;  // random numbers, which its seed decides
};

}  // namespace asperity::lua
