// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/confined_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "bindings/cli/disk_bound.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/plot/gnuplot.hpp"

namespace asperity::web {

namespace {

constexpr double drawing_seconds = 30;

struct Ends {
  Descriptor here, there;
};

[[noreturn]] void throw_not_started(int reason) {
  refuse_state(std::string("a run cannot be started: ") + std::strerror(reason));
}

// Above 16: dup2 in the child cannot overwrite it.
Descriptor copied_up(int descriptor) {
  const int high = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 16);
  if (high < 0) throw_not_started(errno);
  return Descriptor(high);
}

Descriptor moved_up(int descriptor) {
  if (descriptor < 0) throw_not_started(errno);
  const Descriptor low(descriptor);
  return copied_up(descriptor);
}

Ends pipe_from_child() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw_not_started(errno);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return {Descriptor(ends[0]), moved_up(ends[1])};
}

Ends socket_to_child() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw_not_started(errno);
  // Bounds the time blocked in sending.
  const timeval patience{20, 0};
  for (const int end : ends) ::setsockopt(end, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  return {Descriptor(ends[0]), moved_up(ends[1])};
}

// In memory: neither side waits.
Descriptor content(const std::string& text) {
  Descriptor file = moved_up(::memfd_create("request", MFD_CLOEXEC));
  if (const int reason = write_all(file.get(), text); reason != 0) throw_not_started(reason);
  ::lseek(file.get(), 0, SEEK_SET);
  return file;
}

// The child's descriptors 0, 1, 2, …
pid_t start(const std::vector<int>& descriptors, const std::string& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  for (std::size_t k = 0; k < descriptors.size(); ++k)
    posix_spawn_file_actions_adddup2(&actions, descriptors[k], static_cast<int>(k));
  posix_spawn_file_actions_addclosefrom_np(&actions, static_cast<int>(descriptors.size()));
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  // New session: Ctrl-C reaches only the server.
  sigset_t every, none;
  sigfillset(&every);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes, &every);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  char name[] = "asperity", confined[] = "--confined", language[] = "LC_ALL=C.UTF-8",
       path[] = "PATH=/usr/bin:/bin";
  char* const arguments[] = {name, confined, nullptr};
  char* const environment[] = {language, path, nullptr};
  pid_t child = -1;
  const int reason = ::posix_spawn(&child, "/proc/self/exe", &actions, &attributes, arguments, environment);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (reason != 0) throw_not_started(reason);
  return child;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() < 64 && name[0] != '.' && name != "script" && name != "picture" &&
         std::ranges::all_of(
             name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; });
}

GnuplotResult draw(const std::vector<std::string>& request, const std::vector<std::string>& barriers,
                   const std::atomic<bool>& given_up) {
  const TemporaryFolder folder("picture");
  write_atomically(folder.path() / "script", script_for_file(request[0]));
  for (std::size_t k = 1; k + 1 < request.size(); k += 2) {
    if (!is_plain_name(request[k]))
      throw Error(ErrorCode::not_permitted, "data of a picture have a name that is none");
    write_atomically(folder.path() / request[k], request[k + 1]);
  }
  ConfinedRequest work{.work = Work::draw, .confinement = {}};
  work.confinement.as = Confined::drawing;
  work.confinement.processor_seconds = 20;
  // Landlock and the own root each restrict files. With Landlock, the own root is optional: gnuplot on some
  // systems needs files outside it.
  const bool landlock = std::ranges::any_of(
      barriers, [](const std::string& barrier) { return barrier.starts_with("Landlock"); });
  for (const std::string& barrier : barriers)
    if (!landlock || barrier != own_root_barrier) work.barriers.push_back(barrier);
  const Finished done = run_confined(work, folder.path().string(), drawing_seconds, std::size_t{1} << 16,
                                     [&] { return given_up.load(); });
  std::string picture = read_plain_file(folder.path(), "picture", most_picture_bytes).value_or("");
  if (done.status != 0 || picture.empty())
    refuse_state(done.status == 127
                     ? "charts and pictures are drawn by gnuplot, which is not installed"
                     : "gnuplot drew no picture: " + done.error + (done.late ? "it took too long" : ""));
  return {std::move(picture), done.error};
}

