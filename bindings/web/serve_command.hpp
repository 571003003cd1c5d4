// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bindings/cli/commands/command.hpp"

namespace asperity::web {

struct ServeCommand {
  int port = 0;                              // 0: any free port
  bool open = false;                         // in this machine's browser
  std::string classroom;                     // "": this machine only
  int students = 0;                          // number
  std::string names;                         // one name a line
  std::string lessons;                       // a folder; "": those of the program
  std::string out;                           // "": runs/serve-<n>
  int runs = 0;                              // 0: by machine
  std::optional<double> limit_time;          // seconds for a run
  std::optional<std::int64_t> limit_memory;  // bytes for a run
};

cli::Command serve_command();

// 0 after Ctrl-C, 2 without a server.
int serve(const ServeCommand& command);

}  // namespace asperity::web
