// SPDX-License-Identifier: GPL-3.0-or-later
// Follows the process of a run: stores output and events, has pictures drawn, enforces limits, and ends the
// process, first by request, then by force.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bindings/web/confined/confined_process.hpp"
#include "bindings/web/runs/page_run.hpp"

namespace asperity::web {

class RunFollower {
 public:
  RunFollower(PageRun& run, const RunLimits& limits, const std::vector<std::string>& barriers);
  ~RunFollower();
  RunFollower(const RunFollower&) = delete;
  RunFollower& operator=(const RunFollower&) = delete;

  // Returns after the end and all output.
  void follow();

  RunState state = RunState::failed;
  int exit = 1;
  std::string reason;
  double processor_seconds() const { return process_.processor_seconds(); }

 private:
  using Clock = std::chrono::steady_clock;

  void take_output(Descriptor& from, std::string& unfinished, const char* stream);
  void take_events();
  void take_event(const std::string& line);
  void watch_limits(Clock::time_point now);
  void end(RunState as, const std::string& why);
  void judge(int status);

  PageRun& run_;
  const RunLimits& limits_;
  std::vector<std::string> barriers_;
  ConfinedProcess process_;
  std::atomic<bool> over_{false};
  std::thread drawer_;
  std::string out_tail_, error_tail_, line_;
  std::int64_t printed_ = 0;
  bool cut_ = false;  // discarding output
  Clock::time_point begun_ = Clock::now(), told_{}, look_at_{};
  std::optional<Clock::time_point> kill_at_;
  std::optional<RunState> ending_;  // by the server
  std::string stopped_, why_;       // reason given by the process
};

}  // namespace asperity::web
