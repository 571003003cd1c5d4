// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity --confined`: the child process of `asperity serve` and `asperity run --confined`. It reads a
// request from standard input and confines itself (sandbox/confinement.hpp) before any work: run a script
// once or live, check a script, carry out a command line, draw a chart with gnuplot, or try the barriers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

// Open in the child besides the standard streams.
inline constexpr int events_descriptor = 3, drawing_descriptor = 4, lock_descriptor = 5;

enum class Work { run, check, draw, probe, command, live };

struct ConfinedRequest {
  Work work = Work::run;
  Confinement confinement;
  std::string script{};  // text of the script
  std::string name{};    // of the script in errors: "script.lua"
  std::int64_t seed = 1;
  double seconds = 60;  // time limit of the script
  int threads = 1;
  bool views = false;
  GivenKnobs knobs{};
  std::vector<std::string> barriers{};  // barriers required before a script starts, named as in confine()
  Json command{};                       // of `asperity run --confined` (confined_command.hpp); else null
  int lock = -1;  // open lock file of the run directory, inherited by the child; -1: none
};

Json to_json(const ConfinedRequest& request);
// Throws Error{bad_file}.
ConfinedRequest confined_request(const Json& json);

// Returns the exit status of the process. main() must call this first.
int confined_main();

}  // namespace asperity::web
