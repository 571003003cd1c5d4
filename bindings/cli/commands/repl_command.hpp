// SPDX-License-Identifier: GPL-3.0-or-later
// The prompt without its terminal, for a caller with lines of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace asperity::cli {

struct ReplCommand {
  std::optional<std::string> out;
  int threads = 0;  // 0: one per processor
  std::uint64_t seed = 1;
  std::optional<std::int64_t> limit_memory;  // bytes
  std::optional<double> limit_time;          // seconds, each line
  bool trust = false;
  bool no_history = false;
};

class Conversation;

// Prints values on standard output, errors on standard error.
class PromptLines {
 public:
  explicit PromptLines(const ReplCommand& command);
  ~PromptLines();
  // False at the end of the session.
  bool take(const std::string& line);
  // The statement is incomplete.
  bool continued() const;

 private:
  const ReplCommand command_;
  std::unique_ptr<Conversation> conversation_;
};

}  // namespace asperity::cli
