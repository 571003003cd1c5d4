// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run --confined` for a script from somebody else. The program starts itself again as a confined
// process (confined.hpp) that carries out the command. The process reads the script and the --read folders,
// writes the run directory and the given store, and reaches no other file, process or network. This side
// passes on output, exit status and signals, draws the charts, and enforces the limits of time and disk.
// Resuming or replaying a confined run is confined, too.
#pragma once

#include "bindings/cli/commands/replay_command.hpp"
#include "bindings/cli/commands/run_command.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

// True if the command asks for barriers, or if its recorded run was confined.
bool to_be_confined(const cli::RunCommand& command);
bool to_be_confined(const cli::ReplayCommand& command);

// Returns the command's exit status; 2 if a required barrier is missing or the command cannot be confined; 1
// if a limit was exceeded.
int run_behind_barriers(const cli::RunCommand& command);
int replay_behind_barriers(const cli::ReplayCommand& command);

// In the confined process: carries out the command prepared above and returns its exit status. `lock`: open
// lock file of the run directory, or -1.
int carry_out(const Json& command, int lock);

}  // namespace asperity::web
