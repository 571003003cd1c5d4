// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of standard input. On a terminal, lines have editing, history and completion if the libedit part is
// present, otherwise the terminal's own editing. Lines from a pipe or file are read unchanged, without
// prompts. During a read, Ctrl-C discards the line, and SIGTERM or SIGHUP ends the input; at other times
// these signals are blocked for the watchdog.
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
// 0600. Each line is appended at once, so that parallel or killed sessions lose nothing; the file is cut to
// the last thousand lines at the start of a session. Read and write errors are ignored.
class LineHistory {
 public:
  static constexpr std::size_t most_lines = 1000;
  // Without a file, nothing is stored.
  explicit LineHistory(std::filesystem::path file = {});
  // From the environment; empty without a home.
  static std::filesystem::path default_file();

  const std::vector<std::string>& lines() const { return lines_; }
  // Skips empty lines, lines with a leading space, and repetitions.
  bool add(const std::string& line);

 private:
  std::filesystem::path file_;
  std::vector<std::string> lines_;
};

class LineReader {
 public:
  using Complete = std::function<lua::Completion(std::string_view line, std::size_t position)>;

  // Blocks the stop signals in this thread and its later threads: construct before any other thread.
  LineReader(LineHistory history, Complete complete);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  bool terminal() const { return terminal_; }
  enum class Event { line, given_up, end };
  Event read(const std::string& prompt, std::string& line);
  // 0, or the number of the signal that ended the input.
  int ended_by() const;

 private:
  Event read_plain(const std::string& prompt, std::string& line);
  int next_byte(unsigned char* byte);
  AsperityEditAnswer answer(std::string_view line, std::size_t before);

  bool terminal_;
  void* editor_ = nullptr;
  LineHistory history_;
  Complete complete_;
  std::string insert_, list_;
};

// The candidates as lines of this width; short lists have descriptions.
std::string candidate_list(const std::vector<lua::Candidate>& candidates, int columns);

}  // namespace asperity::cli
