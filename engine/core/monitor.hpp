// SPDX-License-Identifier: GPL-3.0-or-later
// Progress, warnings and stop requests. progress and warn are called from the calling thread only. The engine
// never prints.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.hpp"

namespace asperity {

class ResultStore;

enum class StopReason : int { none = 0, interrupt, time_limit, memory_limit };

// Lock-free and async-signal-safe.
class StopFlag {
 public:
  void raise(StopReason reason) noexcept {
    int expected = 0;
    reason_.compare_exchange_strong(expected, static_cast<int>(reason));
  }
  void clear() noexcept { reason_.store(0); }
  StopReason reason() const noexcept {
    return static_cast<StopReason>(reason_.load(std::memory_order_relaxed));
  }
  // Throws Error{interrupted | time_limit | out_of_memory} if raised.
  void check() const;

 private:
  std::atomic<int> reason_{0};
};

StopFlag& stop_flag();

class Monitor {
 public:
  virtual ~Monitor() = default;
  // `done` in [0, 1].
  virtual void progress(std::string_view /*what*/, double /*done*/) {}
  // `seconds`: time since the start of the whole. Default: calls progress().
  virtual void progress_of_parts(std::string_view what, double done, std::string_view /*part*/,
                                 double /*seconds*/) {
    progress(what, done);
  }
  // For the experimenter: shown once, recorded in the journal.
  virtual void warn(std::string_view /*sentence*/) {}
  // Other information, such as the expected time.
  virtual void inform(std::string_view /*sentence*/) {}
  // May be null. Thread-safe.
  virtual ResultStore* results() { return nullptr; }

  // Discards everything.
  static Monitor& silent();
};

// Replaces numbers and units, except in names and quoted texts; equal results mean one kind.
std::string kind_of_warning(std::string_view sentence);

class WarningKinds {
 public:
  bool is_first(std::string_view sentence);
  // One line per repeated kind. Resets the counts.
  std::vector<std::string> rest();

 private:
  struct Kind {
    std::string first;
    std::size_t more = 0;
  };
  std::map<std::string, Kind> kinds_;
};

// Work of `total` steps. advance() checks for a stop and reports at most ten times per second, cheap enough
// for microsecond loops.
class Task {
 public:
  Task(Monitor& monitor, std::string_view what, std::int64_t total);
  void advance(std::int64_t steps = 1);

 private:
  Monitor& monitor_;
  std::string_view what_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  std::int64_t next_look_ = 0;
  double last_report_;
};

// Monitor of one part of longer work. Progress of the part, possibly repeated, becomes a non-decreasing
// share.
class PartMonitor final : public Monitor {
 public:
  using Clock = std::chrono::steady_clock;

  // The part, begun at `begun`, takes the whole from `before` to `after` in [0, 1]. `outer` must outlive the
  // monitor.
  PartMonitor(Monitor& outer, std::string whole, std::string part, double before, double after,
              Clock::time_point begun);

  void begin() { progress({}, 0); }
  void progress(std::string_view what, double done) override;
  void warn(std::string_view sentence) override { outer_.warn(sentence); }
  void inform(std::string_view sentence) override { outer_.inform(sentence); }
  ResultStore* results() override { return results_; }
  // For timed parts: ignores stored results.
  void compute_afresh() { results_ = nullptr; }

 private:
  Monitor& outer_;
  std::string whole_, part_;
  double before_, after_;
  Clock::time_point begun_;
  ResultStore* results_;
  double furthest_ = 0;
};

}  // namespace asperity
