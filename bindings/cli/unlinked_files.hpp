// SPDX-License-Identifier: GPL-3.0-or-later
// Open but deleted files of a script: they use disk space, invisible in the directory. With `--limit-disk`
// and in page runs, a thread in the confined process empties such files beyond the limit. No file of the
// finished run is lost.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace asperity::cli {

// On the disk.
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
