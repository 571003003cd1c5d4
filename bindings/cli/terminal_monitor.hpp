// SPDX-License-Identifier: GPL-3.0-or-later
// Progress and warnings on standard error. After a second, work shows its fraction done and the time left:
// one overwritten line on a terminal, else a line every few seconds.
#pragma once

#include <chrono>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "bindings/lua/registry/value.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {
class RunDirectory;
}

namespace asperity::cli {

// Receives a terminal's content as values, for example for the page. Called by the run's threads; calls of
// one kind never overlap.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  // `done` in [0, 1]; negative `seconds_left`: unknown.
  virtual void progress(std::string_view task, double done, double seconds_left) = 0;
  // After writing the journal line.
  virtual void recorded(std::string_view event, const Json& fields) = 0;
  // Results of a heavy call.
  virtual void found(const std::string& call, const lua::Values& results) = 0;
  // Enables found().
  virtual bool looks_at_results() const { return false; }
  // During a check; the last mistake ended it.
  virtual void mistake(const std::string&) {}
  // After a check, as RunKnobs::json().
  virtual void made_knobs(const Json&) {}
  // `why`: reason of a failure, or "". May be the process's last call.
  virtual void ended(int status, StopReason stopped, const std::string& why) = 0;
};

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
  double quiet() const;  // s, before the first
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

}  // namespace asperity::cli
