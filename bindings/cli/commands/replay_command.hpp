// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity replay`: a recorded run again, from its own copy of the script, into a directory of its own; then
// every line of the two journals and every file is compared by its digest
// (engine/run/recorded_run.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/commands/run_command.hpp"

namespace asperity::cli {

struct ReplayCommand {
  std::string recorded;               // its directory
  std::optional<std::int64_t> from;   // line of its journal before which results are taken from its store
  std::vector<std::string> settings;  // "key=value": what is to be different from that line on
  RunCommand run;  // limits and place of the new one; script, arguments and seed come from the record
};

Command replay_command(BehindBarriers<ReplayCommand> barriers);

// A variation, which names settings, is no comparison: differences are shown, and the status is that of the
// run. Exit status: 0 for equal results, also of a run that failed the same way; 1 where anything differs or
// the record was altered; 2 where there is no record; 130 interrupted.
int replay(const ReplayCommand& command);

}  // namespace asperity::cli
