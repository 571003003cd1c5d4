// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

std::string first_line_of(const fs::path& file) {
  std::ifstream text(file);
  std::string line;
  std::getline(text, line);
  return line;
}

// Field 22 of /proc/PID/stat; "" without process.
std::string start_of(std::int64_t process) {
  const std::string line = first_line_of("/proc/" + std::to_string(process) + "/stat");
  // The program name may hold anything.
  std::size_t at = line.rfind(')');
  for (int field = 2; at != std::string::npos && field < 22; ++field) at = line.find(' ', at + 1);
  if (at == std::string::npos) return {};
  return line.substr(at + 1, line.find(' ', at + 1) - at - 1);
}

// Start time (ticks since boot) and boot detect reused process numbers; the process name space distinguishes
// containers.
Json this_process() {
  utsname system{};
  std::error_code unknown;
  const std::int64_t process = ::getpid();
  return Json::object({{"process", process},
                       {"host", ::uname(&system) == 0 ? system.nodename : ""},
                       {"machine_start", first_line_of("/proc/sys/kernel/random/boot_id")},
                       {"process_space", fs::read_symlink("/proc/self/ns/pid", unknown).string()},
                       {"process_start", start_of(process)}});
}

// None if missing or torn.
std::optional<Json> holder_in(const fs::path& file) {
  std::ifstream text(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(text), {}};
  if (!content.ends_with('\n')) return {};
  try {
    Json holder = Json::parse(content, "the lock");
    bool sound = holder["process"].is_number();
    for (const char* name : {"host", "machine_start", "process_space", "process_start"})
      sound = sound && holder[name].is_string();
    return sound ? std::optional(std::move(holder)) : std::nullopt;
  } catch (const Error&) {
    return {};
  }
}

bool has_ended(const Json& holder) {
  const Json own = this_process();
  const auto same = [&](const char* name) { return holder[name] == own[name]; };
  const auto known = [](const Json& of, const char* name) { return !of[name].string().empty(); };
  if (!same("host")) return false;
  // A confined process can neither read these nor send signals.
  const bool knows_start = known(own, "machine_start") && known(holder, "machine_start");
  if (knows_start && !same("machine_start")) return true;
  if (!known(own, "process_space") || !same("process_space")) return false;
  const auto process = static_cast<std::int64_t>(holder["process"].number());
  if (::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) return true;
  const std::string start = start_of(process);
  return !start.empty() && known(holder, "process_start") && start != holder["process_start"].string();
}

[[noreturn]] void throw_held(const fs::path& folder, const std::optional<Json>& holder, bool certain) {
  refuse_state(quoted(folder.string()) + " is being written by " +
                   (holder ? "process " + (*holder)["process"].text() + " on " + (*holder)["host"].string()
                           : std::string("another process")),
               certain ? "wait until it has ended, or give another directory"
                       : "if it has ended, remove " + quoted((folder / RunLock::file_name).string()) +
                             "; this file system has no locks");
}

constexpr std::string_view earlier_folder = "before-";

bool is_earlier_folder(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(earlier_folder) && name.size() > earlier_folder.size() &&
         name.find_first_not_of("0123456789", earlier_folder.size()) == std::string::npos;
}

bool is_no_part_of_the_record(const fs::path& file) {
  return file.filename() == run_names::store || file.filename() == RunLock::file_name ||
         is_earlier_folder(file);
}

void move_into(const fs::path& file, const fs::path& folder) {
  std::error_code reason;
  fs::rename(file, folder / file.filename(), reason);
  if (reason) throw_file_error("move aside", file, reason.value());
}

// Missing, or empty after a power cut.
bool has_no_manifest(const fs::path& folder) {
  std::error_code missing;
  const fs::path manifest = folder / run_names::manifest;
  if (!fs::exists(fs::symlink_status(manifest, missing))) return true;
  return fs::is_regular_file(fs::symlink_status(manifest, missing)) &&
         fs::file_size(manifest, missing) == 0 && !missing;
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
    if (descriptor < 0 && errno == ELOOP) throw_link(file);
    if (descriptor < 0 && errno == EISDIR)
      refuse_bad_file(quoted(file.string()) + " is a folder, and the lock of a run needs this name",
                      "rename or remove the folder");
    if (descriptor < 0) throw_file_error("lock", file, errno);
    const std::shared_ptr<RunLock> lock(new RunLock(folder, descriptor));
    const int reason = lock->ask_patiently(ask);
    if (reason != 0) {
      lock->hold_by_name();
      lock->notice_ = "the file system of " + quoted(folder.string()) +
                      " has no locks: only the stored name of its writer keeps other processes away";
      return lock;
    }
    if (lock->is_of_this_folder_alone()) {
      lock->write_name();
      return lock;
    }
  }
  refuse_bad_file(quoted(file.string()) + " is replaced repeatedly",
                  "find the other program that writes there");
}

