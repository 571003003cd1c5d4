// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/monitor.hpp"

#include <algorithm>
#include <chrono>

namespace asperity {

namespace {
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class SilentMonitor final : public Monitor {
 public:
  void progress(std::string_view, double) override {}
  void warn(std::string_view) override {}
};
}  // namespace

void StopFlag::check() const {
  switch (reason()) {
    case StopReason::none:
      return;
    case StopReason::interrupt:
      throw Error(ErrorCode::interrupted, "interrupted");
    case StopReason::time_limit:
      throw Error(ErrorCode::time_limit, "the time limit of the run is reached");
    case StopReason::memory_limit:
      throw Error(ErrorCode::out_of_memory, "the memory limit of the run is reached");
  }
}

StopFlag& stop_flag() {
  static StopFlag flag;
  return flag;
}

Monitor& Monitor::silent() {
  static SilentMonitor monitor;
  return monitor;
}

Task::Task(Monitor& monitor, std::string_view what, std::int64_t total)
    : monitor_(monitor), what_(what), total_(std::max<std::int64_t>(total, 1)), last_report_(now()) {
  stop_flag().check();
}

void Task::advance(std::int64_t steps) {
  stop_flag().check();
  done_ += steps;
  if (done_ < next_look_) return;
  next_look_ = done_ + std::max<std::int64_t>(total_ / 1000, 1);
  constexpr double report_every = 0.1;  // seconds
  const double time = now();
  if (time - last_report_ < report_every) return;
  last_report_ = time;
  monitor_.progress(what_, static_cast<double>(std::min(done_, total_)) / static_cast<double>(total_));
}

}  // namespace asperity
