// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity repl`: a conversation with the laboratory. Lines come from a terminal, edited and completed, or
// from a pipe, read as they are; each is run as it comes, and its value is shown. A run directory is made
// when the first file is written; its script.lua is what was said, less the lines that failed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bindings/cli/commands/command.hpp"

namespace asperity::cli {

struct ReplCommand {
  std::optional<std::string> out;
  int threads = 0;  // 0: one a processor
  std::uint64_t seed = 1;
  std::optional<std::int64_t> limit_memory;  // bytes
  std::optional<double> limit_time;          // seconds, of one line
  bool trust = false;
  bool no_history = false;
};

Command repl_command();

// Exit status: 0; what os.exit was given; without a terminal 1 where a line or an expectation failed; 130
// where a signal ended it.
int repl(const ReplCommand& command);

}  // namespace asperity::cli