// 0 if locked; error number without locks. Throws if another process has it.
int RunLock::ask_patiently(const Ask& ask) {
  const fs::path file = folder_ / file_name;
  const int reason = ask(descriptor_);
  if (reason != EAGAIN && reason != EACCES) return reason;
  // Retries: the file may name an ended owner until the new owner writes, and a killed holder's child ends
  // soon.
  std::optional<Json> holder;
  for (int tries = 0; tries < 300; ++tries) {  // 3 s, for a busy machine
    holder = holder_in(file);
    if (holder && !has_ended(*holder)) break;
    holder.reset();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (ask(descriptor_) == 0) return 0;
  }
  ::close(std::exchange(descriptor_, -1));  // release() would erase the owner's name
  throw_held(folder_, holder, true);
}

// Replaces a file with a second name (copy by hard links). False for it and for a file replaced before the
// lock.
bool RunLock::is_of_this_folder_alone() {
  const fs::path file = folder_ / file_name;
  struct ::stat held {
  }, named{};
  const bool same = ::fstat(descriptor_, &held) == 0 && ::lstat(file.c_str(), &named) == 0 &&
                    held.st_ino == named.st_ino && held.st_dev == named.st_dev;
  if (same && held.st_nlink < 2) return true;
  if (same) write_atomically(file, "");
  ::close(std::exchange(descriptor_, -1));  // release() would empty the other name
  return false;
}

