// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/namespaces.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>

namespace asperity::web {

namespace {

constexpr int apart = CLONE_NEWNS | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWUTS;

bool write_to(const char* file, const std::string& text) {
  const int descriptor = ::open(file, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool whole = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(descriptor);
  return whole;
}

// The user and the group stay who they are, and nobody else is there.
bool keep_identity(uid_t user, gid_t group) {
  const std::string u = std::to_string(user), g = std::to_string(group);
  return write_to("/proc/self/setgroups", "deny") && write_to("/proc/self/uid_map", u + " " + u + " 1") &&
         write_to("/proc/self/gid_map", g + " " + g + " 1");
}

}  // namespace

Namespaces enter_namespaces() {
  const uid_t user = ::geteuid();
  const gid_t group = ::getegid();
  if (::unshare(CLONE_NEWUSER | apart) == 0) {
    if (keep_identity(user, group)) return {};
    const std::string problem = std::string("its user cannot be mapped: ") + std::strerror(errno);
    return {.user = problem, .network = "", .mount = problem};
  }
  const std::string refused = std::strerror(errno);
  if (::unshare(apart) == 0) return {.user = refused, .network = "", .mount = ""};
  Namespaces none{.user = refused, .network = refused, .mount = refused};
  if (::unshare(CLONE_NEWNET) == 0) none.network.clear();
  return none;
}

std::string enter_own_root() {
  const auto problem = [](const char* step) { return std::string(step) + ": " + std::strerror(errno); };
  char here_text[PATH_MAX];
  if (::getcwd(here_text, sizeof here_text) == nullptr) return problem("the working directory");
  const std::string here = here_text;
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return problem("mounts of its own");
  const int under = ::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  struct statvfs flags {};
  if (under < 0 || ::fstatvfs(under, &flags) != 0) return problem("the working directory");
  if (::mount("none", here.c_str(), "tmpfs", MS_NOSUID | MS_NOEXEC, "size=64k,nr_inodes=16,mode=755") != 0) {
    ::close(under);
    return problem("a root");
  }
  // From here on a failure takes the mount away again.
  const auto undo = [&](const char* step) {
    std::string text = problem(step);
    ::umount2(here.c_str(), MNT_DETACH);
    ::close(under);
    return text;
  };
  const std::string run = here + "/run", device = here + "/dev/null";
  if (::mkdir(run.c_str(), 0755) != 0 || ::mkdir((here + "/dev").c_str(), 0755) != 0)
    return undo("its folders");
  const int null = ::open(device.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (null < 0) return undo("/dev/null");
  ::close(null);
  const std::string source = "/proc/self/fd/" + std::to_string(under);
  if (::mount(source.c_str(), run.c_str(), nullptr, MS_BIND, nullptr) != 0) return undo("its directory");
  // What the file system forbids already stays forbidden.
  unsigned long kept = MS_NOSUID | MS_NODEV | MS_NOEXEC;
  if (flags.f_flag & ST_NOATIME) kept |= MS_NOATIME;
  if (flags.f_flag & ST_NODIRATIME) kept |= MS_NODIRATIME;
  if (flags.f_flag & ST_RELATIME) kept |= MS_RELATIME;
  if (::mount(nullptr, run.c_str(), nullptr, MS_REMOUNT | MS_BIND | kept, nullptr) != 0)
    return undo("its directory without programs");
  if (::mount("/dev/null", device.c_str(), nullptr, MS_BIND, nullptr) != 0) return undo("/dev/null");
  ::mount(nullptr, here.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY | MS_NOSUID | MS_NOEXEC, nullptr);
  if (::chdir(here.c_str()) != 0) return undo("the root");
  if (::syscall(SYS_pivot_root, ".", ".") != 0) {
    std::string text = undo("the root");
    if (::chdir(here.c_str()) != 0) text += " (and the way back)";
    return text;
  }
  // The old root lies over the new one until it is taken away.
  ::umount2(".", MNT_DETACH);
  ::close(under);
  if (::chdir("/run") != 0) return problem("its directory");
  return "";
}

}  // namespace asperity::web
