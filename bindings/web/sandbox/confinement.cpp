// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/confinement.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <linux/landlock.h>
#include <linux/securebits.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/error.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/sanitizers.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

constexpr int apart = CLONE_NEWNS | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWUTS;

bool write_to(const char* file, const std::string& text) {
  const Descriptor opened(::open(file, O_WRONLY | O_CLOEXEC));
  return opened.get() >= 0 &&
         ::write(opened.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

bool opens(const char* file, int how, mode_t mode = 0600) {
  return Descriptor(::open(file, how | O_CLOEXEC, mode)).get() >= 0;
}

// Only the own user and group.
bool keep_identity(uid_t user, gid_t group) {
  const std::string u = std::to_string(user), g = std::to_string(group);
  return write_to("/proc/self/setgroups", "deny") && write_to("/proc/self/uid_map", u + " " + u + " 1") &&
         write_to("/proc/self/gid_map", g + " " + g + " 1");
}

std::string root_problem(const std::string& step) { return step + ": " + std::strerror(errno); }

bool make_folders(const std::string& root, const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string folder = root + path.substr(0, end);
    struct stat facts {};
    if (::stat(folder.c_str(), &facts) != 0 && ::mkdir(folder.c_str(), 0755) != 0) return false;
    if (end == std::string::npos) return true;
  }
}

// Linux 5.12; the C library may be older.
struct MountAttributes {
  std::uint64_t set = 0, clear = 0, propagation = 0, user_namespace = 0;
};
constexpr std::uint64_t attribute_read_only = 1, attribute_no_setuid = 2, attribute_no_devices = 4,
                        attribute_no_programs = 8;
constexpr long open_tree_call = 428, move_mount_call = 429, mount_setattr_call = 442;  // on all processors
constexpr unsigned of_descriptor = 0x1000, recursive = 0x8000;  // AT_EMPTY_PATH, AT_RECURSIVE
constexpr unsigned copied = 1, from_descriptor = 4;             // OPEN_TREE_CLONE, MOVE_MOUNT_F_EMPTY_PATH

bool knows_trees() {
  static const bool known = ::syscall(mount_setattr_call, -1, "", 0, nullptr, 0) < 0 && errno == EINVAL;
  return known;
}

// An open place, with its mounts if the kernel copies trees. Opened before the new root covers the working
// directory, or the new root would be copied, too.
class Bound {
 public:
  explicit Bound(const Place& of)
      : place(&of), folder_(::open(of.folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_.get() >= 0 && ::fstatvfs(folder_.get(), &flags_) != 0) folder_.reset();
    if (folder_.get() >= 0 && knows_trees())
      tree_ = Descriptor(static_cast<int>(
          ::syscall(open_tree_call, folder_.get(), "", copied | O_CLOEXEC | of_descriptor | recursive)));
  }

  bool open() const { return folder_.get() >= 0 && (tree_.get() >= 0 || !knows_trees()); }
  // No devices, no set-user-ID; programs and writing if allowed.
  bool mount_at(const std::string& at) const {
    if (tree_.get() >= 0) {
      const MountAttributes wanted{attribute_no_setuid | attribute_no_devices |
                                   (place->programs ? 0 : attribute_no_programs) |
                                   (place->write ? 0 : attribute_read_only)};
      return ::syscall(mount_setattr_call, tree_.get(), "", of_descriptor | recursive, &wanted,
                       sizeof wanted) == 0 &&
             ::syscall(move_mount_call, tree_.get(), "", AT_FDCWD, at.c_str(), from_descriptor) == 0;
    }
    const std::string source = "/proc/self/fd/" + std::to_string(folder_.get());
    if (::mount(source.c_str(), at.c_str(), nullptr, MS_BIND, nullptr) != 0) return false;
    // Keeps the file system's own restrictions.
    unsigned long kept = MS_NOSUID | MS_NODEV;
    if (!place->programs || (flags_.f_flag & ST_NOEXEC)) kept |= MS_NOEXEC;
    if (flags_.f_flag & ST_NOATIME) kept |= MS_NOATIME;
    if (flags_.f_flag & ST_NODIRATIME) kept |= MS_NODIRATIME;
    if (flags_.f_flag & ST_RELATIME) kept |= MS_RELATIME;
    if (!place->write || (flags_.f_flag & ST_RDONLY)) kept |= MS_RDONLY;
    return ::mount(nullptr, at.c_str(), nullptr, MS_REMOUNT | MS_BIND | kept, nullptr) == 0;
  }

  const Place* place;

 private:
  Descriptor folder_, tree_;
  struct statvfs flags_ {};
};

// Reasons of failures; "" on success.
struct Namespaces {
  std::string user, network, mount;
};

// No network, and a separate file tree. For root, and for all if user namespaces are allowed.
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

// Mounts a root with the places and /dev/null over the working directory and enters its folder `work`, empty
// unless a place. Needs an own mount namespace. Returns "", or the reason of a failure with the files
// unchanged.
std::string enter_own_root(const std::vector<Place>& places, const std::string& work) {
  char here_text[PATH_MAX];
  if (::getcwd(here_text, sizeof here_text) == nullptr) return root_problem("the working directory");
  const std::string here = here_text;
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
    return root_problem("mounts of its own");
  // Parents before their subfolders.
  std::vector<Place> sorted = places;
  std::ranges::stable_sort(sorted, {}, [](const Place& place) { return place.seen.size(); });
  std::vector<Bound> bound;
  for (const Place& place : sorted)
    if (!bound.emplace_back(place).open()) return root_problem("the folder " + place.folder);
  const Descriptor under(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (under.get() < 0) return root_problem("the working directory");
  if (::mount("none", here.c_str(), "tmpfs", MS_NOSUID | MS_NOEXEC, "size=1m,nr_inodes=4k,mode=755") != 0)
    return root_problem("a root");
  // A failure now unmounts the root.
  const auto undo = [&](const std::string& step) {
    std::string text = root_problem(step);
    ::umount2(here.c_str(), MNT_DETACH);
    if (::fchdir(under.get()) != 0) text += " (and the way back)";
    return text;
  };
  const std::string device = here + "/dev/null";
  if (!make_folders(here, "/dev") || !make_folders(here, work)) return undo("its folders");
  if (!opens(device.c_str(), O_WRONLY | O_CREAT, 0666)) return undo("/dev/null");
  if (::mount("/dev/null", device.c_str(), nullptr, MS_BIND, nullptr) != 0) return undo("/dev/null");
  for (const Bound& one : bound)
    if (!make_folders(here, one.place->seen) || !one.mount_at(here + one.place->seen))
      return undo("the folder " + one.place->seen);
  ::mount(nullptr, here.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY | MS_NOSUID | MS_NOEXEC, nullptr);
  if (::chdir(here.c_str()) != 0) return undo("the root");
  if (::syscall(SYS_pivot_root, ".", ".") != 0) return undo("the root");
  // The old root covers the new one.
  ::umount2(".", MNT_DETACH);
  if (::chdir(work.c_str()) != 0) return root_problem("its directory");
  return "";
}

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
bool allow(const Descriptor& ruleset, const char* place, std::uint64_t rights) {
  const Descriptor opened(::open(place, O_PATH | O_CLOEXEC));
  if (opened.get() < 0) return true;
  const landlock_path_beneath_attr rule{.allowed_access = rights, .parent_fd = opened.get()};
  return ::syscall(SYS_landlock_add_rule, ruleset.get(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
}

// Landlock restricts, by path and without privileges, the files that a process may open. Hides files outside
// the places, or without places outside the working directory, except for gnuplot's needs. Returns "" and
// Landlock's version, or the reason of a failure. Requires PR_SET_NO_NEW_PRIVS.
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
  const Descriptor ruleset(static_cast<int>(::syscall(SYS_landlock_create_ruleset, &wanted, size, 0)));
  if (ruleset.get() < 0) return std::strerror(errno);
  // Moves between writable folders gain no rights.
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
  if (good) good = ::syscall(SYS_landlock_restrict_self, ruleset.get(), 0) == 0;
  return good ? "" : std::strerror(errno);
}

void limit(int what, std::int64_t most, const char* of) {
  rlimit now{};
  ::getrlimit(static_cast<__rlimit_resource_t>(what), &now);
  const rlim_t value = std::min(static_cast<rlim_t>(most), now.rlim_max);
  const rlimit wanted{value, value};
  if (::setrlimit(static_cast<__rlimit_resource_t>(what), &wanted) != 0)
    refuse_state(std::string("the limit of ") + of + " cannot be set: " + std::strerror(errno));
}

void set_limits(const Confinement& confinement) {
  constexpr std::int64_t libraries = std::int64_t{512} << 20;
  // Threads reserve unused stacks and heaps.
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
  // A signal, then after 5 s a kill.
  const auto seconds = static_cast<rlim_t>(std::max<std::int64_t>(confinement.processor_seconds, 1));
  const rlimit processor{seconds, seconds + 5};
  if (::setrlimit(RLIMIT_CPU, &processor) != 0)
    limit(RLIMIT_CPU, confinement.processor_seconds, "processor time");
}

// Also gnuplot's libraries, files and fonts.
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
    refuse_state("the folder " + asperity::quoted(confinement.work) +
                 " cannot be entered: " + std::strerror(errno));
  return problem;
}

// For good, even if root started the program.
bool drop_capabilities() {
  ::prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  for (unsigned long right = 0; right < 64; ++right) ::prctl(PR_CAPBSET_DROP, right, 0, 0, 0);
  ::prctl(PR_SET_SECUREBITS, SECBIT_NOROOT | SECBIT_NOROOT_LOCKED | SECBIT_NO_SETUID_FIXUP, 0, 0, 0);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct none[2] = {};
  return ::syscall(SYS_capset, &header, none) == 0;
}

ConfineSystemCalls* filter_part = nullptr;

Barrier verdict(const char* name, const char* sentence, bool holds, const std::string& otherwise) {
  return {name, sentence, holds, holds ? "" : otherwise};
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
  // Raw: no library code may run in a forbidden child.
  const long child = ::syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr);
  if (child == 0) ::_exit(0);
  if (child > 0) ::waitpid(static_cast<pid_t>(child), nullptr, 0);
  const bool reaches = ::kill(::getppid(), 0) == 0 || ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0;
  return verdict("processes", "no process is started, signalled or traced", child < 0 && !reaches,
                 child >= 0 ? "it started one" : "it reached its parent");
}

Barrier programs() {
  char program[] = "/bin/false", *const arguments[] = {program, nullptr}, *const environment[] = {nullptr};
  // Returns only if refused.
  const int before = ::access(program, X_OK);
  if (before == 0 || errno == EPERM || errno == EACCES || errno == ENOENT)
    ::execve(program, arguments, environment);
  return verdict("programs", "no other program is run", true, "");
}

Barrier network() {
  bool open = false;
  for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK}) {
    const Descriptor stream(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const Descriptor datagram(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    open = open || stream.get() >= 0 || datagram.get() >= 0;
  }
  return verdict("network", "no socket is opened", !open, "it opened one");
}

}  // namespace

std::string load_system_call_filter() {
  try {
    filter_part = part_function<ConfineSystemCalls>(
        {"sandbox", "the system calls of a script are filtered", "libseccomp2"},
        "asperity_confine_system_calls");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string confine_system_calls(Confined as) {
  if (filter_part == nullptr) return "the part asperity-sandbox.so was not built; it needs libseccomp";
  const char* const problem = filter_part(as);
  return problem == nullptr ? "" : problem;
}

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
  // Dies with the server. After the change of credentials, which resets this signal.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  if (::getppid() != parent) ::_exit(1);
  note("no new rights", ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? "" : std::strerror(errno));
  int version = 0;
  const std::string landlock = confine_files(confinement, version);
  note(landlock.empty() ? "Landlock " + std::to_string(version) : "Landlock", landlock);
  note("a filter of system calls", confine_system_calls(confinement.as));
  return made;
}

std::vector<Barrier> try_barriers() { return {files(), processes(), network(), programs()}; }

}  // namespace asperity::web