// If two processes write their names at once, the later name remains; both read it after a pause.
void RunLock::hold_by_name() {
  const fs::path file = folder_ / file_name;
  ::close(std::exchange(descriptor_, -1));
  const Json own = this_process();
  if (const std::optional<Json> holder = holder_in(file); holder && !has_ended(*holder))
    throw_held(folder_, holder, (*holder)["host"] == own["host"]);
  write_atomically(file, own.text() + "\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::optional<Json> holder = holder_in(file);
  if (holder != own) throw_held(folder_, holder, true);
  descriptor_ = ::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
}

void RunLock::write_name() {
  const std::string own = this_process().text() + "\n";
  // Without a name (full disk) the lock still holds.
  if (::ftruncate(descriptor_, 0) != 0) return;
  if (::pwrite(descriptor_, own.data(), own.size(), 0) < 0) return;
}

void RunLock::release() {
  if (descriptor_ < 0) return;
  const int descriptor = std::exchange(descriptor_, -1);
  // Without locks, the name is the lock: erase it first.
  if (!inherited_ && ::ftruncate(descriptor, 0) != 0) errno = 0;
  ::close(descriptor);
}

std::vector<fs::path> make_folders(const fs::path& folder) {
  if (folder.empty()) return {};
  std::vector<fs::path> holding;
  std::error_code reason;
  for (fs::path part = fs::absolute(folder).lexically_normal();
       part.has_relative_path() && !fs::exists(part, reason); part = part.parent_path())
    holding.push_back(part.parent_path());
  fs::create_directories(folder, reason);
  if (reason) throw_file_error("make the folder", folder, reason.value());
  return holding;
}

// mkdir is atomic.
fs::path numbered_directory(const fs::path& runs, const std::string& script_name,
                            std::vector<fs::path>& holding) {
  holding = make_folders(runs);
  holding.push_back(fs::absolute(runs).lexically_normal());
  const std::string stem = safe_file_name(fs::path(script_name).stem().string());
  for (int n = 1;; ++n) {
    fs::path candidate = runs / (stem + "-" + std::to_string(n));
    if (::mkdir(candidate.c_str(), 0777) == 0) return candidate;
    if (errno != EEXIST) throw_file_error("make the folder", candidate, errno);
  }
}

// Again under the lock: another run may have ended.
fs::path given_directory(const fs::path& out, std::shared_ptr<RunLock>& lock, bool locked,
                         std::vector<fs::path>& holding) {
  std::error_code reason;
  if (fs::exists(out, reason) && !fs::is_directory(out, reason))
    refuse("`--out` names " + quoted(out.string()) + ", which is a file", "give the name of a new directory");
  holding = make_folders(out);
  const auto require_new = [&] {
    if (!is_not_begun(out))
      refuse("`--out` names " + quoted(out.string()) + ", which is not empty",
             fs::exists(out / run_names::manifest, reason)
                 ? "give a new directory, or --resume to go on with the run there"
                 : "give a new directory");
  };
  if (!locked) {
    require_new();
    return out;
  }
  if (lock == nullptr && !is_not_begun(out)) lock = RunLock::take_if_known(out);  // names the holder
  require_new();
  if (lock == nullptr) lock = RunLock::take(out);
  require_new();
  sweep_parts(out, Parts::all);
  for (const std::string_view own : {run_names::script, run_names::journal, run_names::manifest})
    fs::remove(out / own, reason);
  return out;
}

void wait_for_names_in(const fs::path& folder) {
  if (::access(folder.c_str(), R_OK) == 0) wait_for_disk(folder);
}

std::string text_of_run_file(const fs::path& path) {
  std::error_code missing;
  // Opening a pipe would block.
  if (!fs::is_regular_file(path, missing) || ::access(path.c_str(), R_OK) != 0)
    refuse_bad_file("there is no " + quoted(path.string()) + " that can be read",
                    "give the directory of a run, such as runs/quick_start-1");
  return text_of_file(path.string());
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code reason;
  for (fs::directory_iterator entry(folder, reason), end; !reason && entry != end; entry.increment(reason))
    entries.push_back(entry->path());
  if (reason) throw_file_error("read the folder", folder, reason.value());
  std::ranges::sort(entries);
  return entries;
}

void move_aside(const fs::path& root) {
  fs::path earlier;
  std::error_code reason;
  for (int n = 1; earlier.empty() || fs::exists(fs::symlink_status(earlier, reason)); ++n)
    earlier = root / (std::string(earlier_folder) + std::to_string(n));
  make_folders(earlier);
  if (fs::exists(root / run_names::manifest, reason)) move_into(root / run_names::manifest, earlier);
  for (const fs::path& file : entries_of(root))
    if (!is_no_part_of_the_record(file)) move_into(file, earlier);
}

bool is_not_begun(const fs::path& folder) {
  std::error_code missing;
  if (!fs::exists(folder, missing)) return true;
  if (!fs::is_directory(folder, missing) || !has_no_manifest(folder)) return false;
  return std::ranges::all_of(entries_of(folder), [](const fs::path& file) {
    std::error_code gone;
    const fs::file_status status = fs::symlink_status(file, gone);
    if (fs::is_directory(status)) return file.filename() == run_names::store || is_earlier_folder(file);
    return fs::is_regular_file(status) &&
           (is_part(file) ||
            std::ranges::find(run_names::files, file.filename().string()) != run_names::files.end());
  });
}

void finish_moving_aside(const fs::path& folder) {
  std::error_code missing;
  if (!fs::is_directory(folder, missing) ||
      fs::exists(fs::symlink_status(folder / run_names::manifest, missing)))
    return;
  const auto number = [](const fs::path& earlier) {
    return std::stoll("0" + earlier.filename().string().substr(earlier_folder.size(), 15));
  };
  fs::path latest;
  const std::vector<fs::path> entries = entries_of(folder);
  for (const fs::path& file : entries)
    if (is_earlier_folder(file) && (latest.empty() || number(latest) < number(file))) latest = file;
  if (latest.empty() || !fs::is_directory(fs::symlink_status(latest, missing)) ||
      !fs::exists(latest / run_names::manifest, missing))
    return;
  // A file here with a name there belongs to the next run.
  for (const fs::path& file : entries)
    if (!is_no_part_of_the_record(file) && !fs::exists(fs::symlink_status(latest / file.filename(), missing)))
      move_into(file, latest);
}

void throw_link(const fs::path& file) {
  refuse_bad_file(quoted(file.string()) + " is a link",
                  file.filename() == run_names::store
                      ? "name the other folder by `--store`, and remove the link"
                      : "remove the link: a run writes its own files");
}

void refuse_links(const fs::path& folder) {
  for (const std::string_view own :
       {run_names::script, run_names::manifest, run_names::journal, run_names::store, run_names::loaded}) {
    std::error_code missing;
    if (fs::is_symlink(fs::symlink_status(folder / own, missing))) throw_link(folder / own);
  }
}

}  // namespace asperity
