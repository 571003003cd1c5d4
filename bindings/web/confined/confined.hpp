// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity --confined`: the program as the child of `asperity serve` or `asperity run --confined`. It reads
// from standard input what it is to do, goes behind the barriers (sandbox/confinement.hpp), and only then
// begins: a script is run, once or as its knobs move, or checked, a command line is carried out, a chart is
// drawn by gnuplot, or the barriers are tried.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/web/sandbox/confinement.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

// Open in the child beside the standard streams.
inline constexpr int events_descriptor = 3, drawing_descriptor = 4, lock_descriptor = 5;

enum class Work { run, check, draw, probe, command, live };

struct ConfinedRequest {
  Work work = Work::run;
  Confinement confinement;
  std::string script{};  // the text
  std::string name{};    // of the script, as errors show it: "script.lua"
  std::int64_t seed = 1;
  double seconds = 60;  // the script's own limit of time
  int threads = 1;
  bool views = false;
  GivenKnobs knobs{};
  std::vector<std::string> barriers{};  // what must stand before a script is begun, as confine() names it
  Json command{};                       // of `asperity run --confined` (confined_command.hpp); else null
  int lock = -1;  // open file of the lock of its run directory, which the child inherits; -1: none
};

Json to_json(const ConfinedRequest& request);
// Throws Error{bad_file}.
ConfinedRequest confined_request(const Json& json);

// The exit status of the process. Called first thing in main().
int confined_main();

}  // namespace asperity::web
