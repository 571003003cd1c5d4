// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/run_follower.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>

#include "bindings/web/confined/disk_bound.hpp"
#include "bindings/web/confined/drawing.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

constexpr auto tell_every = std::chrono::milliseconds(300);
constexpr auto follower_patience = std::chrono::milliseconds(3000);  // after a request to end
constexpr double grace_seconds = 4;                                  // for the run's own time limit
constexpr std::size_t longest_event = std::size_t{1} << 20;

std::string mebibytes(std::int64_t bytes) {
  return format_short(static_cast<double>(bytes) / 0x1p20) + " MiB";
}

ConfinedRequest request_of(const PageRun& run, const RunLimits& limits,
                           const std::vector<std::string>& barriers) {
  ConfinedRequest request{.work = Work::run, .confinement = {}};
  request.confinement.memory_bytes = limits.memory_bytes;
  request.confinement.file_bytes = limits.directory_bytes;
  request.confinement.processor_seconds =
      static_cast<std::int64_t>(limits.seconds + grace_seconds) * std::max(1, limits.threads) + 1;
  request.script = run.request.script;
  request.name = "script.lua";
  request.seed = run.request.seed;
  request.seconds = limits.seconds;
  request.threads = limits.threads;
  request.views = run.request.views;
  request.knobs = run.request.knobs;
  request.barriers = barriers;
  return request;
}

}  // namespace

RunFollower::RunFollower(PageRun& run, const RunLimits& limits, const std::vector<std::string>& barriers)
    : run_(run),
      limits_(limits),
      barriers_(barriers),
      process_(request_of(run, limits, barriers), run.directory.string()) {
  drawer_ = std::thread([this] {
    while (answer_drawing(process_.drawing.get(), barriers_, over_)) {
    }
  });
}

RunFollower::~RunFollower() {
  process_.send(SIGKILL);
  over_.store(true);
  ::shutdown(process_.drawing.get(), SHUT_RDWR);
  drawer_.join();
}

void RunFollower::follow() {
  for (;;) {
    // Discarded output is read at intervals: a flood costs little.
    std::array<pollfd, 3> watched{{{cut_ ? -1 : process_.output.get(), POLLIN, 0},
                                   {cut_ ? -1 : process_.error.get(), POLLIN, 0},
                                   {process_.events.get(), POLLIN, 0}}};
    ::poll(watched.data(), watched.size(), cut_ ? 5 : 50);
    take_output(process_.output, out_tail_, "out");
    take_output(process_.error, error_tail_, "err");
    take_events();
    const auto status = process_.ended();
    watch_limits(Clock::now());
    if (!status) continue;
    // The rest of the pipes.
    take_output(process_.output, out_tail_, "out");
    take_output(process_.error, error_tail_, "err");
    take_events();
    judge(*status);
    return;
  }
}

void RunFollower::take_output(Descriptor& from, std::string& unfinished, const char* stream) {
  char piece[65536];
  // Bounded, so that endless output does not prevent the check of limits.
  for (int most = 16; from.get() >= 0 && most > 0; --most) {
    const ssize_t got = ::read(from.get(), piece, sizeof piece);
    if (got == 0) from.reset();
    if (got <= 0) return;
    if (printed_ >= limits_.output_bytes) continue;  // discarded, so that the run can end
    printed_ += got;
    std::string text = std::move(unfinished);
    text.append(piece, static_cast<std::size_t>(got));
    const std::size_t whole = text.size() - unfinished_bytes(text);
    unfinished = text.substr(whole);
    text.resize(whole);
    if (!text.empty()) run_.events.add("output", Json::object({{"stream", stream}, {"text", text}}));
    if (printed_ >= limits_.output_bytes && !cut_) {
      cut_ = true;
      run_.events.add("output",
                      Json::object({{"stream", "err"},
                                    {"text", "\nit printed more than " + mebibytes(limits_.output_bytes) +
                                                 ": the rest is not shown\n"}}));
    }
    if (static_cast<std::size_t>(got) < sizeof piece) return;
  }
}

void RunFollower::take_events() {
  char piece[65536];
  while (process_.events.get() >= 0) {
    const ssize_t got = ::read(process_.events.get(), piece, sizeof piece);
    if (got == 0) process_.events.reset();
    if (got <= 0) return;
    line_.append(piece, static_cast<std::size_t>(got));
    std::size_t begin = 0;
    for (std::size_t end; (end = line_.find('\n', begin)) != std::string::npos; begin = end + 1)
      take_event(line_.substr(begin, end - begin));
    line_.erase(0, begin);
    if (line_.size() > longest_event) {
      line_.clear();
      end(RunState::limit, "one of its rows is longer than " + mebibytes(longest_event));
    }
    if (run_.events.bytes() > limits_.event_bytes) {
      end(RunState::limit, "its rows take more than " + mebibytes(limits_.event_bytes));
      process_.events.reset();
    }
  }
}

void RunFollower::take_event(const std::string& line) {
  constexpr std::array<std::string_view, 6> told{"progress",       "row",         "view",
                                                 "views_left_out", "expectation", "error"};
  try {
    const Json event = Json::parse(line, "an event");
    const Json* type = event.is_object() ? event.find("type") : nullptr;
    if (type == nullptr) return;
    if (type->string() == "ended") {
      if (const Json* stopped = event.find("stopped")) stopped_ = stopped->string();
      if (const Json* why = event.find("why")) why_ = why->string().substr(0, 2000);
    } else if (std::ranges::find(told, type->string()) != told.end()) {
      run_.events.add(type->string(), event);
    }
  } catch (const Error&) {
  }
}

void RunFollower::watch_limits(Clock::time_point now) {
  if (run_.stop_asked()) end(RunState::stopped, "it was stopped");
  if (now - begun_ > std::chrono::duration<double>(limits_.seconds + grace_seconds))
    end(RunState::limit,
        "the time limit of " + format_quantity(limits_.seconds, dimension::time) + " was reached");
  if (kill_at_ && now >= *kill_at_) process_.send(SIGKILL);
  if (now - told_ >= tell_every) {
    told_ = now;
    run_.tell_files(false);
  }
  if (now < look_at_) return;
  const DiskUse use = disk_use(run_.directory, limits_.files);
  look_at_ = next_look(now);
  if (use.files > limits_.files)
    end(RunState::limit, "it wrote more than " + std::to_string(limits_.files) + " files");
  if (use.bytes > limits_.directory_bytes)
    end(RunState::limit, "its files take more than " + mebibytes(limits_.directory_bytes));
  // The run still writes: kill.
  if (use.bytes > limits_.directory_bytes + limits_.directory_bytes / 4 || use.files > 2 * limits_.files)
    process_.send(SIGKILL);
}

void RunFollower::end(RunState as, const std::string& why) {
  if (ending_) return;
  ending_ = as;
  reason = why;
  process_.send(SIGTERM);
  kill_at_ = Clock::now() + follower_patience;
}

void RunFollower::judge(int status) {
  exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (ending_) {
    state = *ending_;
  } else if (stopped_ == "time" || stopped_ == "memory") {
    state = RunState::limit;
    reason = why_;
  } else if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    state = signal == SIGXCPU || signal == SIGKILL ? RunState::limit : RunState::failed;
    reason = signal == SIGXCPU || signal == SIGKILL
                 ? "the system ended it: it used more processor time or memory than there is for it"
                 : std::string("it died of ") + ::strsignal(signal);
  } else {
    state = exit == 0 ? RunState::done : RunState::failed;
    reason = why_;
  }
}

}  // namespace asperity::web
