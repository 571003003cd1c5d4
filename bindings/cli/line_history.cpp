// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/line_history.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/text.hpp"

namespace asperity::cli {

namespace fs = std::filesystem;

namespace {

// In one piece, so that lines of two sessions do not mix.
void append(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND, 0600);
  if (descriptor < 0) return;
  [[maybe_unused]] const auto written = ::write(descriptor, text.data(), text.size());
  ::close(descriptor);
}

}  // namespace

fs::path LineHistory::default_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && state[0] == '/') return fs::path(state) / "asperity" / "history";
  const char* home = std::getenv("HOME");
  if (home == nullptr || home[0] != '/') return {};
  return fs::path(home) / ".local" / "state" / "asperity" / "history";
}

LineHistory::LineHistory(fs::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  std::ifstream kept(file_, std::ios::binary);
  for (std::string line; std::getline(kept, line);)
    if (!line.empty()) lines_.push_back(plain_text(line));
  if (lines_.size() <= most_lines) return;
  lines_.erase(lines_.begin(), lines_.end() - static_cast<std::ptrdiff_t>(most_lines));
  std::string whole;
  for (const std::string& line : lines_) whole += line + "\n";
  try {
    write_atomically(file_, whole, Durable::no, 0600);
  } catch (const Error&) {
    // the file stays as long as it is
  }
}

bool LineHistory::add(const std::string& line) {
  const bool blank = line.find_first_not_of(" \t") == std::string::npos;
  if (blank || line.front() == ' ' || (!lines_.empty() && lines_.back() == line)) return false;
  lines_.push_back(line);
  if (file_.empty()) return true;
  std::error_code ignored;
  fs::create_directories(file_.parent_path(), ignored);
  append(file_, line + "\n");
  return true;
}

}  // namespace asperity::cli
