// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace asperity {

// The lock of a run directory for one writing process: an open file description lock on `.lock`, released by
// the system at any end of the process. The file names process and host of the last holder. On file systems
// without locks this name is the lock: an ended holder on this host is ignored, one on another host counts as
// alive. Readers take none.

class RunLock {
 public:
  static constexpr const char* file_name = ".lock";
  // Without waiting; 0 or the error number.
  using Ask = std::function<int(int descriptor)>;
  static int ask_system(int descriptor);

  // Throws Error{bad_state} with process and host of another holder; Error{bad_file} if `.lock` is
  // inaccessible or a link.
  static std::shared_ptr<RunLock> take(const std::filesystem::path& folder, const Ask& ask = ask_system);
  // Null without `.lock`.
  static std::shared_ptr<RunLock> take_if_known(const std::filesystem::path& folder);
  // From a parent's open file: locked, under the parent's name, until both have released it.
  static std::shared_ptr<RunLock> inherited(const std::filesystem::path& folder, int descriptor);

  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  void release();

  // For a child; -1 once released.
  int descriptor() const { return descriptor_; }

  // See RunDirectory::lock_notice().
  const std::string& notice() const { return notice_; }

 private:
  RunLock(std::filesystem::path folder, int descriptor);
  static std::shared_ptr<RunLock> open(const std::filesystem::path& folder, int flags, const Ask& ask);
  int ask_patiently(const Ask& ask);
  bool is_of_this_folder_alone();
  void hold_by_name();
  void write_name();

  std::filesystem::path folder_;
  std::string notice_;
  int descriptor_ = -1;
  bool inherited_ = false;
};

// A mutex lock with a time limit.

// Polls every millisecond: the thread sanitizer of g++ 12 ignores the timed wait of std::timed_mutex and
// reports each later unlock.
inline std::unique_lock<std::mutex> lock_within(std::mutex& mutex, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock.owns_lock() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  return lock;
}

// At the top of the directory.
namespace run_names {
inline constexpr std::string_view script = "script.lua";
inline constexpr std::string_view manifest = "manifest.json";
inline constexpr std::string_view journal = "journal.jsonl";
inline constexpr std::string_view store = "store";  // results of heavy calls (result_files.hpp)
inline constexpr std::string_view views =
    ".views";  // a folder: drawings of the page (bindings/web/confined/views.hpp)
// Copies of files loaded by `require`, `dofile` and `loadfile`.
inline constexpr std::string_view loaded = "script_files";
// In the manifest during the run.
inline constexpr std::string_view inputs_so_far = "inputs_so_far";
inline constexpr std::array<std::string_view, 4> files = {script, manifest, journal, RunLock::file_name};
}  // namespace run_names

// Returns the parents of new folders. Throws Error{bad_file}.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

// Makes the first free runs/<script>-<n>, never shared by two runs. `holding`: as make_folders().
std::filesystem::path numbered_directory(const std::filesystem::path& runs, const std::string& script_name,
                                         std::vector<std::filesystem::path>& holding);

// Makes the folder of `--out`, or accepts one where a run may begin. `locked`: locks it and removes a run
// killed before its first manifest. Throws Error{bad_value} if it holds more, Error{bad_state} if locked.
std::filesystem::path given_directory(const std::filesystem::path& out, std::shared_ptr<RunLock>& lock,
                                      bool locked, std::vector<std::filesystem::path>& holding);

// Syncs the names in a readable folder.
void wait_for_names_in(const std::filesystem::path& folder);

// Throws Error{bad_file}.
std::string text_of_run_file(const std::filesystem::path& path);

// Sorted paths. Throws Error{bad_file}.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

// Moves an earlier run, except its store, into the first free before-<n>, the manifest first:
// finish_moving_aside() recognises an interrupted move.
void move_aside(const std::filesystem::path& root);

// Missing, empty, or killed before a first manifest.
bool is_not_begun(const std::filesystem::path& folder);
void finish_moving_aside(const std::filesystem::path& folder);
[[noreturn]] void throw_link(const std::filesystem::path& file);
// Throws Error{bad_file} for a link among a run's own entries.
void refuse_links(const std::filesystem::path& folder);

}  // namespace asperity
