// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity lesson`: the lessons that come with the program, to be read, copied and run in a terminal.
#pragma once

#include <string>

#include "bindings/cli/commands/run_command.hpp"

namespace asperity::cli {

struct LessonCommand {
  std::string name;   // empty: list them all
  bool copy = false;  // writes the script into the present folder
  bool run = false;
  RunCommand options;  // of a run; its script is the lesson's
};

Command lesson_command();

// Exit status: that of the run, 0 otherwise, 2 for a lesson that is not there or a file that is there
// already.
int lesson(const LessonCommand& command);

}  // namespace asperity::cli
