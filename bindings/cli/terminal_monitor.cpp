// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/terminal_monitor.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "bindings/cli/plain_streams.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::cli {

namespace {
constexpr double quiet_seconds = 1.0;   // shorter work shows nothing
constexpr double redraw_seconds = 0.2;  // on a terminal
constexpr double relist_seconds = 5.0;  // elsewhere

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::fmin(seconds, 1e9)));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace

TerminalMonitor::TerminalMonitor() : terminal_(isatty(STDERR_FILENO) != 0) {}
TerminalMonitor::~TerminalMonitor() {
  tell_alike();
  clear();
}

void TerminalMonitor::progress(std::string_view what, double fraction) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (what != current_ || fraction < last_done_) {
    current_ = what;
    started_ = now;
    shown_ = now - std::chrono::hours(1);
  }
  last_done_ = fraction;
  const double elapsed = std::chrono::duration<double>(now - started_).count();
  if (elapsed < quiet() || std::chrono::duration<double>(now - shown_).count() < pause()) return;
  shown_ = now;
  show(current_, fraction, elapsed);
}

void TerminalMonitor::progress_of_parts(std::string_view what, double fraction, std::string_view part,
                                        double seconds) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  current_.clear();
  if (seconds < quiet() || std::chrono::duration<double>(now - parts_shown_).count() < pause()) return;
  parts_shown_ = now;
  show(std::string(what) + ", " + std::string(part), fraction, seconds);
}

double TerminalMonitor::pause() const {
  return observer_ != nullptr ? redraw_seconds : terminal_ ? redraw_seconds : relist_seconds;
}

double TerminalMonitor::quiet() const { return observer_ != nullptr ? redraw_seconds : quiet_seconds; }

void TerminalMonitor::show(const std::string& title, double fraction, double seconds) {
  if (observer_ != nullptr)
    return observer_->progress(title, fraction, fraction > 0 ? seconds / fraction * (1 - fraction) : -1);
  const std::string left =
      fraction > 0 ? ", about " + duration_text(seconds / fraction * (1 - fraction)) + " left" : "";
  char percent[16];
  std::snprintf(percent, sizeof percent, "%.0f %%", 100 * fraction);
  const std::string line = title + ": " + percent + left;
  if (terminal_) {
    erase_shown_line();
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
    line_shown_ = true;
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

void TerminalMonitor::warn(std::string_view sentence) {
  const std::lock_guard lock(mutex_);
  if (!warned_.emplace(sentence).second) return;
  clear_line();
  if (!count_alike_ || kinds_.is_first(sentence))
    std::fprintf(stderr, "warning: %.*s\n", static_cast<int>(sentence.size()), sentence.data());
  if (run_ != nullptr) run_->journal().write("warning", Json::object({{"sentence", sentence}}));
}

void TerminalMonitor::tell_alike() {
  const std::lock_guard lock(mutex_);
  for (const std::string& line : kinds_.rest()) {
    clear_line();
    std::fprintf(stderr, "warning: %s\n", line.c_str());
  }
}

void TerminalMonitor::inform(std::string_view sentence) {
  const std::lock_guard lock(mutex_);
  clear_line();
  std::fprintf(stderr, "%.*s\n", static_cast<int>(sentence.size()), sentence.data());
}

void TerminalMonitor::clear() {
  const std::lock_guard lock(mutex_);
  clear_line();
}

void TerminalMonitor::clear_line() {
  if (!line_shown_) return;
  erase_shown_line();
  line_shown_ = false;
}

}  // namespace asperity::cli
