// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of standard input: edited with history and completion on a terminal if the libedit part is present,
// unchanged and without prompts from a pipe or file. During a read, Ctrl-C discards the line, and SIGTERM or
// SIGHUP ends the input; otherwise these signals are blocked for the watchdog.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/edit/line_editor.hpp"
#include "bindings/lua/editor/completion.hpp"

namespace asperity::cli {

// The prompt's history in $XDG_STATE_HOME/asperity/history (default ~/.local/state/asperity/history), mode
// 0600. Lines are appended at once: parallel and killed sessions lose nothing; a session's start cuts the
// file to a thousand lines. Ignores errors.
class LineHistory {
 public:
  static constexpr std::size_t most_lines = 1000;
  // Without a file, in memory only.
  explicit LineHistory(std::filesystem::path file = {});
  // Empty without a home.
  static std::filesystem::path default_file();

  const std::vector<std::string>& lines() const { return lines_; }
  // Skips empty lines, leading spaces, and repetitions.
  bool add(const std::string& line);

 private:
  std::filesystem::path file_;
  std::vector<std::string> lines_;
};

class LineReader {
 public:
  using Complete = std::function<lua::Completion(std::string_view line, std::size_t position)>;

  // Blocks the stop signals in this and later threads: construct first.
  LineReader(LineHistory history, Complete complete);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  bool terminal() const { return terminal_; }
  enum class Event { line, given_up, end };
  Event read(const std::string& prompt, std::string& line);
  // The input's end signal, or 0.
  int ended_by() const;

 private:
  Event read_plain(const std::string& prompt, std::string& line);
  void remember(const std::string& line);
  int next_byte(unsigned char* byte);
  AsperityEditAnswer answer(std::string_view line, std::size_t before);

  bool terminal_;
  void* editor_ = nullptr;
  LineHistory history_;
  Complete complete_;
  std::string insert_, list_;
};

// For a terminal of `columns`; short lists have descriptions.
std::string candidate_list(const std::vector<lua::Candidate>& candidates, int columns);

}  // namespace asperity::cli
