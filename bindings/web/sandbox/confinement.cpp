// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/confinement.hpp"

#include <linux/capability.h>
#include <linux/securebits.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

#include "bindings/web/sandbox/namespaces.hpp"
#include "bindings/web/sandbox/system_calls.hpp"
#include "engine/core/error.hpp"
#include "engine/core/sanitizers.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

// Defined in file_barrier.cpp.
std::string confine_files(const Confinement& confinement, int& version);

namespace {

void limit(int what, std::int64_t most, const char* of) {
  rlimit now{};
  ::getrlimit(static_cast<__rlimit_resource_t>(what), &now);
  const rlim_t value = std::min(static_cast<rlim_t>(most), now.rlim_max);
  const rlimit wanted{value, value};
  if (::setrlimit(static_cast<__rlimit_resource_t>(what), &wanted) != 0)
    throw Error(ErrorCode::bad_state,
                std::string("the limit of ") + of + " cannot be set: " + std::strerror(errno));
}

void set_limits(const Confinement& confinement) {
  constexpr std::int64_t libraries = std::int64_t{512} << 20;
  // Threads reserve stacks and heaps long before using them.
  const std::int64_t reserved = (std::int64_t{1} << 30) + std::int64_t{160} *
                                                              std::max(confinement.threads, 1) *
                                                              (std::int64_t{1} << 20);
  limit(RLIMIT_CORE, 0, "core dumps");
  limit(RLIMIT_FSIZE, confinement.file_bytes, "the size of a file");
  limit(RLIMIT_NOFILE, 64, "open files");
  limit(RLIMIT_MEMLOCK, 0, "locked memory");
  limit(RLIMIT_MSGQUEUE, 0, "message queues");
  if (!sanitized) {
    limit(RLIMIT_DATA, confinement.memory_bytes + libraries, "memory");
    limit(RLIMIT_AS, confinement.memory_bytes + libraries + reserved, "address space");
  }
  // A signal, and 5 s later a kill.
  const auto seconds = static_cast<rlim_t>(std::max<std::int64_t>(confinement.processor_seconds, 1));
  const rlimit processor{seconds, seconds + 5};
  if (::setrlimit(RLIMIT_CPU, &processor) != 0)
    limit(RLIMIT_CPU, confinement.processor_seconds, "processor time");
}

// Besides the working directory: gnuplot's libraries, files and fonts.
std::vector<Place> places_of_drawing() {
  std::vector<Place> places{{".", "/run", true}};
  for (const char* folder : {"/usr/bin", "/usr/lib", "/usr/lib64", "/lib", "/lib64", "/usr/share",
                             "/etc/alternatives", "/etc/fonts", "/var/cache/fontconfig"}) {
    struct stat facts {};
    if (::stat(folder, &facts) != 0 || !S_ISDIR(facts.st_mode)) continue;
    const std::string_view name = folder;
    places.push_back({folder, folder, false, name.ends_with("bin") || name.find("lib") != name.npos});
  }
  return places;
}

// Hides files outside the places and enters the working folder. Returns the reason of a failure.
std::string go_to_own_root(const Confinement& confinement, const Namespaces& own) {
  const bool elsewhere = !confinement.places.empty();
  std::string problem = own.mount;
  if (problem.empty())
    problem = confinement.as == Confined::drawing ? enter_own_root(places_of_drawing(), "/run")
              : elsewhere                         ? enter_own_root(confinement.places, confinement.work)
                                                  : enter_own_root({{".", "/run", true}}, "/run");
  if (!problem.empty() && elsewhere && ::chdir(confinement.work.c_str()) != 0)
    throw Error(ErrorCode::bad_state, "the folder " + asperity::quoted(confinement.work) +
                                          " cannot be entered: " + std::strerror(errno));
  return problem;
}

// Drops all capabilities for good, even if root started the program.
bool drop_capabilities() {
  ::prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  for (unsigned long right = 0; right < 64; ++right) ::prctl(PR_CAPBSET_DROP, right, 0, 0, 0);
  ::prctl(PR_SET_SECUREBITS, SECBIT_NOROOT | SECBIT_NOROOT_LOCKED | SECBIT_NO_SETUID_FIXUP, 0, 0, 0);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct none[2] = {};
  return ::syscall(SYS_capset, &header, none) == 0;
}

}  // namespace

std::vector<std::string> confine(const Confinement& confinement, std::vector<std::string>& missing) {
  std::vector<std::string> made;
  const auto note = [&](const std::string& name, const std::string& problem) {
    if (problem.empty())
      made.push_back(name);
    else
      missing.push_back(name + " (" + problem + ")");
  };
  const auto parent = confinement.parent > 0 ? static_cast<pid_t>(confinement.parent) : ::getppid();
  set_limits(confinement);
  const Namespaces own = enter_namespaces();
  note("a network of its own", own.network);
  if (own.user.empty()) limit(RLIMIT_NPROC, 256, "threads");
  note(own_root_barrier, go_to_own_root(confinement, own));
  note("no rights of the superuser", drop_capabilities() ? "" : std::strerror(errno));
  ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
  // Dies with the server, even a killed one. Set after the change of credentials, which resets this signal.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  if (::getppid() != parent) ::_exit(1);
  note("no new rights", ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? "" : std::strerror(errno));
  int version = 0;
  const std::string landlock = confine_files(confinement, version);
  note(landlock.empty() ? "Landlock " + std::to_string(version) : "Landlock", landlock);
  note("a filter of system calls", confine_system_calls(confinement.as));
  return made;
}

}  // namespace asperity::web
