// SPDX-License-Identifier: GPL-3.0-or-later
// Progress and warnings on standard error. Work that takes over a second shows its share done and an
// estimate of the time left: one line that is written over on a terminal, a line every few seconds
// elsewhere. Standard output is never touched.
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
  // Warnings also go to this run's journal.
  void keep_warnings_in(RunDirectory* run) { run_ = run; }
  // Standard error is a pipe to somebody who shows it on a terminal.
  void show_as_on_terminal() { terminal_ = true; }
  // Progress goes there instead.
  void report_to(RunObserver* observer) { observer_ = observer; }
  // Heavy calls take their results from here and keep them here.
  void keep_results_in(ResultStore* results) { results_ = results; }

  void progress(std::string_view what, double done) override;
  void progress_of_parts(std::string_view what, double done, std::string_view part, double seconds) override;
  void warn(std::string_view sentence) override;
  void inform(std::string_view sentence) override;
  ResultStore* results() override { return results_; }
  // From now on, warnings with equal text except for numbers are shown once; tell_alike() counts the others.
  // The journal holds all of them.
  void count_alike() { count_alike_ = true; }
  void tell_alike();
  // Takes the progress line away.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  double pause() const;  // seconds between two lines
  double quiet() const;  // work shorter than this shows nothing
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
  Clock::time_point parts_shown_{};  // other work between the parts shows itself at its own times
  double last_done_ = 0;
  std::set<std::string> warned_;
  bool count_alike_ = false;
  WarningKinds kinds_;
};

// "42 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace asperity::cli
