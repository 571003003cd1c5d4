// SPDX-License-Identifier: GPL-3.0-or-later
// The parent's side of a confined process (confined.cpp): this program started again, inheriting only its
// pipes.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bindings/web/confined/confined_request.hpp"
#include "bindings/web/sandbox/plain_files.hpp"

namespace asperity::web {

// Dies with its creating thread.
class ConfinedProcess {
 public:
  // Throws Error{bad_state} if the process cannot start.
  ConfinedProcess(const ConfinedRequest& request, const std::string& folder);
  // Kills and waits.
  ~ConfinedProcess();

  Descriptor output, error, events, drawing;  // this side's ends

  void send(int signal) const;
  // waitpid status after the end.
  std::optional<int> ended();
  double processor_seconds() const { return processor_seconds_; }

 private:
  pid_t process_ = -1;
  std::optional<int> status_;
  double processor_seconds_ = 0;
};

struct FollowBounds {
  double seconds = 0;                      // wall-clock time
  double grace = 4;                        // s, for its own limit
  std::chrono::milliseconds to_end{3000};  // from request to kill; 0: at once
  std::chrono::milliseconds pause{50};     // longest, between looks
  std::filesystem::path directory{};       // measured against:
  std::int64_t directory_bytes = 0;        // all files; 0: not measured
  std::size_t files = 0;                   // files and folders
  std::string disk_option{};               // its source: " (--limit-disk)"
};

// Follows a confined process to its end: takes its output, has its charts drawn, and enforces limits of time
// and disk. The process counts as hostile: its gnuplot input runs in another confined process.
class Follower {
 public:
  virtual ~Follower();

 protected:
  using Clock = std::chrono::steady_clock;

  // Throws Error{bad_state} if the process cannot start.
  Follower(const ConfinedRequest& request, const std::string& folder, FollowBounds bounds);

  // Returns the waitpid status after all output is taken.
  int follow();
  // From `output`, `error` or `events` of the process.
  virtual void take(const Descriptor& from, std::string_view piece) = 0;
  // Several times a second.
  virtual void look(Clock::time_point) {}
  void watch_limits(Clock::time_point now);
  // Asks the process to end, later kills it. True for the first reason, which counts.
  bool end(const std::string& why);

  ConfinedProcess process_;
  const FollowBounds bounds_;
  std::vector<pollfd> also_watched_;  // wake look()
  bool discards_ = false;             // output, read rarely against floods
  std::string ended_for_;             // reason

 private:
  std::atomic<bool> over_{false};
  std::thread drawer_;
  Clock::time_point begun_ = Clock::now(), look_at_{};
  std::optional<Clock::time_point> kill_at_;
};

// Why a process died of a signal.
std::string death_text(int signal);

struct Finished {
  int status = -1;                    // exit status; -1 after a signal
  bool late = false;                  // killed at the time limit
  bool given_up = false;              // killed for the caller
  std::string output, error, events;  // each cut at `most_bytes`
};
// Runs a process to its end; kills it at the time limit or when `given_up` (may be empty) returns true.
Finished run_confined(const ConfinedRequest& request, const std::string& folder, double patience,
                      std::size_t most_bytes, const std::function<bool()>& given_up = {});

// This machine's barriers, tested by a confined process that tries every way out.
struct BarrierReport {
  std::vector<std::string> made, missing;  // names as in confine()
  std::vector<Barrier> tried;
  std::string problem;  // why the trial failed
  bool all_hold() const;
  std::string text() const;
};
// About 10 ms. `folder`: must be empty.
BarrierReport try_out_barriers(const std::string& folder);

}  // namespace asperity::web
