// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Start times (ticks since boot) and the boot tell reused process numbers apart; the process name space tells
// containers apart.
struct LockHolder {
  std::int64_t process = 0;
  std::string host, machine_start, process_space, process_start;
};

std::string first_line_of(const fs::path& file) {
  std::ifstream text(file);
  std::string line;
  std::getline(text, line);
  return line;
}

// Field 22 of /proc/PID/stat; "" without such a process.
std::string start_of(std::int64_t process) {
  const std::string line = first_line_of("/proc/" + std::to_string(process) + "/stat");
  // The program name may hold anything.
  std::size_t at = line.rfind(')');
  for (int field = 2; at != std::string::npos && field < 22; ++field) at = line.find(' ', at + 1);
  if (at == std::string::npos) return {};
  return line.substr(at + 1, line.find(' ', at + 1) - at - 1);
}

LockHolder this_process() {
  LockHolder own;
  own.process = ::getpid();
  utsname system{};
  if (::uname(&system) == 0) own.host = system.nodename;
  own.machine_start = first_line_of("/proc/sys/kernel/random/boot_id");
  std::array<char, 64> space{};
  const ssize_t length = ::readlink("/proc/self/ns/pid", space.data(), space.size());
  if (length > 0) own.process_space.assign(space.data(), static_cast<std::size_t>(length));
  own.process_start = start_of(own.process);
  return own;
}

std::string lock_text(const LockHolder& holder) {
  return Json::object({{"process", holder.process},
                       {"host", holder.host},
                       {"machine_start", holder.machine_start},
                       {"process_space", holder.process_space},
                       {"process_start", holder.process_start}})
             .text() +
         "\n";
}

// None if missing or torn.
std::optional<LockHolder> holder_in(const fs::path& file) {
  std::ifstream text(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(text), {}};
  if (!content.ends_with('\n')) return {};
  try {
    const Json json = Json::parse(content, "the lock");
    LockHolder holder;
    const auto member = [&](const char* name) -> const Json& {
      const Json* found = json.is_object() ? json.find(name) : nullptr;
      if (found == nullptr) throw Error(ErrorCode::bad_file, "the lock names nobody");
      return *found;
    };
    holder.process = static_cast<std::int64_t>(member("process").number());
    holder.host = member("host").string();
    holder.machine_start = member("machine_start").string();
    holder.process_space = member("process_space").string();
    holder.process_start = member("process_start").string();
    return holder;
  } catch (const Error&) {
    return {};
  }
}

bool has_ended(const LockHolder& holder) {
  const LockHolder own = this_process();
  if (holder.host != own.host) return false;
  // A confined process can neither read these facts nor send signals.
  const bool knows_start = !own.machine_start.empty() && !holder.machine_start.empty();
  if (knows_start && holder.machine_start != own.machine_start) return true;
  if (own.process_space.empty() || holder.process_space != own.process_space) return false;
  if (::kill(static_cast<pid_t>(holder.process), 0) != 0 && errno == ESRCH) return true;
  const std::string start = start_of(holder.process);
  return !start.empty() && !holder.process_start.empty() && start != holder.process_start;
}

[[noreturn]] void throw_held(const fs::path& folder, const std::optional<LockHolder>& holder, bool certain) {
  throw Error(ErrorCode::bad_state,
              asperity::quoted(folder.string()) + " is being written by " +
                  (holder ? "process " + std::to_string(holder->process) + " on " + holder->host
                          : std::string("another process")),
              certain ? "wait until that one has ended, or give another directory"
                      : "if that one has ended, remove " +
                            asperity::quoted((folder / RunLock::file_name).string()) +
                            "; this file system gives no locks, which would tell");
}

}  // namespace

int RunLock::ask_system(int descriptor) {
  struct ::flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  for (;;) {
    if (::fcntl(descriptor, F_OFD_SETLK, &whole) == 0) return 0;
    if (errno != EINTR) return errno;
  }
}

RunLock::RunLock(fs::path folder, int descriptor) : folder_(std::move(folder)), descriptor_(descriptor) {}

RunLock::~RunLock() { release(); }

std::shared_ptr<RunLock> RunLock::take(const fs::path& folder, const Ask& ask) {
  return open(folder, O_CREAT, ask);
}

std::shared_ptr<RunLock> RunLock::take_if_known(const fs::path& folder) {
  std::error_code problem;
  if (!fs::exists(fs::symlink_status(folder / file_name, problem))) return nullptr;
  return open(folder, 0, ask_system);
}

