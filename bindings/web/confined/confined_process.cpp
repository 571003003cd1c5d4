// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/confined_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"

namespace asperity::web {

namespace {

struct Ends {
  Descriptor here, there;
};

[[noreturn]] void throw_not_started(int reason) {
  throw Error(ErrorCode::bad_state, std::string("a run cannot be started: ") + std::strerror(reason));
}

// Above 16, so that dup2 in the child cannot overwrite the descriptor.
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
  // A new session: Ctrl-C reaches only the server.
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

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::reset() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

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

Finished run_confined(const ConfinedRequest& request, const std::string& folder,
                      std::chrono::milliseconds patience, std::size_t most_bytes,
                      const std::atomic<bool>* given_up) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + patience;
  const auto is_over = [&] { return Clock::now() >= end || (given_up != nullptr && given_up->load()); };
  ConfinedProcess process(request, folder);
  Finished done;
  std::array<std::pair<Descriptor*, std::string*>, 3> pipes{
      {{&process.output, &done.output}, {&process.error, &done.error}, {&process.events, &done.events}}};
  for (bool open = true; open;) {
    std::array<pollfd, 3> watched{};
    for (std::size_t k = 0; k < 3; ++k) watched[k] = {pipes[k].first->get(), POLLIN, 0};
    ::poll(watched.data(), watched.size(), 50);
    open = false;
    for (auto& [pipe, text] : pipes) {
      char piece[16384];
      const ssize_t got = pipe->get() < 0 ? 0 : ::read(pipe->get(), piece, sizeof piece);
      if (got > 0 && text->size() < most_bytes) text->append(piece, static_cast<std::size_t>(got));
      if (got == 0) pipe->reset();
      open = open || pipe->get() >= 0;
    }
    if (is_over()) {
      done.late = true;
      process.send(SIGKILL);
      break;
    }
  }
  std::optional<int> status;
  while (!(status = process.ended())) {
    if (!done.late && is_over()) {
      done.late = true;
      process.send(SIGKILL);
    }
    ::poll(nullptr, 0, 1);
  }
  if (WIFEXITED(*status)) done.status = WEXITSTATUS(*status);
  return done;
}

}  // namespace asperity::web
