// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity accuracy`: what accuracy costs a script that returns a number. The script is run again with
// every `cells` it gives multiplied by a factor, and with another tolerance for its contacts, and what
// comes out is a study of work and precision (engine/study/work_precision.hpp).
#pragma once

#include <optional>

#include "bindings/cli/commands/run_command.hpp"

namespace asperity::cli {

struct AccuracyCommand {
  RunCommand run;
  double at_most = 300;         // seconds, for all runs of the script
  int repeats = 3;              // timed runs a setting
  std::optional<double> truth;  // the exact value, SI; otherwise the finest grid gives it
};

Command accuracy_command();

// Exit status as of cli::run; 1 also for a script that returns no number, or gives nothing to vary.
int accuracy(const AccuracyCommand& command);

}  // namespace asperity::cli
