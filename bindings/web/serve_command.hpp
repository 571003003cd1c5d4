// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity serve`: the page on this machine's own address, or, where a room is named, on another.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bindings/cli/commands/command.hpp"

namespace asperity::web {

struct ServeCommand {
  int port = 0;                              // 0: any that is free
  bool open = false;                         // the page, in this machine's browser
  std::string classroom;                     // the address to serve a room on; "": this machine alone
  int students = 0;                          // tokens to make for them
  std::string names;                         // or a file of their names, one a line
  std::string out;                           // where runs are kept; "": runs/serve-<n>
  int runs = 0;                              // at once; 0: as many as suit the machine
  std::optional<double> limit_time;          // seconds of one run
  std::optional<std::int64_t> limit_memory;  // bytes of one run
};

cli::Command serve_command();

// Exit status: 0 after Ctrl-C, 2 where it could not be begun.
int serve(const ServeCommand& command);

}  // namespace asperity::web
