// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of standard input. From a terminal they are edited, with those of earlier sessions to come back to
// and Tab to complete, if the part that brings libedit is there; without it the terminal's own editing does.
// From a pipe or a file they are read as they are, without prompts. While it waits, Ctrl-C gives up the line
// and SIGTERM or SIGHUP ends the input; both are blocked otherwise, for whoever watches over the work.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/edit/line_editor.hpp"
#include "bindings/lua/editor/completion.hpp"

namespace asperity::cli {

// The lines typed at a prompt, kept from session to session in $XDG_STATE_HOME/asperity/history
// (~/.local/state/asperity/history without it), readable by nobody else. A line is added as it is typed, so
// that sessions side by side and one that is killed lose nothing; when a session begins the file is cut to
// the last thousand lines. What cannot be read or written is passed over: a prompt works without it.
class LineHistory {
 public:
  static constexpr std::size_t most_lines = 1000;
  // Without a file nothing is kept.
  explicit LineHistory(std::filesystem::path file = {});
  // Where the environment says it goes; empty if there is no home.
  static std::filesystem::path default_file();

  const std::vector<std::string>& lines() const { return lines_; }
  // Empty lines, those that begin with a space, and the same line again are not kept.
  bool add(const std::string& line);

 private:
  std::filesystem::path file_;
  std::vector<std::string> lines_;
};

class LineReader {
 public:
  using Complete = std::function<lua::Completion(std::string_view line, std::size_t position)>;

  // Blocks the signals of a stop in this thread and those it starts: construct it before any other thread.
  LineReader(LineHistory history, Complete complete);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  bool terminal() const { return terminal_; }
  enum class Event { line, given_up, end };
  // The next line goes into `line`.
  Event read(const std::string& prompt, std::string& line);
  // Why it ended without being asked to; 0, or the number of a signal.
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

// The candidates as lines for a terminal of this width; a few candidates get their descriptions.
std::string candidate_list(const std::vector<lua::Candidate>& candidates, int columns);

}  // namespace asperity::cli
