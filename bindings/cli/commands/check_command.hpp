// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity check` and `asperity explain`: a script followed without its heavy calls.
#pragma once

#include "bindings/cli/commands/run_command.hpp"

namespace asperity::cli {

Command check_command();
Command explain_command();

// Exit statuses are those of run().
int check(const RunCommand& command);
// What the script will compute and at what cost: surfaces are made, contacts planned, nothing is pressed.
int explain(const RunCommand& command, bool json);

}  // namespace asperity::cli
