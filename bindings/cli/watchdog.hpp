// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C and limits. A thread of its own takes SIGINT, SIGTERM and SIGHUP and watches the clock. It asks
// first: it raises the stop flag, which native work polls, and sets a hook, which Lua code runs into.
// Work that does neither (a pattern that backtracks for ever) is ended after a grace period: the
// journal and the notebooks are made safe and the process exits. A second Ctrl-C does not wait. At a prompt
// Ctrl-C waits: what it stops may take its time, and only a second one after the grace period ends all.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::cli {

class Watchdog {
 public:
  // Blocks the signals in the calling thread and those it starts: construct it before any other
  // thread. `last_words` is called from the watchdog's thread before the process is ended.
  enum class CtrlC { ends_within_grace, waits };
  Watchdog(std::optional<double> limit_seconds, std::function<void(StopReason)> last_words,
           CtrlC ctrl_c = CtrlC::ends_within_grace);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // Whether SIGTERM or SIGHUP came: it ends the whole program, not only the current work.
  bool terminated() const { return terminated_.load(); }

  // While it lives, stops reach this Lua state; it must go before the state is closed.
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
  void guard(std::optional<double> limit_seconds);
  void ask(StopReason reason);

  std::function<void(StopReason)> last_words_;
  CtrlC ctrl_c_;
  std::mutex mutex_;  // of state_: it may not be closed between being read and being interrupted
  lua_State* state_ = nullptr;
  std::atomic<bool> done_{false}, terminated_{false};
  std::thread thread_;
};

// What ends a run in order: SIGINT and SIGTERM, and SIGHUP unless the program was started to ignore it
// (nohup). Asked for the first time before any handler is set.
const sigset_t& stop_signals();

// The exit status of a run that was stopped for this reason: for a signal 128 and its number, as shells have
// it (130 Ctrl-C, 143 SIGTERM, 129 SIGHUP).
int exit_status(StopReason reason);

}  // namespace asperity::cli
