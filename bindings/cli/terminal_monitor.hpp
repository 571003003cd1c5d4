// SPDX-License-Identifier: GPL-3.0-or-later
// Progress and warnings on standard error. After a second, work shows its fraction done and the time left:
// one overwritten line on a terminal, else a line every few seconds.
#pragma once

#include <chrono>
#include <mutex>
#include <set>
#include <string>

#include "engine/core/monitor.hpp"

namespace asperity {
class RunDirectory;
}

namespace asperity::cli {

class RunObserver;

class TerminalMonitor final : public Monitor {
 public:
  TerminalMonitor();
  ~TerminalMonitor() override;
  // Also to this run's journal.
  void keep_warnings_in(RunDirectory* run) { run_ = run; }
  // For a pipe that ends at a terminal.
  void show_as_on_terminal() { terminal_ = true; }
  // Progress only.
  void report_to(RunObserver* observer) { observer_ = observer; }
  // For heavy calls.
  void keep_results_in(ResultStore* results) { results_ = results; }

  void progress(std::string_view what, double done) override;
  void progress_of_parts(std::string_view what, double done, std::string_view part, double seconds) override;
  void warn(std::string_view sentence) override;
  void inform(std::string_view sentence) override;
  ResultStore* results() override { return results_; }
  // From now on, warnings that differ only in numbers are shown once, and counted by tell_alike(). The
  // journal has all.
  void count_alike() { count_alike_ = true; }
  void tell_alike();
  // Erases the progress line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  double pause() const;  // s, between lines
  double quiet() const;  // s, before the first line
  void show(const std::string& title, double done, double seconds);
  void clear_line();

  std::mutex mutex_;
  RunDirectory* run_ = nullptr;
  ResultStore* results_ = nullptr;
  RunObserver* observer_ = nullptr;
  bool terminal_;
  bool line_shown_ = false;
  std::string current_;
  Clock::time_point started_{}, shown_{};
  Clock::time_point parts_shown_{};  // own clock for parts
  double last_done_ = 0;
  std::set<std::string> warned_;
  bool count_alike_ = false;
  WarningKinds kinds_;
};

std::string duration_text(double seconds);

}  // namespace asperity::cli
