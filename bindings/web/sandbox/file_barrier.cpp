// SPDX-License-Identifier: GPL-3.0-or-later
// Landlock: restricts the files that a process may open, by path. Linux 5.13 or later with Landlock enabled;
// no privileges needed.
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include "bindings/web/sandbox/confinement.hpp"

namespace asperity::web {

namespace {

// Newer than the kernel headers.
constexpr std::uint64_t truncate_right = std::uint64_t{1} << 14,
                        device_control_right = std::uint64_t{1} << 15;
constexpr std::uint64_t connect_and_bind = 3, abstract_sockets_and_signals = 3;
struct Ruleset {
  std::uint64_t files = 0, network = 0, scope = 0;
};

constexpr std::uint64_t look = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t keep = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG |
                               LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                               LANDLOCK_ACCESS_FS_REMOVE_DIR;

std::uint64_t every_right(int version) {
  std::uint64_t rights = (std::uint64_t{1} << 13) - 1;
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= 3) rights |= truncate_right;
  if (version >= 5) rights |= device_control_right;
  return rights;
}

// A missing place needs no rule.
bool allow(int ruleset, const char* place, std::uint64_t rights) {
  landlock_path_beneath_attr rule{};
  rule.parent_fd = ::open(place, O_PATH | O_CLOEXEC);
  if (rule.parent_fd < 0) return true;
  rule.allowed_access = rights;
  const long added = ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  ::close(rule.parent_fd);
  return added == 0;
}

}  // namespace

// Hides files outside the places, or without places outside the working directory, except for gnuplot's
// needs. Returns "" and Landlock's version, or the reason of a failure. Requires PR_SET_NO_NEW_PRIVS.
std::string confine_files(const Confinement& confinement, int& version) {
  version =
      static_cast<int>(::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
  if (version < 1)
    return errno == EOPNOTSUPP ? "the kernel has it, switched off"
                               : "the kernel has none: " + std::string(std::strerror(errno));
  const std::uint64_t every = every_right(version);
  const std::uint64_t cut = version >= 3 ? truncate_right : 0;
  const Ruleset wanted{every, version >= 4 ? connect_and_bind : 0,
                       version >= 6 ? abstract_sockets_and_signals : 0};
  const std::size_t size = version >= 6 ? 24 : version >= 4 ? 16 : 8;
  const int ruleset = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &wanted, size, 0));
  if (ruleset < 0) return std::strerror(errno);
  // Moving a file between writable folders gains no rights.
  const std::uint64_t move = version >= 2 ? LANDLOCK_ACCESS_FS_REFER : 0;
  bool good = confinement.places.empty() ? allow(ruleset, ".", look | keep | cut) : true;
  for (const Place& place : confinement.places)
    good = good && allow(ruleset, place.folder.c_str(), place.write ? look | keep | cut | move : look);
  good =
      good && allow(ruleset, "/dev/null", LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | cut);
  if (confinement.as == Confined::drawing) {
    for (const char* place : {"/usr/share", "/etc/fonts", "/etc/ld.so.cache", "/var/cache/fontconfig"})
      good = good && allow(ruleset, place, place[5] == 'l' ? LANDLOCK_ACCESS_FS_READ_FILE : look);
    for (const char* place : {"/usr/bin", "/usr/lib", "/usr/lib64", "/lib", "/lib64"})
      good = good && allow(ruleset, place, look | LANDLOCK_ACCESS_FS_EXECUTE);
  }
  // Open files keep their rights.
  if (good) good = ::syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
  const std::string problem = good ? "" : std::strerror(errno);
  ::close(ruleset);
  return problem;
}

}  // namespace asperity::web
