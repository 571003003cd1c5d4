// SPDX-License-Identifier: GPL-3.0-or-later
// Disk limit of a run. The kernel limits no folder as a whole: its size is measured often from outside. A run
// beyond the limit is ended, and files beyond the limit are removed: last changed first, the run's record
// last. Open but deleted files are invisible in the folder; with `--limit-disk` and in page runs, a thread of
// the run empties them beyond the limit. A finished run loses no file.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>

namespace asperity::cli {

struct DiskUse {
  std::int64_t bytes = 0;  // on the disk
  std::size_t files = 0;   // files and folders
};
// Stops counting beyond `most_files`.
DiskUse disk_use(const std::filesystem::path& folder, std::size_t most_files);

// Time of the next measurement after one since `begun`; at most a tenth of the time is spent measuring.
std::chrono::steady_clock::time_point next_look(std::chrono::steady_clock::time_point begun);

// Removes files beyond the limits; returns a sentence, or "". No process may write there. Follows no links.
std::string keep_within(const std::filesystem::path& folder, std::int64_t most_bytes, std::size_t most_files);

// The size of open but deleted files, on the disk.
std::int64_t unlinked_bytes();
// If open for writing.
void empty_unlinked_files();

// Checks about twenty times a second.
class UnlinkedFilesBound {
 public:
  explicit UnlinkedFilesBound(std::int64_t most_bytes);
  ~UnlinkedFilesBound();
  UnlinkedFilesBound(const UnlinkedFilesBound&) = delete;
  UnlinkedFilesBound& operator=(const UnlinkedFilesBound&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace asperity::cli
