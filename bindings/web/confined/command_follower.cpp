// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/command_follower.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

#include "bindings/cli/exit_status.hpp"
#include "bindings/cli/plain_streams.hpp"
#include "bindings/cli/watchdog.hpp"
#include "bindings/web/confined/disk_bound.hpp"
#include "bindings/web/confined/drawing.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

constexpr auto polite_patience = std::chrono::milliseconds(3000);  // after a request to end
constexpr double watch_grace = 4;                                  // seconds for the run's own time limit

// Stop signals and Ctrl-Z.
Descriptor signals_to_pass_on() {
  sigset_t set = cli::stop_signals();
  struct sigaction suspend {};
  if (::sigaction(SIGTSTP, nullptr, &suspend) == 0 && suspend.sa_handler != SIG_IGN) sigaddset(&set, SIGTSTP);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  return Descriptor(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

}  // namespace

CommandFollower::CommandFollower(const ConfinedRequest& request, std::filesystem::path directory,
                                 const CommandBounds& bounds)
    : directory_(std::move(directory)),
      bounds_(bounds),
      signals_(signals_to_pass_on()),
      process_(request, directory_.string()) {
  process_.events.reset();
  drawer_ = std::thread([this, barriers = request.barriers] {
    while (answer_drawing(process_.drawing.get(), barriers, over_)) {
    }
  });
}

CommandFollower::~CommandFollower() {
  process_.send(SIGKILL);
  over_.store(true);
  ::shutdown(process_.drawing.get(), SHUT_RDWR);
  drawer_.join();
}

int CommandFollower::follow() {
  std::signal(SIGPIPE, SIG_IGN);  // the run continues without readers
  std::optional<int> status;
  while (!status) {
    std::array<pollfd, 3> watched{
        {{process_.output.get(), POLLIN, 0}, {process_.error.get(), POLLIN, 0}, {signals_.get(), POLLIN, 0}}};
    ::poll(watched.data(), watched.size(), 50);
    for (signalfd_siginfo met{}; ::read(signals_.get(), &met, sizeof met) == sizeof met;)
      pass_on(static_cast<int>(met.ssi_signo));
    status = process_.ended();
    // The rest of the pipes.
    pass_on(process_.output, false);
    pass_on(process_.error, true);
    if (!status) watch_limits(Clock::now());
  }
  std::fwrite(error_tail_.data(), 1, error_tail_.size(), stderr);
  if (const std::string removed = keep_within(directory_, bounds_.directory_bytes, bounds_.files);
      !removed.empty())
    std::fprintf(stderr, "asperity: %s\n", removed.c_str());
  if (!ended_for_.empty()) {
    std::fprintf(stderr, "asperity: the run was ended: %s\n", ended_for_.c_str());
    return cli::failed;
  }
  if (WIFEXITED(*status)) return WEXITSTATUS(*status);
  const int signal = WTERMSIG(*status);
  if (signal == SIGXCPU || signal == SIGKILL)
    std::fprintf(
        stderr,
        "asperity: the system ended the run: it used more processor time or memory than there is for it\n");
  else
    std::fprintf(stderr, "asperity: the run died of signal %d (%s)\n", signal, ::strsignal(signal));
  return 128 + signal;
}

void CommandFollower::pass_on(int signal) {
  if (signal != SIGTSTP) return process_.send(signal);
  process_.send(SIGSTOP);
  ::raise(SIGSTOP);
  process_.send(SIGCONT);
}

void CommandFollower::pass_on(Descriptor& from, bool error) {
  char piece[65536];
  // Bounded, so that endless output does not prevent the check of limits.
  for (int most = 16; from.get() >= 0 && most > 0; --most) {
    const ssize_t got = ::read(from.get(), piece, sizeof piece);
    if (got == 0) from.reset();
    if (got <= 0) return;
    const std::string_view text(piece, static_cast<std::size_t>(got));
    if (error) {
      pass_on_errors(text);
    } else {
      std::fwrite(text.data(), 1, text.size(), stdout);
      std::fflush(stdout);
    }
  }
}

// Only progress lines may overwrite themselves (plain_streams.hpp).
void CommandFollower::pass_on_errors(std::string_view text) {
  if (::isatty(STDERR_FILENO) == 0) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    return;
  }
  const std::string_view erase = cli::erase_line;
  std::string all = std::exchange(error_tail_, "") + std::string(text);
  std::size_t begin = 0;
  for (std::size_t at; (at = all.find(erase, begin)) != std::string::npos; begin = at + erase.size()) {
    std::fwrite(all.data() + begin, 1, at - begin, stderr);
    cli::erase_shown_line();
  }
  std::size_t end = all.size();
  for (std::size_t k = 1; k < erase.size() && begin + k <= all.size(); ++k)
    if (all.ends_with(erase.substr(0, k)) && process_.error.get() >= 0) end = all.size() - k;
  error_tail_ = all.substr(end);
  std::fwrite(all.data() + begin, 1, end - begin, stderr);
}

void CommandFollower::watch_limits(Clock::time_point now) {
  if (now - begun_ > std::chrono::duration<double>(bounds_.seconds + watch_grace))
    end("the time limit of " + format_quantity(bounds_.seconds, dimension::time) + " was reached");
  if (kill_at_ && now >= *kill_at_) process_.send(SIGKILL);
  if (now < look_at_) return;
  const DiskUse use = disk_use(directory_, bounds_.files);
  look_at_ = next_look(now);
  if (use.files > bounds_.files) end("it wrote more than " + std::to_string(bounds_.files) + " files");
  if (use.bytes > bounds_.directory_bytes)
    end("its files take more than " + format_bytes(bounds_.directory_bytes) + " (--limit-disk)");
  // The run still writes: kill.
  if (use.bytes > bounds_.directory_bytes + bounds_.directory_bytes / 4) process_.send(SIGKILL);
}

void CommandFollower::end(const std::string& why) {
  if (!ended_for_.empty()) return;
  ended_for_ = why;
  process_.send(SIGTERM);
  kill_at_ = Clock::now() + polite_patience;
}

}  // namespace asperity::web