std::shared_ptr<RunLock> RunLock::inherited(const fs::path& folder, int descriptor) {
  const std::shared_ptr<RunLock> lock(new RunLock(folder, descriptor));
  lock->inherited_ = true;
  return lock;
}

std::shared_ptr<RunLock> RunLock::open(const fs::path& folder, int flags, const Ask& ask) {
  const fs::path file = folder / file_name;
  for (int times = 0; times < 20; ++times) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | flags, 0666);
    if (descriptor < 0 && errno == ENOENT && flags == 0) return nullptr;
    if (descriptor < 0 && errno == ELOOP)
      throw Error(ErrorCode::bad_file, asperity::quoted(file.string()) + " is a link",
                  "a run writes its own files where they are; take the link away");
    if (descriptor < 0 && errno == EISDIR)
      throw Error(ErrorCode::bad_file,
                  asperity::quoted(file.string()) + " is a folder, where a run keeps the name of its writer",
                  "rename the folder, or take it away");
    if (descriptor < 0) throw_file_error("lock", file, errno);
    const std::shared_ptr<RunLock> lock(new RunLock(folder, descriptor));
    const int reason = lock->ask_patiently(ask);
    if (reason != 0) {
      lock->hold_by_name();
      lock->notice_ =
          "the file system of " + asperity::quoted(folder.string()) +
          " gives no locks: that no two processes write there is known by the name of the last one alone";
      return lock;
    }
    if (lock->is_of_this_folder_alone()) {
      lock->write_name();
      return lock;
    }
  }
  throw Error(ErrorCode::bad_file, asperity::quoted(file.string()) + " is replaced again and again",
              "see which other program writes there");
}

// 0 if locked; an error number without locks. Throws if another process has the lock.
int RunLock::ask_patiently(const Ask& ask) {
  const fs::path file = folder_ / file_name;
  const int reason = ask(descriptor_);
  if (reason != EAGAIN && reason != EACCES) return reason;
  // Retries: the file may name an ended owner until the new owner writes, and a child of a killed holder ends
  // soon.
  std::optional<LockHolder> holder;
  for (int tries = 0; tries < 300; ++tries) {  // 3 s: children end slowly on a busy machine
    holder = holder_in(file);
    if (holder && !has_ended(*holder)) break;
    holder.reset();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (ask(descriptor_) == 0) return 0;
  }
  ::close(std::exchange(descriptor_, -1));  // not release(), which would erase the owner's name
  throw_held(folder_, holder, true);
}

// Replaces a file with a second name (copy by hard links). A file replaced before it was locked locks
// nothing. False for both, without a lock.
bool RunLock::is_of_this_folder_alone() {
  const fs::path file = folder_ / file_name;
  struct ::stat held {
  }, named{};
  const bool same = ::fstat(descriptor_, &held) == 0 && ::lstat(file.c_str(), &named) == 0 &&
                    held.st_ino == named.st_ino && held.st_dev == named.st_dev;
  if (same && held.st_nlink < 2) return true;
  if (same) write_atomically(file, "");
  ::close(std::exchange(descriptor_, -1));  // not release(), which would empty the other name
  return false;
}

// If two processes write their names at once, the later name remains; both read it after a pause.
void RunLock::hold_by_name() {
  const fs::path file = folder_ / file_name;
  ::close(std::exchange(descriptor_, -1));
  if (const std::optional<LockHolder> holder = holder_in(file); holder && !has_ended(*holder))
    throw_held(folder_, holder, holder->host == this_process().host);
  const std::string own = lock_text(this_process());
  write_atomically(file, own);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::optional<LockHolder> holder = holder_in(file);
  if (!holder || lock_text(*holder) != own) throw_held(folder_, holder, true);
  descriptor_ = ::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
}

void RunLock::write_name() {
  const std::string own = lock_text(this_process());
  // Without a name (full disk) messages say "another process"; the lock holds.
  if (::ftruncate(descriptor_, 0) != 0) return;
  if (::pwrite(descriptor_, own.data(), own.size(), 0) < 0) return;
}

void RunLock::release() {
  if (descriptor_ < 0) return;
  const int descriptor = std::exchange(descriptor_, -1);
  // Without locks on the file system, the name is the lock: erase it first.
  if (!inherited_ && ::ftruncate(descriptor, 0) != 0) errno = 0;
  ::close(descriptor);
}

}  // namespace asperity
