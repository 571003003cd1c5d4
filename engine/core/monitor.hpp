// SPDX-License-Identifier: GPL-3.0-or-later
// How long work talks to the outside: it reports progress, gives warnings, and asks whether it
// should stop. The engine never prints; whoever runs it decides what becomes of the messages.
// stop_requested may be called from any thread; progress and warn from the calling thread only.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.hpp"

namespace asperity {

class ResultStore;

// Why a run should stop, raised from signal handlers and watchdogs.
enum class StopReason : int { none = 0, interrupt, time_limit, memory_limit };

// One flag for the process. Lock-free and async-signal-safe.
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
  // Throws Error{interrupted | time_limit | out_of_memory} when raised.
  void check() const;

 private:
  std::atomic<int> reason_{0};
};

StopFlag& stop_flag();

class Monitor {
 public:
  virtual ~Monitor() = default;
  // `done` in [0, 1] of the work called `what`.
  virtual void progress(std::string_view what, double done) = 0;
  // The same of long work made of parts: `part` is the one under way, and `seconds` how long the whole has
  // been going on, other work between the parts included. Shown like any progress unless overridden.
  virtual void progress_of_parts(std::string_view what, double done, std::string_view /*part*/,
                                 double /*seconds*/) {
    progress(what, done);
  }
  // A sentence the experimenter should see; shown once, kept in the journal.
  virtual void warn(std::string_view sentence) = 0;
  // Any other sentence, such as the expected time of the next work. Dropped unless overridden.
  virtual void inform(std::string_view /*sentence*/) {}
  // The store for results of heavy calls (result_store.hpp); null unless overridden. From any thread.
  virtual ResultStore* results() { return nullptr; }

  // Neither shows nor keeps anything.
  static Monitor& silent();
};

// The sentence without its numbers and their units; numbers in names and quoted texts stay. Equal results are
// warnings of the same kind.
std::string kind_of_warning(std::string_view sentence);

// Counts the warnings of each kind.
class WarningKinds {
 public:
  // Whether this warning is the first of the same kind.
  bool is_first(std::string_view sentence);
  // A line for each kind with further warnings. The counts begin again at zero.
  std::vector<std::string> rest();

 private:
  struct Kind {
    std::string first;
    std::size_t more = 0;
  };
  std::map<std::string, Kind> kinds_;
};

// One piece of work of `total` steps. advance() checks for a stop and reports at most ten times a
// second, so it may stand in a loop whose turns take microseconds.
class Task {
 public:
  Task(Monitor& monitor, std::string_view what, std::int64_t total);
  // Throws Error when a stop was asked for.
  void advance(std::int64_t steps = 1);

 private:
  Monitor& monitor_;
  std::string_view what_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  std::int64_t next_look_ = 0;
  double last_report_;
};

}  // namespace asperity
