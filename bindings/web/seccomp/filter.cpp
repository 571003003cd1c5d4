// SPDX-License-Identifier: GPL-3.0-or-later
// The part asperity-sandbox.so. Other calls fail with EPERM: programs, processes, sockets, mounts,
// namespaces, keys, BPF, io_uring. A script's process gets no executable memory.
#include <fcntl.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>

#include "bindings/web/sandbox/confinement.hpp"
#include "engine/core/sanitizers.hpp"

namespace {

using asperity::web::Confined;

constexpr const char* allowed[] = {
    // files, restricted by other barriers
    "read", "write", "readv", "writev", "pread64", "pwrite64", "lseek", "_llseek", "close", "close_range",
    "dup", "dup2", "dup3", "open", "openat", "creat", "access", "faccessat", "faccessat2", "stat", "lstat",
    "fstat", "newfstatat", "fstatat64", "statx", "statfs", "fstatfs", "getdents", "getdents64", "mkdir",
    "mkdirat", "rmdir", "unlink", "unlinkat", "rename", "renameat", "renameat2", "truncate", "ftruncate",
    "fsync", "fdatasync", "fallocate", "fadvise64", "readlink", "readlinkat", "getcwd", "umask", "flock",
    "copy_file_range", "sendfile",
    // memory
    "munmap", "mremap", "madvise", "brk", "msync",
    // own threads
    "futex", "futex_waitv", "set_robust_list", "get_robust_list", "rseq", "set_tid_address", "gettid",
    "getpid", "getppid", "sched_yield", "sched_getaffinity", "sched_getparam", "sched_getscheduler",
    "sched_get_priority_max", "sched_get_priority_min", "membarrier", "exit", "exit_group", "restart_syscall",
    "rt_sigaction", "rt_sigprocmask", "rt_sigreturn", "rt_sigtimedwait", "rt_sigpending", "rt_sigsuspend",
    "sigaltstack", "pause",
    // time and machine facts
    "clock_gettime", "clock_getres", "clock_nanosleep", "nanosleep", "gettimeofday", "time", "times",
    "getrusage", "uname", "sysinfo", "getuid", "getgid", "geteuid", "getegid", "getrlimit", "getrandom",
    "getcpu",
    // waiting on open descriptors
    "poll", "ppoll", "select", "pselect6", "arch_prctl"};

struct Release {
  void operator()(void* filter) const { seccomp_release(filter); }
};

class Filter {
 public:
  explicit Filter() : filter_(seccomp_init(SCMP_ACT_ERRNO(EPERM))) {
    if (filter_ == nullptr) failed_ = ENOMEM;
  }
  // Calls unknown here need no rule.
  template <class... Conditions>
  void allow(const char* name, Conditions... conditions) {
    rule(SCMP_ACT_ALLOW, name, conditions...);
  }
  template <class... Conditions>
  void rule(std::uint32_t action, const char* name, Conditions... conditions) {
    const int number = seccomp_syscall_resolve_name(name);
    if (failed_ != 0 || number == __NR_SCMP_ERROR) return;
    const int result = seccomp_rule_add(filter_.get(), action, number, sizeof...(conditions), conditions...);
    if (result != 0 && result != -EDOM) failed_ = -result;
  }
  const char* load() {
    // For all threads: an unfiltered thread could start others.
    if (failed_ == 0) failed_ = -seccomp_attr_set(filter_.get(), SCMP_FLTATR_CTL_TSYNC, 1);
    if (failed_ == 0) failed_ = -seccomp_load(filter_.get());
    return failed_ == 0 ? nullptr : std::strerror(failed_);
  }

 private:
  std::unique_ptr<void, Release> filter_;
  int failed_ = 0;
};

scmp_arg_cmp equals(unsigned argument, scmp_datum_t value) { return {argument, SCMP_CMP_EQ, value, 0}; }
scmp_arg_cmp without(unsigned argument, scmp_datum_t bits) { return {argument, SCMP_CMP_MASKED_EQ, bits, 0}; }
scmp_arg_cmp with(unsigned argument, scmp_datum_t bits) { return {argument, SCMP_CMP_MASKED_EQ, bits, bits}; }

}  // namespace

extern "C" __attribute__((visibility("default"))) const char* asperity_confine_system_calls(Confined as) {
  Filter filter;
  for (const char* name : allowed) filter.allow(name);
  // Threads, no processes. A filter cannot inspect arguments of clone3, which fails with ENOSYS.
  filter.allow("clone", with(0, 0x00010000 /* CLONE_THREAD */));
  filter.rule(SCMP_ACT_ERRNO(ENOSYS), "clone3");
  // To this process only.
  const auto own = static_cast<scmp_datum_t>(::getpid());
  filter.allow("tgkill", equals(0, own));
  filter.allow("kill", equals(0, own));
  // Own limits can only decrease.
  filter.allow("prlimit64", equals(0, 0));
  filter.allow("setrlimit");
  filter.allow("prctl", equals(0, PR_SET_NAME));
  filter.allow("ioctl", equals(1, TCGETS));
  filter.allow("ioctl", equals(1, FIONREAD));
  for (const int command : {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_GETLK, F_SETLK,
                            F_SETLKW, F_OFD_GETLK, F_OFD_SETLK, F_OFD_SETLKW})
    filter.allow("fcntl", equals(1, static_cast<scmp_datum_t>(command)));
  if (as == Confined::drawing) {
    // gnuplot drops group privileges at its start and aborts if refused.
    for (const char* name :
         {"execve", "mmap", "mprotect", "pipe2", "chmod", "fchmod", "chdir", "setuid", "setgid"})
      filter.allow(name);
  } else {
    filter.allow("mmap", without(2, PROT_EXEC));
    filter.allow("mprotect", without(2, PROT_EXEC));
    // Copying sets modes; set-user-ID and set-group-ID stay forbidden.
    filter.allow("fchmod", without(1, S_ISUID | S_ISGID));
    // The undefined-behaviour sanitizer tests memory by writing to a pipe, or reports wrong types, as for the
    // first std::thread in live_script.cpp.
    if (asperity::sanitized)
      for (const char* name : {"pipe", "pipe2"}) filter.allow(name);
  }
  return filter.load();
}
