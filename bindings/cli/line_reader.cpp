// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/line_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "bindings/cli/watchdog.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/text.hpp"

namespace asperity::cli {

namespace fs = std::filesystem;

namespace {

// One write: lines of sessions must not mix.
void append(const fs::path& file, const std::string& text) {
  const ScopedFile opened(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND, 0600));
  [[maybe_unused]] const auto written = ::write(opened.number, text.data(), text.size());
}

constexpr LoadedPart editor_part{"edit", "lines are edited", "libedit2"};

volatile std::sig_atomic_t interrupted = 0, terminated = 0, suspended = 0, resized = 0;

void note_signal(int signal) {
  (signal == SIGINT     ? interrupted
   : signal == SIGTSTP  ? suspended
   : signal == SIGWINCH ? resized
                        : terminated) = signal;
}

void install(int signal) {
  struct sigaction action {};
  action.sa_handler = note_signal;  // no SA_RESTART: interrupts read
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

sigset_t set_of(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  return set;
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string cut(const std::string& text, std::size_t columns) {
  if (characters_of(text) <= columns) return text;
  std::size_t end = 0, shown = 0;
  while (end < text.size() && shown + 3 < columns) {
    ++end;
    while (end < text.size() && (text[end] & 0xC0) == 0x80) ++end;
    ++shown;
  }
  return text.substr(0, end) + "...";
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

std::string candidate_list(const std::vector<lua::Candidate>& candidates, int columns) {
  constexpr std::size_t few = 24;
  std::size_t width = 0;
  for (const lua::Candidate& c : candidates) width = std::max(width, c.text.size());
  const auto wide = static_cast<std::size_t>(std::max(columns, 20));
  std::string text;
  if (candidates.size() <= few) {
    for (const lua::Candidate& c : candidates) {
      const std::string about = c.detail.empty() ? c.help
                                : c.help.empty() ? c.detail
                                                 : c.help + " (" + c.detail + ")";
      std::string line = "  " + c.text;
      if (!about.empty()) line += std::string(width - c.text.size() + 2, ' ') + about;
      text += cut(line, wide - 1) + "\n";
    }
    return text;
  }
  const std::size_t across = std::max<std::size_t>(1, wide / (width + 2));
  const std::size_t rows = (candidates.size() + across - 1) / across;
  for (std::size_t row = 0; row < rows; ++row) {
    std::string line;
    for (std::size_t k = row; k < candidates.size(); k += rows) {
      const std::string& name = candidates[k].text;
      line += "  " + name + (k + rows < candidates.size() ? std::string(width - name.size(), ' ') : "");
    }
    text += line + "\n";
  }
  return text;
}

LineReader::LineReader(LineHistory history, Complete complete)
    : terminal_(::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0),
      history_(std::move(history)),
      complete_(std::move(complete)) {
  pthread_sigmask(SIG_BLOCK, &stop_signals(), nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (sigismember(&stop_signals(), signal) == 1) install(signal);
  if (!terminal_) return;
  AsperityEditHooks hooks{};
  hooks.context = this;
  hooks.next_byte = [](void* self, unsigned char* byte) {
    return static_cast<LineReader*>(self)->next_byte(byte);
  };
  hooks.complete = [](void* self, const char* line, std::size_t length, std::size_t before) {
    return static_cast<LineReader*>(self)->answer({line, length}, before);
  };
  try {
    editor_ = part_function<decltype(asperity_edit_open)>(editor_part, "asperity_edit_open")(&hooks);
    for (const std::string& line : history_.lines()) remember(line);
  } catch (const Error& error) {
    std::fprintf(stderr, "lines are not edited here: %s\n", error.what());
  }
}

LineReader::~LineReader() {
  if (editor_ != nullptr)
    part_function<decltype(asperity_edit_close)>(editor_part, "asperity_edit_close")(editor_);
}

void LineReader::remember(const std::string& line) {
  if (editor_ == nullptr) return;
  part_function<decltype(asperity_edit_remember)>(editor_part, "asperity_edit_remember")(editor_,
                                                                                         line.c_str());
}

int LineReader::ended_by() const {
  if (terminated != 0) return terminated;
  return interrupted != 0 ? SIGINT : 0;
}

int LineReader::next_byte(unsigned char* byte) {
  install(SIGTSTP);
  install(SIGWINCH);
  sigset_t waiting;
  pthread_sigmask(SIG_SETMASK, nullptr, &waiting);
  for (const int signal : {SIGINT, SIGTERM, SIGTSTP, SIGWINCH}) sigdelset(&waiting, signal);
  if (sigismember(&stop_signals(), SIGHUP) == 1) sigdelset(&waiting, SIGHUP);
  const sigset_t handled = set_of({SIGTSTP, SIGWINCH});
  pthread_sigmask(SIG_BLOCK, &handled, nullptr);
  int result = 1;
  for (;;) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    const int ready = ::ppoll(&input, 1, nullptr, &waiting);
    if (terminated != 0) {
      result = 0;
    } else if (interrupted != 0) {
      interrupted = 0;
      result = -1;
    } else if (suspended != 0) {
      suspended = 0;
      ::raise(SIGSTOP);
      result = -2;
    } else if (resized != 0) {
      resized = 0;
      result = -3;
    } else if (ready > 0) {
      const ssize_t got = ::read(STDIN_FILENO, byte, 1);
      if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      result = got == 1 ? 1 : 0;
    } else if (ready < 0 && errno != EINTR) {
      result = 0;
    } else {
      continue;
    }
    break;
  }
  std::signal(SIGTSTP, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &handled, nullptr);
  return result;
}

LineReader::Event LineReader::read(const std::string& prompt, std::string& line) {
  interrupted = 0;
  std::fflush(stdout);
  if (editor_ == nullptr) return read_plain(prompt, line);
  const char* text = nullptr;
  const int got = part_function<decltype(asperity_edit_read)>(editor_part, "asperity_edit_read")(
      editor_, prompt.c_str(), &text);
  if (got < 0) return Event::given_up;
  if (got == 0) return Event::end;
  line = text;
  if (history_.add(line)) remember(line);
  return Event::line;
}

LineReader::Event LineReader::read_plain(const std::string& prompt, std::string& line) {
  if (terminal_) {
    std::fputs(prompt.c_str(), stdout);
    std::fflush(stdout);
  }
  pthread_sigmask(SIG_UNBLOCK, &stop_signals(), nullptr);
  line.clear();
  int c = EOF;
  // Shares io.read's buffer.
  while (interrupted == 0 && terminated == 0 && (c = std::getc(stdin)) != EOF && c != '\n')
    line += static_cast<char>(c);
  pthread_sigmask(SIG_BLOCK, &stop_signals(), nullptr);
  if (interrupted != 0 && terminal_) {
    std::clearerr(stdin);
    std::puts("");
    return Event::given_up;
  }
  if (interrupted != 0 || terminated != 0 || (c == EOF && line.empty())) return Event::end;
  if (line.ends_with("\r")) line.pop_back();
  return Event::line;
}

AsperityEditAnswer LineReader::answer(std::string_view line, std::size_t before) {
  insert_.clear();
  list_.clear();
  AsperityEditAnswer answer{};
  lua::Completion found;
  try {
    found = complete_(line, before);
  } catch (const std::exception&) {
  }
  const std::vector<lua::Candidate>& all = found.candidates;
  if (!all.empty()) {
    std::string common = all.front().text;
    for (const lua::Candidate& c : all) {
      const auto differs = std::mismatch(common.begin(), common.end(), c.text.begin(), c.text.end()).first;
      common.erase(differs, common.end());
    }
    const std::string_view typed = line.substr(found.from, before - found.from);
    if (all.size() == 1 && all.front().kind == "key") common += "=";
    const bool goes_on = common.size() > typed.size() || (all.size() == 1 && common != typed);
    if (goes_on) {
      answer.take_away = characters_of(typed);
      insert_ = common;
    } else if (all.size() > 1) {
      list_ = candidate_list(all, terminal_columns());
    }
  }
  answer.insert = insert_.c_str();
  answer.list = list_.c_str();
  return answer;
}

}  // namespace asperity::cli
