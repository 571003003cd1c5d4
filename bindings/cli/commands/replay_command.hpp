// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity replay`: repeats a recorded run from its stored script in a new directory, then compares journals
// by line and files by digest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/commands/run_command.hpp"

namespace asperity::cli {

struct ReplayCommand {
  std::string recorded;               // directory
  std::optional<std::int64_t> from;   // journal line; earlier results come from the store
  std::vector<std::string> settings;  // "key=value", from that line on
  RunCommand run;  // limits and place of the new run; script, arguments and seed come from the record
};

Command replay_command(BehindBarriers<ReplayCommand> barriers);

// A variation (with settings) prints differences and returns the status of the run. Otherwise 0 for equal
// results, also if both runs failed the same way; 1 for a difference or an altered record; 2 without a
// record; 130 if interrupted.
int replay(const ReplayCommand& command);

}  // namespace asperity::cli
