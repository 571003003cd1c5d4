// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/watchdog.hpp"

#include <cstdio>
#include <cstdlib>

#include "bindings/lua/runtime/state.hpp"

namespace asperity::cli {

namespace {
using Clock = std::chrono::steady_clock;
// Grace counts processor time of the watched thread: a busy machine does not shorten it.
constexpr auto grace = std::chrono::milliseconds(2000), longest_wait = 5 * grace;
constexpr auto look_every = std::chrono::milliseconds(50);

std::atomic<int> met_signal{0};

std::chrono::nanoseconds used_by(clockid_t thread) {
  timespec used{};
  ::clock_gettime(thread, &used);
  return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}
}  // namespace

const sigset_t& stop_signals() {
  static const sigset_t signals = [] {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    // For nohup: blocked signals arrive even if ignored.
    struct sigaction hang_up {};
    if (::sigaction(SIGHUP, nullptr, &hang_up) != 0 || hang_up.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
    return set;
  }();
  return signals;
}

int exit_status(StopReason reason) {
  if (reason != StopReason::interrupt) return 1;
  const int signal = met_signal.load();
  return 128 + (signal == 0 ? SIGINT : signal);
}

Watchdog::Watchdog(std::optional<double> limit_seconds, std::function<void(StopReason)> last_words,
                   CtrlC ctrl_c)
    : last_words_(std::move(last_words)), ctrl_c_(ctrl_c) {
  met_signal.store(0);
  pthread_sigmask(SIG_BLOCK, &stop_signals(), nullptr);
  clockid_t watched = CLOCK_PROCESS_CPUTIME_ID;
  pthread_getcpuclockid(pthread_self(), &watched);
  thread_ = std::thread([this, limit_seconds, watched] { guard(limit_seconds, watched); });
}

Watchdog::~Watchdog() {
  done_.store(true);
  pthread_kill(thread_.native_handle(), SIGTERM);
  thread_.join();
}

void Watchdog::watch(lua_State* L) {
  const std::lock_guard lock(mutex_);
  state_ = L;
}

void Watchdog::ask(StopReason reason) {
  stop_flag().raise(reason);
  const std::lock_guard lock(mutex_);
  if (state_ != nullptr) lua::interrupt(state_);
}

void Watchdog::guard(std::optional<double> limit_seconds, clockid_t watched) {
  const auto start = Clock::now();
  std::optional<Clock::time_point> asked;
  std::chrono::nanoseconds used_before{};
  const auto waited = [&] {
    return asked && (used_by(watched) - used_before >= grace || Clock::now() - *asked >= longest_wait);
  };
  for (;;) {
    auto wait = std::chrono::duration<double>(3600);
    if (limit_seconds && !asked)
      wait = std::min(wait, std::chrono::duration<double>(start - Clock::now()) +
                                std::chrono::duration<double>(*limit_seconds));
    if (asked) wait = std::min<std::chrono::duration<double>>(wait, look_every);
    const double seconds = std::max(wait.count(), 0.0);
    timespec timeout{};
    timeout.tv_sec = static_cast<time_t>(seconds);
    timeout.tv_nsec = static_cast<long>((seconds - static_cast<double>(timeout.tv_sec)) * 1e9);
    const int signal = sigtimedwait(&stop_signals(), nullptr, &timeout);
    if (done_.load()) return;

    bool end_now = false;
    if (signal > 0) {
      int none = 0;
      met_signal.compare_exchange_strong(none, signal);
      end_now = asked && (ctrl_c_ != CtrlC::waits || signal != SIGINT || waited());
      if (signal != SIGINT) terminated_.store(true);
      ask(StopReason::interrupt);
    } else if (limit_seconds && !asked &&
               std::chrono::duration<double>(Clock::now() - start).count() >= *limit_seconds) {
      ask(StopReason::time_limit);
    }
    if (stop_flag().reason() != StopReason::none && !asked) {
      asked = Clock::now();
      used_before = used_by(watched);
    }
    const bool waits = ctrl_c_ == CtrlC::waits && stop_flag().reason() == StopReason::interrupt;
    if (end_now || (!waits && waited())) {
      const StopReason reason = stop_flag().reason();
      last_words_(reason);
      std::fflush(stdout);
      std::_Exit(exit_status(reason));
    }
  }
}

}  // namespace asperity::cli
