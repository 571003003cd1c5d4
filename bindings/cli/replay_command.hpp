// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity replay`: a recorded run again, from its own copy of the script, into a directory of its own; then
// every line of the two journals and every file is compared by its digest
// (engine/experiment/recorded_run.hpp).
#pragma once

#include <string>

#include "bindings/cli/run_command.hpp"

namespace asperity::cli {

struct ReplayCommand {
  std::string recorded;  // its directory
  RunCommand run;        // limits and place of the new one; script, arguments and seed come from the record
};

// Exit status: 0 for equal results, also of a run that failed the same way; 1 where anything differs or the
// record was altered; 2 where there is no record; 130 interrupted.
int replay(const ReplayCommand& command);

}  // namespace asperity::cli
