// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity run` and `asperity check`: a script from file to exit status.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace asperity::cli {

struct RunCommand {
  std::string script;
  std::optional<std::string> out;
  int threads = 0;  // 0: one a processor
  std::uint64_t seed = 1;
  std::optional<std::int64_t> limit_memory;  // bytes
  std::optional<double> limit_time;          // seconds
  bool trust = false;
  std::vector<std::string> arguments;
};

// Exit status: 0 done, 1 the script or an expectation failed, 2 bad usage, 130 interrupted.
int run(const RunCommand& command);
int check(const RunCommand& command);

// "4G", "512M", "64KiB", "1000000". Throws Error{bad_value}.
std::int64_t parse_bytes(const std::string& text);

}  // namespace asperity::cli
