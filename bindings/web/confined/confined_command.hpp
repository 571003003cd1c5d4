// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run --confined`: a script of somebody else's behind the barriers of the page's runs. This program
// is started again as a confined process (confined.hpp) that carries out the command: it reads the
// script and the folders given by --read, writes the run directory and the store given, and reaches no other
// file, process or network. Its output, its exit status and the signals that are meant for it pass through
// here, its charts are drawn from here, and time and disk are watched from here. A run that was recorded so
// is resumed and replayed so.
#pragma once

#include "bindings/cli/commands/replay_command.hpp"
#include "bindings/cli/commands/run_command.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

// Whether the command asks for barriers, or goes on with or replays a run that was recorded behind them.
bool to_be_confined(const cli::RunCommand& command);
bool to_be_confined(const cli::ReplayCommand& command);

// The exit status: that of the command; 2 where a barrier is missing that the command does not do without, or
// where the command is none for a confined process; 1 where a limit that is watched from here was met.
int run_behind_barriers(const cli::RunCommand& command);
int replay_behind_barriers(const cli::ReplayCommand& command);

// In the confined process: carries out what the two above made of the command. `lock`: the open file of the
// lock of its run directory, or -1. The exit status.
int carry_out(const Json& command, int lock);

}  // namespace asperity::web
