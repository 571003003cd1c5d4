// SPDX-License-Identifier: GPL-3.0-or-later
// The lines typed at a prompt, kept from session to session in $XDG_STATE_HOME/asperity/history
// (~/.local/state/asperity/history without it), readable by nobody else. A line is added as it is typed, so
// that sessions side by side and one that is killed lose nothing; when a session begins the file is cut to
// the last thousand lines. What cannot be read or written is passed over: a prompt works without it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asperity::cli {

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

}  // namespace asperity::cli
