// SPDX-License-Identifier: GPL-3.0-or-later
// Follows the process of `asperity run --confined`: passes output and signals, draws its charts, and enforces
// limits of time and disk. RunFollower does the same for the page.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "bindings/web/confined/confined_process.hpp"

namespace asperity::web {

struct CommandBounds {
  double seconds = 600;              // wall-clock time
  std::int64_t directory_bytes = 0;  // all files of the run directory
  std::size_t files = 0;             // files and folders
};

class CommandFollower {
 public:
  // Blocks the stop signals in this thread and later threads. Throws Error{bad_state} if the process cannot
  // start.
  CommandFollower(const ConfinedRequest& request, std::filesystem::path directory,
                  const CommandBounds& bounds);
  ~CommandFollower();
  CommandFollower(const CommandFollower&) = delete;
  CommandFollower& operator=(const CommandFollower&) = delete;

  // Returns the exit status after all output is passed on.
  int follow();

 private:
  using Clock = std::chrono::steady_clock;

  void pass_on(int signal);
  void pass_on(Descriptor& from, bool error);
  void pass_on_errors(std::string_view text);
  void watch_limits(Clock::time_point now);
  void end(const std::string& why);

  std::filesystem::path directory_;
  CommandBounds bounds_;
  Descriptor signals_;
  ConfinedProcess process_;
  std::atomic<bool> over_{false};
  std::thread drawer_;
  std::string error_tail_;
  Clock::time_point begun_ = Clock::now(), look_at_{};
  std::optional<Clock::time_point> kill_at_;
  std::string ended_for_;  // reason
};

}  // namespace asperity::web
