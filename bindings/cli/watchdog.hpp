// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C and limits. A thread receives SIGINT, SIGTERM and SIGHUP and watches the clock. A stop raises the
// stop flag for native work and sets a hook for Lua code. Work that reacts to neither (endless pattern
// backtracking) is ended after a grace period: journal and notebooks are made safe, and the process exits. A
// second Ctrl-C ends the process at once; at a prompt, only after the grace period.
#pragma once

#include <atomic>
#include <csignal>
#include <ctime>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::cli {

class Watchdog {
 public:
  // Blocks the signals in this and later threads: construct first. The watchdog's thread calls `last_words`
  // before the process ends.
#if defined(__EMSCRIPTEN__)
  static constexpr bool has_clock = false;  // without threads a limit of time is refused
#else
  static constexpr bool has_clock = true;
#endif
  enum class CtrlC { ends_within_grace, waits };
  Watchdog(std::optional<double> limit_seconds, std::function<void(StopReason)> last_words,
           CtrlC ctrl_c = CtrlC::ends_within_grace);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // After SIGTERM or SIGHUP, which end the whole program.
  bool terminated() const { return terminated_.load(); }

  // Stops reach this state; destroy before closing the state.
  class Watching {
   public:
    Watching(Watchdog& watchdog, lua_State* L) : watchdog_(watchdog) { watchdog_.watch(L); }
    ~Watching() { watchdog_.watch(nullptr); }
    Watching(const Watching&) = delete;
    Watching& operator=(const Watching&) = delete;

   private:
    Watchdog& watchdog_;
  };

 private:
  void watch(lua_State* L);
  void guard(std::optional<double> limit_seconds, clockid_t watched);
  void ask(StopReason reason);

  std::function<void(StopReason)> last_words_;
  CtrlC ctrl_c_;
  std::mutex mutex_;  // state_ must stay open for interrupt
  lua_State* state_ = nullptr;
  std::atomic<bool> done_{false}, terminated_{false};
  std::thread thread_;
};

// SIGINT, SIGTERM, and SIGHUP unless ignored at start (nohup). Call before setting handlers.
const sigset_t& stop_signals();

// 128 plus the signal: 130 Ctrl-C, 143 SIGTERM, 129 SIGHUP.
int exit_status(StopReason reason);

}  // namespace asperity::cli
