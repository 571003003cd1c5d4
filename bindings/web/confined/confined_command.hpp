// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run --confined` for a foreign script. The program starts itself as a confined process
// (confined_main). This process reads the script and the --read folders, writes the run directory and the
// given store, and reaches no other file, process or network. The parent passes on output, exit status and
// signals, draws charts, and limits time and disk. Resume and replay are confined too.
#pragma once

#include "bindings/web/confined/confined_request.hpp"

namespace asperity::web {

// By option or recorded run.
bool to_be_confined(const cli::RunCommand& command);
bool to_be_confined(const cli::ReplayCommand& command);

// Exit status: of the command; 1 beyond a limit; 2 if a required barrier is missing or the command cannot be
// confined.
int run_behind_barriers(const cli::RunCommand& command);
int replay_behind_barriers(const cli::ReplayCommand& command);

// `asperity --confined`, the child of `asperity serve` and `asperity run --confined`: reads a request from
// standard input, confines itself (sandbox/confinement.hpp), and then runs or checks a script, runs a command
// or gnuplot, or tries the barriers. Returns the exit status. main() must call this first.
int confined_main();

// In the confined process: returns the command's exit status. `lock`: open lock file of the run directory, or
// -1.
int carry_out(CarriedCommand command, int lock);

}  // namespace asperity::web
