// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

namespace {

Barrier verdict(const char* name, const char* sentence, bool holds, const std::string& otherwise) {
  return {name, sentence, holds, holds ? "" : otherwise};
}

bool opens(const char* file, int how) {
  const int descriptor = ::open(file, how | O_CLOEXEC, 0600);
  if (descriptor >= 0) ::close(descriptor);
  return descriptor >= 0;
}

Barrier files() {
  std::string open;
  for (const char* file : {"/etc/passwd", "/proc/self/maps", "/proc/1/cmdline", "/usr/bin/env", "/", ".."})
    if (opens(file, O_RDONLY) && std::strcmp(file, "/") != 0 && std::strcmp(file, "..") != 0)
      open += (open.empty() ? "" : ", ") + std::string(file);
  for (const char* file : {"/tmp/asperity-barrier", "../asperity-barrier", "/asperity-barrier"})
    if (opens(file, O_WRONLY | O_CREAT | O_EXCL)) {
      ::unlink(file);
      open += (open.empty() ? "" : ", ") + std::string(file);
    }
  return verdict("files", "no file outside its own directory is opened", open.empty(), "it opened " + open);
}

Barrier processes() {
  // A raw call: no library code may run in a child that should not exist.
  const long child = ::syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr);
  if (child == 0) ::_exit(0);
  if (child > 0) ::waitpid(static_cast<pid_t>(child), nullptr, 0);
  const bool reaches = ::kill(::getppid(), 0) == 0 || ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0;
  return verdict("processes", "no process is started, signalled or traced", child < 0 && !reaches,
                 child >= 0 ? "it started one" : "it reached its parent");
}

Barrier programs() {
  char program[] = "/bin/false", *const arguments[] = {program, nullptr}, *const environment[] = {nullptr};
  // Returns only if refused; otherwise this process is replaced.
  const int before = ::access(program, X_OK);
  if (before == 0 || errno == EPERM || errno == EACCES || errno == ENOENT)
    ::execve(program, arguments, environment);
  return verdict("programs", "no other program is run", true, "");
}

Barrier network() {
  bool open = false;
  for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK}) {
    const int socket = ::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int datagram = ::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    for (const int made : {socket, datagram})
      if (made >= 0) {
        open = true;
        ::close(made);
      }
  }
  return verdict("network", "no socket is opened", !open, "it opened one");
}

}  // namespace

std::vector<Barrier> try_barriers() { return {files(), processes(), network(), programs()}; }

}  // namespace asperity::web
