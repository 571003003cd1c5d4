// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity --confined`: the child of `asperity serve` and `asperity run --confined`. It reads a request from
// standard input, confines itself (sandbox/confinement.hpp), and then runs or checks a script, runs a command
// or gnuplot, or tries the barriers.
#pragma once

#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

inline constexpr int events_descriptor = 3, drawing_descriptor = 4, lock_descriptor = 5;

enum class Work { run, check, draw, probe, command, live };

struct ConfinedRequest {
  Work work = Work::run;
  Confinement confinement;
  std::string script{};
  std::string name{};  // in errors: "script.lua"
  std::int64_t seed = 1;
  double seconds = 60;  // time limit of the script
  int threads = 1;
  bool views = false;
  GivenKnobs knobs{};
  std::vector<std::string> barriers{};  // required; names as in confine()
  Json command{};                       // confined_command.hpp; else null
  int lock = -1;                        // open lock file of the run directory; -1: none
};

Json to_json(const ConfinedRequest& request);
// Throws Error{bad_file}.
ConfinedRequest confined_request(const Json& json);

// Returns the exit status. main() must call this first.
int confined_main();

}  // namespace asperity::web