// One request. False if the other end is closed or the request is invalid.
bool answer_drawing(int socket, const std::vector<std::string>& barriers, const std::atomic<bool>& given_up) {
  const auto request = receive_frame(socket, most_picture_bytes);
  if (!request || request->empty() || request->size() % 2 == 0) return false;
  try {
    const GnuplotResult drawn = draw(*request, barriers, given_up);
    const std::string_view answer[] = {"", drawn.picture, drawn.messages};
    return send_frame(socket, answer);
  } catch (const std::exception& error) {
    const std::string_view answer[] = {error.what(), "", ""};
    return send_frame(socket, answer);
  }
}

constexpr std::size_t ways_out = 4;

}  // namespace

ConfinedProcess::ConfinedProcess(const ConfinedRequest& request, const std::string& folder) {
  const Descriptor input = content(to_json(request).text());
  Ends out = pipe_from_child(), err = pipe_from_child(), told = pipe_from_child(), drawn = socket_to_child();
  std::vector<int> given{input.get(), out.there.get(), err.there.get(), told.there.get(), drawn.there.get()};
  const Descriptor lock = request.lock < 0 ? Descriptor() : copied_up(request.lock);
  if (request.lock >= 0) given.push_back(lock.get());
  process_ = start(given, folder);
  output = std::move(out.here);
  error = std::move(err.here);
  events = std::move(told.here);
  drawing = std::move(drawn.here);
}

ConfinedProcess::~ConfinedProcess() {
  if (status_) return;
  send(SIGKILL);
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
}

void ConfinedProcess::send(int signal) const {
  if (!status_) ::kill(process_, signal);
}

std::optional<int> ConfinedProcess::ended() {
  int status = 0;
  rusage used{};
  if (!status_ && ::wait4(process_, &status, WNOHANG, &used) == process_) {
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    status_ = status;
    processor_seconds_ = seconds(used.ru_utime) + seconds(used.ru_stime);
  }
  return status_;
}

Follower::Follower(const ConfinedRequest& request, const std::string& folder, FollowBounds bounds)
    : process_(request, folder), bounds_(std::move(bounds)) {
  if (request.work != Work::run && request.work != Work::command) return;
  drawer_ = std::thread([this, barriers = request.barriers] {
    while (answer_drawing(process_.drawing.get(), barriers, over_)) {
    }
  });
}

Follower::~Follower() {
  process_.send(SIGKILL);
  over_.store(true);
  ::shutdown(process_.drawing.get(), SHUT_RDWR);
  if (drawer_.joinable()) drawer_.join();
}

int Follower::follow() {
  for (;;) {
    std::vector<pollfd> watched = also_watched_;
    bool open = false;
    for (const Descriptor* pipe : {&process_.output, &process_.error, &process_.events}) {
      open = open || pipe->get() >= 0;
      if (!discards_ || pipe == &process_.events) watched.push_back({pipe->get(), POLLIN, 0});
    }
    ::poll(watched.data(), watched.size(),
           !open       ? 1
           : discards_ ? 5
                       : static_cast<int>(bounds_.pause.count()));
    const std::optional<int> status = process_.ended();
    // With the rest of the pipes after the end.
    for (Descriptor* pipe : {&process_.output, &process_.error, &process_.events}) {
      char piece[65536];
      // Bounded: endless output must not delay the limits.
      for (int most = 16; pipe->get() >= 0 && most > 0; --most) {
        const ssize_t got = ::read(pipe->get(), piece, sizeof piece);
        if (got == 0) pipe->reset();
        if (got <= 0) break;
        take(*pipe, {piece, static_cast<std::size_t>(got)});
      }
    }
    const Clock::time_point now = Clock::now();
    look(now);
    if (status) return *status;
    watch_limits(now);
  }
}

