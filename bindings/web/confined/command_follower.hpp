// SPDX-License-Identifier: GPL-3.0-or-later
// Follows the process of `asperity run --confined`: what it prints goes on to the terminal, signals go on to
// it, its pictures are drawn, and time and disk are watched, as RunFollower does it for the page.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "bindings/web/sandbox/confined_process.hpp"

namespace asperity::web {

struct CommandBounds {
  double seconds = 600;              // on the clock
  std::int64_t directory_bytes = 0;  // of all files of the run directory together
  std::size_t files = 0;             // and folders
};

class CommandFollower {
 public:
  // Takes the signals that end a program from this thread and those it starts. Throws Error{bad_state} where
  // the process cannot be started.
  CommandFollower(const ConfinedRequest& request, std::filesystem::path directory,
                  const CommandBounds& bounds);
  ~CommandFollower();
  CommandFollower(const CommandFollower&) = delete;
  CommandFollower& operator=(const CommandFollower&) = delete;

  // Until the process has ended and all it said has been passed on. The exit status.
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
  std::string ended_for_;  // why it was ended from here
};

}  // namespace asperity::web
