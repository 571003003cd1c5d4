// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/namespaces.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstring>
#include <utility>

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

// Maps only the own user and group.
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
// directory, because the new root would be copied, too.
class Bound {
 public:
  explicit Bound(const Place& of)
      : place(&of), folder_(::open(of.folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_ >= 0 && ::fstatvfs(folder_, &flags_) != 0) shut(folder_);
    if (folder_ >= 0 && knows_trees())
      tree_ = static_cast<int>(
          ::syscall(open_tree_call, folder_, "", copied | O_CLOEXEC | of_descriptor | recursive));
  }
  ~Bound() {
    shut(tree_);
    shut(folder_);
  }
  Bound(Bound&& other) noexcept
      : place(other.place),
        folder_(std::exchange(other.folder_, -1)),
        tree_(std::exchange(other.tree_, -1)),
        flags_(other.flags_) {}
  Bound& operator=(Bound&& other) noexcept {
    std::swap(place, other.place);
    std::swap(folder_, other.folder_);
    std::swap(tree_, other.tree_);
    std::swap(flags_, other.flags_);
    return *this;
  }

  bool open() const { return folder_ >= 0 && (tree_ >= 0 || !knows_trees()); }
  // No devices, no set-user-ID; programs and writing only if allowed.
  bool mount_at(const std::string& at) const {
    if (tree_ >= 0) {
      const MountAttributes wanted{attribute_no_setuid | attribute_no_devices |
                                   (place->programs ? 0 : attribute_no_programs) |
                                   (place->write ? 0 : attribute_read_only)};
      return ::syscall(mount_setattr_call, tree_, "", of_descriptor | recursive, &wanted, sizeof wanted) ==
                 0 &&
             ::syscall(move_mount_call, tree_, "", AT_FDCWD, at.c_str(), from_descriptor) == 0;
    }
    const std::string source = "/proc/self/fd/" + std::to_string(folder_);
    if (::mount(source.c_str(), at.c_str(), nullptr, MS_BIND, nullptr) != 0) return false;
    // The file system's own restrictions remain.
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
  static void shut(int& descriptor) {
    const int number = std::exchange(descriptor, -1);
    const int reason = errno;
    if (number >= 0) ::close(number);
    errno = reason;
  }

  int folder_ = -1, tree_ = -1;
  struct statvfs flags_ {};
};

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

std::string enter_own_root(const std::vector<Place>& places, const std::string& work) {
  char here_text[PATH_MAX];
  if (::getcwd(here_text, sizeof here_text) == nullptr) return root_problem("the working directory");
  const std::string here = here_text;
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
    return root_problem("mounts of its own");
  std::vector<Bound> bound;
  for (const Place& place : places) {
    Bound& one = bound.emplace_back(place);
    if (!one.open()) return root_problem("the folder " + place.folder);
  }
  // Parents before their subfolders.
  std::ranges::sort(bound, {}, [](const Bound& one) { return one.place->seen.size(); });
  const int under = ::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (under < 0) return root_problem("the working directory");
  if (::mount("none", here.c_str(), "tmpfs", MS_NOSUID | MS_NOEXEC, "size=1m,nr_inodes=4k,mode=755") != 0) {
    ::close(under);
    return root_problem("a root");
  }
  // A failure now unmounts the root.
  const auto undo = [&](const std::string& step) {
    std::string text = root_problem(step);
    ::umount2(here.c_str(), MNT_DETACH);
    if (::fchdir(under) != 0) text += " (and the way back)";
    ::close(under);
    return text;
  };
  const std::string device = here + "/dev/null";
  if (!make_folders(here, "/dev") || !make_folders(here, work)) return undo("its folders");
  const int null = ::open(device.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (null < 0) return undo("/dev/null");
  ::close(null);
  if (::mount("/dev/null", device.c_str(), nullptr, MS_BIND, nullptr) != 0) return undo("/dev/null");
  for (const Bound& one : bound)
    if (!make_folders(here, one.place->seen) || !one.mount_at(here + one.place->seen))
      return undo("the folder " + one.place->seen);
  ::mount(nullptr, here.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY | MS_NOSUID | MS_NOEXEC, nullptr);
  if (::chdir(here.c_str()) != 0) return undo("the root");
  if (::syscall(SYS_pivot_root, ".", ".") != 0) return undo("the root");
  // The old root covers the new one.
  ::umount2(".", MNT_DETACH);
  ::close(under);
  if (::chdir(work.c_str()) != 0) return root_problem("its directory");
  return "";
}

}  // namespace asperity::web