void Follower::watch_limits(Clock::time_point now) {
  if (now - begun_ > std::chrono::duration<double>(bounds_.seconds + bounds_.grace))
    end("the time limit of " + format_quantity(bounds_.seconds, dimension::time) + " was reached");
  if (kill_at_ && now >= *kill_at_) process_.send(SIGKILL);
  if (now < look_at_ || bounds_.directory_bytes == 0) return;
  const cli::DiskUse use = cli::disk_use(bounds_.directory, bounds_.files);
  look_at_ = cli::next_look(now);
  if (use.files > bounds_.files) end("it wrote more than " + std::to_string(bounds_.files) + " files");
  if (use.bytes > bounds_.directory_bytes)
    end("its files take more than " + format_bytes(bounds_.directory_bytes) + bounds_.disk_option);
  // It still writes: kill.
  if (use.bytes > bounds_.directory_bytes + bounds_.directory_bytes / 4 || use.files > 2 * bounds_.files)
    process_.send(SIGKILL);
}

bool Follower::end(const std::string& why) {
  if (!ended_for_.empty()) return false;
  ended_for_ = why;
  process_.send(bounds_.to_end.count() == 0 ? SIGKILL : SIGTERM);
  kill_at_ = Clock::now() + bounds_.to_end;
  return true;
}

std::string death_text(int signal) {
  return signal == SIGXCPU || signal == SIGKILL
             ? "the system ended the run: it used more processor time or memory than its limits"
             : "the run died of signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

Finished run_confined(const ConfinedRequest& request, const std::string& folder, double patience,
                      std::size_t most_bytes, const std::function<bool()>& given_up) {
  class Collector final : public Follower {
   public:
    Collector(const ConfinedRequest& request, const std::string& folder, double patience,
              std::size_t most_bytes, const std::function<bool()>& given_up)
        : Follower(request, folder, {.seconds = patience, .grace = 0, .to_end = {}}),
          most_bytes_(most_bytes),
          given_up_(given_up) {}
    Finished finished() {
      const int status = follow();
      done_.late = !ended_for_.empty() && !done_.given_up;
      if (WIFEXITED(status)) done_.status = WEXITSTATUS(status);
      return std::move(done_);
    }

   private:
    void take(const Descriptor& from, std::string_view piece) override {
      std::string& text = &from == &process_.output  ? done_.output
                          : &from == &process_.error ? done_.error
                                                     : done_.events;
      if (text.size() < most_bytes_) text += piece;
    }
    void look(Clock::time_point) override {
      if (given_up_ && !done_.given_up && given_up_()) done_.given_up = end("it was given up");
    }

    const std::size_t most_bytes_;
    const std::function<bool()>& given_up_;
    Finished done_;
  };
  return Collector(request, folder, patience, most_bytes, given_up).finished();
}

bool BarrierReport::all_hold() const {
  return tried.size() == ways_out && std::ranges::all_of(tried, &Barrier::holds);
}

std::string BarrierReport::text() const {
  std::string text;
  for (const Barrier& barrier : tried)
    text += "  " + barrier.name + std::string(barrier.name.size() < 11 ? 11 - barrier.name.size() : 1, ' ') +
            (barrier.holds ? barrier.sentence : "NOT SHUT: " + barrier.by) + "\n";
  if (tried.size() < ways_out)
    text += "  NOT SHUT: " + (problem.empty() ? std::string("another program could be run") : problem) + "\n";
  text += "  by " + joined(made, ", ") + "\n";
  if (!missing.empty()) text += "  without " + joined(missing, ", ") + "\n";
  return text;
}

BarrierReport try_out_barriers(const std::string& folder) {
  BarrierReport report;
  try {
    ConfinedRequest request{.work = Work::probe, .confinement = {}};
    const Finished done = run_confined(request, folder, 5, std::size_t{1} << 16);
    // The last line holds all results.
    const std::size_t end = done.output.rfind('\n');
    if (end == std::string::npos) {
      report.problem = done.error.empty() ? "the trial said nothing" : done.error;
      return report;
    }
    const std::string all = done.output.substr(0, end);
    const Json json = Json::parse(all.substr(all.rfind('\n') + 1), "the trial of the barriers");
    for (const Json& name : json["made"].list()) report.made.push_back(name.string());
    for (const Json& name : json["missing"].list()) report.missing.push_back(name.string());
    for (const Json& barrier : json["barriers"].list())
      report.tried.push_back({barrier["name"].string(), barrier["sentence"].string(),
                              barrier["holds"].boolean(), barrier["by"].string()});
  } catch (const Error& error) {
    report.problem = error.what();
  }
  return report;
}

}  // namespace asperity::web
